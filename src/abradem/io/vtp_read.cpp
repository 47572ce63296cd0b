// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/vtp_read.h"

#include <fmt/core.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <string_view>
#include <utility>

#include "abradem/core/error.h"
#include "abradem/core/text.h"

// The XML of these files is machine-written and flat: tags, attributes in double quotes, no entities, no
// comments inside elements. So a scanner that walks from tag to tag is enough.
namespace abradem::io {
namespace {

using core::trimmed;

struct Tag {
  std::string_view name;  ///< "/Name" for a closing tag
  std::string_view attributes;
  std::size_t end = 0;  ///< just behind '>'
  bool empty = false;   ///< <Name/>

  [[nodiscard]] std::string_view operator[](std::string_view key) const {
    for (std::size_t at = attributes.find(key); at != std::string_view::npos;
         at = attributes.find(key, at + 1)) {
      const bool starts =
          at == 0 || attributes[at - 1] == ' ' || attributes[at - 1] == '\n' || attributes[at - 1] == '\t';
      const std::size_t quote = at + key.size() + 1;
      if (!starts || quote >= attributes.size() || attributes.substr(at + key.size(), 2) != "=\"") continue;
      return attributes.substr(quote + 1, attributes.find('"', quote + 1) - quote - 1);
    }
    return {};
  }
};

class Document {
 public:
  Document(std::string name, std::string text) : file_(std::move(name)), text_(std::move(text)) {}
  [[noreturn]] void fail(const std::string& what) const { throw IoError(fmt::format("{}: {}", file_, what)); }
  [[nodiscard]] std::string_view text() const noexcept { return text_; }

  /// The next tag at or after a position; an empty name at the end.
  [[nodiscard]] Tag next(std::size_t from) const {
    const std::string_view text = text_;
    while (true) {
      const std::size_t open = text.find('<', from);
      if (open == std::string_view::npos) return {};
      const std::size_t close = text.find('>', open);
      if (close == std::string_view::npos) fail("ends inside a tag; was it cut off while writing?");
      const std::string_view inside = text.substr(open + 1, close - open - 1);
      if (inside.empty() || inside.front() == '?' || inside.front() == '!') {
        from = close + 1;
        continue;
      }
      const std::size_t name_end = std::min(inside.find_first_of(" \t\r\n/", 1), inside.size());
      return {inside.substr(0, name_end), inside.substr(name_end), close + 1, inside.back() == '/'};
    }
  }

 private:
  std::string file_, text_;
};

std::string content_of(const std::filesystem::path& file) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code))
    throw IoError(fmt::format("{}: no such file", file.string()));
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream) throw IoError(fmt::format("{}: cannot be read; check its permissions", file.string()));
  return text;
}

double parse_number(const Document& document, std::string_view text, std::string_view what) {
  double value = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{} || end != text.data() + text.size()) {
    document.fail(fmt::format("{} is '{}', expected a number", what, text.substr(0, 40)));
  }
  return value;
}

/// A number of things, or a place in the file.
std::size_t parse_count(const Document& document, std::string_view text, std::string_view what,
                        std::size_t most) {
  const double value = parse_number(document, text, what);
  if (!(value >= 0.0 && value <= static_cast<double>(most)) || value != std::floor(value))
    document.fail(
        fmt::format("{} is '{}', expected a whole number up to {}", what, text.substr(0, 40), most));
  return static_cast<std::size_t>(value);
}

/// Undoes the entities of an attribute.
std::string unescaped(std::string_view text) {
  static constexpr std::pair<std::string_view, char> kEntities[] = {
      {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}};
  std::string out;
  while (!text.empty()) {
    const auto* entity = std::find_if(std::begin(kEntities), std::end(kEntities), [&](const auto& e) {
      return text.substr(0, e.first.size()) == e.first;
    });
    out += entity == std::end(kEntities) ? text.front() : entity->second;
    text.remove_prefix(entity == std::end(kEntities) ? 1 : entity->first.size());
  }
  return out;
}

/// Decodes base64 up to its end or a character outside the alphabet. Padding may occur inside: VTK encodes a
/// block's header and its data one after the other.
std::string decode_base64(std::string_view text) {
  static const auto table = [] {
    std::array<signed char, 256> out{};
    out.fill(-1);
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t k = 0; k < alphabet.size(); ++k)
      out[static_cast<unsigned char>(alphabet[k])] = static_cast<signed char>(k);
    return out;
  }();
  std::string out;
  out.reserve(text.size() / 4 * 3);
  for (std::size_t at = 0; at + 4 <= text.size(); at += 4) {
    std::uint32_t quad = 0;
    int padding = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const signed char digit = table[static_cast<unsigned char>(text[at + k])];
      if (digit < 0 && text[at + k] != '=') return out;
      padding += digit < 0 ? 1 : 0;
      quad = (quad << 6) | static_cast<std::uint32_t>(digit < 0 ? 0 : digit);
    }
    for (int k = 0; k < 3 - padding; ++k) out += static_cast<char>((quad >> (16 - 8 * k)) & 0xffu);
  }
  return out;
}

