// SPDX-License-Identifier: BSD-3-Clause
// Stanford polygon files [Turk, "The PLY Polygon File Format", 1994]: a text header that describes rows of
// numbers and lists, then the rows, as text or binary of either byte order.
#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "abradem/io/mesh_text.h"

namespace abradem::io::detail {

namespace {

using geometry::Index;
using geometry::TriangleMesh;

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };
struct TypeName {
  const char *name, *other_name;
  Type type;
  std::size_t size;
};
constexpr TypeName kTypes[] = {{"char", "int8", Type::i8, 1},      {"uchar", "uint8", Type::u8, 1},
                               {"short", "int16", Type::i16, 2},   {"ushort", "uint16", Type::u16, 2},
                               {"int", "int32", Type::i32, 4},     {"uint", "uint32", Type::u32, 4},
                               {"float", "float32", Type::f32, 4}, {"double", "float64", Type::f64, 8}};

std::size_t size_of(Type type) noexcept { return kTypes[static_cast<std::size_t>(type)].size; }

struct Property {
  std::string name;
  std::optional<Type> count_type;  ///< set: a list with a count of this type
  Type type = Type::f64;
};
struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};
enum class Format { text, little, big };
struct Header {
  Format format = Format::text;
  std::vector<Element> elements;
};

Type type_of(const WordReader& reader, std::string_view word) {
  for (const TypeName& t : kTypes)
    if (word == t.name || word == t.other_name) return t.type;
  reader.fail(fmt::format("unknown property type '{}'", shown(word)));
}

Header read_header(const MeshText& text, WordReader& reader) {
  if (reader.word_in_line() != "ply") text.fail("not a PLY file: it does not begin with 'ply'");
  Header header;
  bool has_format = false;
  for (reader.next_line(); !reader.at_end(); reader.next_line()) {
    const std::string_view keyword = reader.word_in_line();
    if (keyword == "end_header") {
      reader.next_line();
      if (!has_format) text.fail("the header has no 'format' line");
      return header;
    }
    if (keyword == "format") {
      const std::string_view format = reader.word_in_line();
      has_format = true;
      if (format == "ascii")
        header.format = Format::text;
      else if (format == "binary_little_endian")
        header.format = Format::little;
      else if (format == "binary_big_endian")
        header.format = Format::big;
      else
        reader.fail("unknown format; expected ascii, binary_little_endian or binary_big_endian");
    } else if (keyword == "element") {
      Element element;
      element.name = reader.word_in_line();
      element.count = reader.integer(reader.word_in_line(), "a number of elements");
      if (element.count < 0)
        reader.fail(fmt::format("element '{}' has the count {}", element.name, element.count));
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) reader.fail("a property before any element");
      Property property;
      std::string_view word = reader.word_in_line();
      if (word == "list") {
        property.count_type = type_of(reader, reader.word_in_line());
        word = reader.word_in_line();
      }
      property.type = type_of(reader, word);
      property.name = reader.word_in_line();
      header.elements.back().properties.push_back(std::move(property));
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
      reader.fail("unknown line in the header; expected format, element, property, comment or end_header");
    }
  }
  text.fail("truncated: the header has no 'end_header'");
}

/// Numbers of the body, one after the other, whatever the format.
class Body {
 public:
  Body(const MeshText& text, WordReader reader, Format format)
      : text_(text), reader_(reader), position_(reader.position()), format_(format) {}

  double number(Type type) { return format_ == Format::text ? from_text(type) : from_binary(type); }
  /// A whole number. Counts and indices are exact in a double.
  std::int64_t integer(Type type, const char* what) {
    const double value = number(type);
    if (!(std::abs(value) < 9e15) || value != std::floor(value))
      text_.fail(fmt::format("{} is {}", what, value));
    return static_cast<std::int64_t>(value);
  }
  /// Throws unless n items of a type can still follow.
  void require_room(std::int64_t n, std::size_t bytes_each, const std::string& what) const {
    const std::size_t left =
        format_ == Format::text ? reader_.remaining() + 1 : text_.data.size() - position_;
    if (n < 0 || static_cast<std::uint64_t>(n) > left / std::max<std::size_t>(1, bytes_each))
      text_.fail(
          fmt::format("truncated, or a wrong count: {} states {}, but only {} bytes follow", what, n, left));
  }
  [[nodiscard]] bool is_text() const noexcept { return format_ == Format::text; }

 private:
  double from_text(Type type) {
    const std::string_view word = reader_.word();
    if (word.empty()) text_.fail("truncated: numbers are missing at the end");
    return type == Type::f32 || type == Type::f64
               ? reader_.any_number(word, "a number")
               : static_cast<double>(reader_.integer(word, "a whole number"));
  }
  double from_binary(Type type) {
    switch (type) {
      case Type::i8:
        return raw<std::int8_t>();
      case Type::u8:
        return raw<std::uint8_t>();
      case Type::i16:
        return raw<std::int16_t>();
      case Type::u16:
        return raw<std::uint16_t>();
      case Type::i32:
        return raw<std::int32_t>();
      case Type::u32:
        return raw<std::uint32_t>();
      case Type::f32:
        return static_cast<double>(raw<float>());
      case Type::f64:
        break;
    }
    return raw<double>();
  }
  template <class T>
  T raw() {
    if (text_.data.size() - position_ < sizeof(T)) text_.fail("truncated: the data end too early");
    char bytes[sizeof(T)];
    std::memcpy(bytes, text_.data.data() + position_, sizeof(T));
    if ((format_ == Format::big) != (std::endian::native == std::endian::big))
      std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    position_ += sizeof(T);
    return value;
  }