/// How the file stores binary arrays.
struct Encoding {
  std::size_t header_bytes = 4;  ///< of each number in a block header
  bool compressed = false;
  std::string_view appended;  ///< what follows the underscore, or nothing
  bool appended_raw = false;
};

/// Bytes of one stored array, header undone.
class BlockReader {
 public:
  BlockReader(const Document& document, const Encoding& encoding)
      : document_(document), encoding_(encoding) {}

  [[nodiscard]] std::string from_base64(std::string_view text) const {
    // The header is its own base64 text, so its length has to be known before the rest can be decoded.
    const std::size_t word = encoding_.header_bytes;
    if (!encoding_.compressed) {
      const std::string all = decode_base64(text.substr(0, encoded(word)));
      const std::size_t size = number(all, 0);
      // Some writers encode header and data together, some apart: padding after the header tells.
      const bool apart = encoded(word) > 0 && text.size() >= encoded(word) && text[encoded(word) - 1] == '=';
      if (apart) return checked(decode_base64(cut(text, encoded(word), encoded(size))), 0, size);
      return checked(decode_base64(text.substr(0, encoded(word + size))), word, size);
    }
    const std::size_t blocks = number(decode_base64(text.substr(0, encoded(3 * word))), 0);
    check_blocks(blocks, text.size());
    const std::size_t header_text = encoded((3 + blocks) * word);
    const std::string header = decode_base64(text.substr(0, header_text));
    return inflate_blocks(header, blocks,
                          decode_base64(cut(text, header_text, encoded(packed_size(header, blocks)))));
  }

  [[nodiscard]] std::string from_raw(std::string_view bytes) const {
    const std::size_t word = encoding_.header_bytes;
    const std::size_t first = number(bytes, 0);
    if (!encoding_.compressed)
      return checked(std::string(bytes.substr(0, std::min(bytes.size(), word + first))), word, first);
    check_blocks(first, bytes.size());
    const std::size_t header = (3 + first) * word;
    return inflate_blocks(bytes, first, cut(bytes, header, packed_size(bytes, first)));
  }

 private:
  static std::size_t encoded(std::size_t bytes) noexcept { return (bytes + 2) / 3 * 4; }

  [[noreturn]] void damaged() const {
    document_.fail("a stored array is shorter than its header says; was it cut off while writing?");
  }

  [[nodiscard]] std::string_view cut(std::string_view text, std::size_t from, std::size_t count) const {
    if (from > text.size() || count > text.size() - from) damaged();
    return text.substr(from, count);
  }
  [[nodiscard]] std::string checked(const std::string& bytes, std::size_t from, std::size_t size) const {
    if (bytes.size() < from || bytes.size() - from < size) damaged();
    return bytes.substr(from, size);
  }
  [[nodiscard]] std::size_t number(std::string_view bytes, std::size_t index) const {
    const std::string_view at = cut(bytes, index * encoding_.header_bytes, encoding_.header_bytes);
    std::uint64_t value = 0;
    std::memcpy(&value, at.data(), at.size());
    return value;
  }
  void check_blocks(std::size_t blocks, std::size_t available) const {
    if (blocks > available) damaged();
  }
  [[nodiscard]] std::size_t packed_size(std::string_view header, std::size_t blocks) const {
    std::size_t sum = 0;
    for (std::size_t b = 0; b < blocks; ++b) sum += number(header, 3 + b);
    return sum;
  }
  [[nodiscard]] std::string inflate_blocks(std::string_view header, std::size_t blocks,
                                           std::string_view packed) const {
    const std::size_t block_size = number(header, 1), last_size = number(header, 2);
    std::string out;
    std::size_t from = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::size_t bytes = number(header, 3 + b);
      const std::size_t size = b + 1 == blocks && last_size > 0 ? last_size : block_size;
      const std::string_view source = cut(packed, from, bytes);
      // zlib cannot expand more than about 1032 times; a larger claim is damage, not data.
      if (size / 1100 > bytes) damaged();
      const std::size_t before = out.size();
      out.resize(before + size);
      uLongf written = size;
      const int code = uncompress(reinterpret_cast<Bytef*>(out.data() + before), &written,
                                  reinterpret_cast<const Bytef*>(source.data()), static_cast<uLong>(bytes));
      if (code != Z_OK || written != size)
        document_.fail(fmt::format("zlib block {} is damaged (code {})", b, code));
      from += bytes;
    }
    return out;
  }

  const Document& document_;
  const Encoding& encoding_;
};