  const MeshText& text_;
  WordReader reader_;
  std::size_t position_;
  Format format_;
};

/// The least number of bytes one row takes.
std::size_t least_bytes(const Element& element, bool is_text) {
  std::size_t bytes = 0;
  for (const Property& p : element.properties) bytes += is_text ? 2 : size_of(p.count_type.value_or(p.type));
  return bytes;
}

/// How many numbers of a property follow: one, or the length of the list.
std::int64_t read_count(Body& body, const Property& p) {
  if (!p.count_type) return 1;
  const std::int64_t count = body.integer(*p.count_type, "the length of a list");
  body.require_room(count, body.is_text() ? 2 : size_of(p.type), fmt::format("a list '{}'", p.name));
  return count;
}

void read_vertices(const MeshText& text, const Element& element, Body& body, TriangleMesh& mesh) {
  double* target[3] = {};
  Vec3 p;
  std::vector<double*> targets;
  for (const Property& property : element.properties) {
    double* to = property.name == "x"   ? &p.x
                 : property.name == "y" ? &p.y
                 : property.name == "z" ? &p.z
                                        : nullptr;
    if (to != nullptr && property.count_type) text.fail("a coordinate is a list");
    if (to != nullptr) target[to == &p.x ? 0 : to == &p.y ? 1 : 2] = to;
    targets.push_back(to);
  }
  if (!std::ranges::all_of(target, [](const double* t) { return t != nullptr; }))
    text.fail("the element 'vertex' lacks a property x, y or z");
  mesh.vertices.reserve(static_cast<std::size_t>(element.count));
  for (std::int64_t i = 0; i < element.count; ++i) {
    for (std::size_t k = 0; k < targets.size(); ++k) {
      const Property& property = element.properties[k];
      std::int64_t count = read_count(body, property);
      for (; count > 0; --count) {
        const double value = body.number(property.type);
        if (targets[k] != nullptr) *targets[k] = value;
      }
    }
    if (!is_finite(p)) text.fail(fmt::format("vertex {} has a coordinate that is not finite", i));
    mesh.vertices.push_back(p);
  }
}

void read_faces(const MeshText& text, const Element& element, Body& body, TriangleMesh& mesh) {
  const auto is_corners = [](const Property& p) {
    return p.count_type && (p.name == "vertex_indices" || p.name == "vertex_index");
  };
  if (std::ranges::none_of(element.properties, is_corners))
    text.fail("the element 'face' lacks a list 'vertex_indices'");
  std::vector<Index> corners;
  for (std::int64_t i = 0; i < element.count; ++i)
    for (const Property& property : element.properties) {
      const std::int64_t count = read_count(body, property);
      corners.clear();
      for (std::int64_t k = 0; k < count; ++k) {
        if (!is_corners(property)) {
          (void)body.number(property.type);
          continue;
        }
        const std::int64_t index = body.integer(property.type, "a vertex index");
        if (index < 0 || index > std::numeric_limits<Index>::max())
          text.fail(fmt::format("face {} uses vertex {}, which is out of range", i, index));
        corners.push_back(static_cast<Index>(index));
      }
      if (is_corners(property) && count < 3)
        text.fail(fmt::format("face {} has {} corners; expected three or more", i, count));
      add_polygon(mesh, corners);
    }
}

void skip_rows(const Element& element, Body& body) {
  for (std::int64_t i = 0; i < element.count; ++i)
    for (const Property& property : element.properties) {
      std::int64_t count = read_count(body, property);
      for (; count > 0; --count) (void)body.number(property.type);
    }
}

}  // namespace

TriangleMesh read_ply(const MeshText& text) {
  WordReader reader(text);
  const Header header = read_header(text, reader);
  Body body(text, reader, header.format);
  TriangleMesh mesh;
  bool has_vertices = false, has_faces = false;
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    body.require_room(element.count, least_bytes(element, body.is_text()),
                      fmt::format("element '{}'", element.name));
    if (element.name == "vertex")
      read_vertices(text, element, body, mesh), has_vertices = true;
    else if (element.name == "face")
      read_faces(text, element, body, mesh), has_faces = true;
    else
      skip_rows(element, body);
  }
  if (!has_vertices || !has_faces) text.fail("it needs the elements 'vertex' and 'face'");
  for (const geometry::Triangle& t : mesh.triangles)
    for (const Index v : t)
      if (v >= mesh.vertex_count())
        text.fail(fmt::format("a face uses vertex {}, but there are {} vertices, counted from 0", v,
                              mesh.vertex_count()));
  return mesh;
}

}  // namespace abradem::io::detail