template <class Stored>
std::vector<double> widen(std::string_view bytes) {
  std::vector<double> out(bytes.size() / sizeof(Stored));
  for (std::size_t k = 0; k < out.size(); ++k) {
    Stored value;
    std::memcpy(&value, bytes.data() + k * sizeof(Stored), sizeof(Stored));
    out[k] = static_cast<double>(value);
  }
  return out;
}

std::vector<double> typed(const Document& document, std::string_view type, std::string_view bytes) {
  if (type == "Float64") return widen<double>(bytes);
  if (type == "Float32") return widen<float>(bytes);
  if (type == "Int64") return widen<std::int64_t>(bytes);
  if (type == "Int32") return widen<std::int32_t>(bytes);
  if (type == "UInt32") return widen<std::uint32_t>(bytes);
  if (type == "UInt8") return widen<std::uint8_t>(bytes);
  if (type == "Int8") return widen<std::int8_t>(bytes);
  document.fail(fmt::format(
      "array type '{}' is not supported; expected Float64, Float32, Int64, Int32, UInt32, Int8 or UInt8",
      type));
}

std::vector<double> parse_ascii(const Document& document, std::string_view text) {
  std::vector<double> out;
  for (std::size_t at = 0; (at = text.find_first_not_of(" \t\r\n", at)) != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
    out.push_back(parse_number(document, text.substr(at, end - at), "an ascii array's value"));
    at = end;
  }
  return out;
}

/// The arrays of the file, by section ("Points", "Polys", "PointData", "CellData") and name.
class VtpParser {
 public:
  VtpParser(std::string name, std::string text) : document_(std::move(name), std::move(text)) {}

  VtpSurface read() {
    read_header();
    std::string_view section;
    for (Tag tag = document_.next(0); !tag.name.empty() && tag.name != "AppendedData";
         tag = document_.next(tag.end)) {
      if (tag.name == "Piece") start_piece(tag);
      if (tag.name == "DataArray") {
        store(section, tag);
      } else if (tag.name.front() != '/' && !tag.empty) {
        section = tag.name;
      }
    }
    if (!pieces_) document_.fail("has no <Piece>; expected a PolyData surface");
    build_triangles();
    return std::move(surface_);
  }

 private:
  void read_header() {
    const Tag root = document_.next(0);
    if (root.name != "VTKFile")
      document_.fail("is not a VTK XML file; expected <VTKFile type=\"PolyData\" …>");
    if (root["type"] != "PolyData") {
      document_.fail(fmt::format("holds '{}', expected PolyData (a .vtp surface)", root["type"]));
    }
    if (root["byte_order"] == "BigEndian") document_.fail("is big endian, which is not supported");
    if (root["header_type"] == "UInt64") encoding_.header_bytes = 8;
    const std::string_view compressor = root["compressor"];
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
      document_.fail(
          fmt::format("is compressed by '{}'; only vtkZLibDataCompressor is supported", compressor));
    }
    encoding_.compressed = !compressor.empty();
    const std::size_t appended = document_.text().find("<AppendedData");
    if (appended == std::string_view::npos) return;
    const Tag tag = document_.next(appended);
    encoding_.appended_raw = tag["encoding"] == "raw";
    const std::size_t mark = document_.text().find('_', tag.end);
    if (mark == std::string_view::npos) document_.fail("<AppendedData> has no underscore before its data");
    encoding_.appended = document_.text().substr(mark + 1);
  }

  void start_piece(const Tag& tag) {
    if (pieces_++ > 0) document_.fail("has more than one <Piece>; expected one");
    points_ = parse_count(document_, tag["NumberOfPoints"], "NumberOfPoints",
                          std::numeric_limits<geometry::Index>::max());
  }

  VtpField load(const Tag& tag) const {
    const BlockReader reader(document_, encoding_);
    VtpField out;
    const std::string_view components = tag["NumberOfComponents"];
    if (!components.empty())
      out.components = static_cast<int>(
          parse_count(document_, components, "NumberOfComponents", std::numeric_limits<int>::max()));
    const std::string_view format = tag["format"];
    if (format == "appended") {
      const std::size_t offset =
          parse_count(document_, tag["offset"], "an array's offset", document_.text().size());
      if (offset >= encoding_.appended.size()) {
        document_.fail(
            fmt::format("array '{}' starts at {}, past the end of the appended data; was the file cut off?",
                        tag["Name"], offset));
      }
      const std::string_view data = encoding_.appended.substr(offset);
      out.values = typed(document_, tag["type"],
                         encoding_.appended_raw ? reader.from_raw(data) : reader.from_base64(data));
      return out;
    }
    const std::string_view content =
        trimmed(document_.text().substr(tag.end, document_.text().find('<', tag.end) - tag.end));
    if (format == "binary") {
      out.values =
          typed(document_, tag["type"], content.empty() ? std::string{} : reader.from_base64(content));
    } else if (format == "ascii") {
      out.values = parse_ascii(document_, content);
    } else {
      document_.fail(
          fmt::format("array '{}' has format '{}'; expected ascii, binary or appended", tag["Name"], format));
    }
    return out;
  }

  void store(std::string_view section, const Tag& tag) {
    const std::string name = unescaped(tag["Name"]);
    if (section == "Points") {
      store_points(load(tag));
    } else if (section == "Polys" && name == "connectivity") {
      connectivity_ = load(tag).values;
    } else if (section == "Polys" && name == "offsets") {
      offsets_ = load(tag).values;
    } else if (section == "PointData") {
      surface_.point_data[name] = load(tag);
    } else if (section == "CellData") {
      surface_.cell_data[name] = load(tag);
    }
  }

  void store_points(const VtpField& array) {
    if (array.components != 3 || array.values.size() != 3 * points_) {
      document_.fail(fmt::format("Points holds {} numbers, expected 3 for each of the {} points",
                                 array.values.size(), points_));
    }
    surface_.mesh.vertices.resize(points_);
    for (std::size_t k = 0; k < points_; ++k) {
      surface_.mesh.vertices[k] = {array.values[3 * k], array.values[3 * k + 1], array.values[3 * k + 2]};
      if (!is_finite(surface_.mesh.vertices[k])) document_.fail(fmt::format("point {} is not finite", k));
    }
  }

  void build_triangles() {
    if (surface_.mesh.vertices.size() != points_)
      document_.fail(fmt::format("states {} points, and has no <Points> that hold them", points_));
    if (connectivity_.size() != 3 * offsets_.size()) {
      document_.fail(fmt::format("{} polygons with {} corners; only triangles are supported", offsets_.size(),
                                 connectivity_.size()));
    }
    surface_.mesh.triangles.resize(offsets_.size());
    for (std::size_t t = 0; t < offsets_.size(); ++t) {
      if (offsets_[t] != static_cast<double>(3 * (t + 1)))
        document_.fail(fmt::format("polygon {} is not a triangle", t));
      for (std::size_t k = 0; k < 3; ++k) {
        const double corner = connectivity_[3 * t + k];
        if (!(corner >= 0.0 && corner < static_cast<double>(points_))) {
          document_.fail(fmt::format("triangle {} names point {}, but there are {}", t, corner, points_));
        }
        surface_.mesh.triangles[t][k] = static_cast<geometry::Index>(corner);
      }
    }
  }

  Document document_;
  Encoding encoding_;
  VtpSurface surface_;
  std::vector<double> connectivity_, offsets_;
  std::size_t points_ = 0;
  int pieces_ = 0;
};

}  // namespace

VtpSurface read_vtp(const std::filesystem::path& file) { return parse_vtp(content_of(file), file.string()); }

VtpSurface parse_vtp(std::string text, const std::string& name) {
  return VtpParser(name, std::move(text)).read();
}

std::vector<SeriesFrame> read_pvd(const std::filesystem::path& file) {
  return parse_pvd(content_of(file), file);
}

std::vector<SeriesFrame> parse_pvd(std::string text, const std::filesystem::path& file) {
  const Document document(file.string(), std::move(text));
  if (document.text().find("type=\"Collection\"") == std::string_view::npos) {
    document.fail("is not a ParaView collection; expected <VTKFile type=\"Collection\" …>");
  }
  std::vector<SeriesFrame> out;
  for (Tag tag = document.next(0); !tag.name.empty(); tag = document.next(tag.end)) {
    if (tag.name != "DataSet") continue;
    if (tag["file"].empty()) document.fail(fmt::format("entry {} names no file", out.size() + 1));
    out.push_back({parse_number(document, tag["timestep"], "an entry's timestep"), std::string(tag["part"]),
                   file.parent_path() / unescaped(tag["file"])});
  }
  return out;
}

}  // namespace abradem::io
