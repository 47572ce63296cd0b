// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/csv.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "abradem/core/error.h"
#include "abradem/io/atomic_file.h"

namespace abradem::io {

namespace {

bool is_name(std::string_view text) noexcept {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

/// What is wrong with the header; empty when nothing is.
std::string header_problem(std::span<const std::string> columns) {
  if (columns.empty()) return "no columns; at least one is needed";
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (!is_name(columns[c]))
      return fmt::format("column {} is named '{}'; letters, digits and _ are expected, as in depth_mm", c + 1,
                         columns[c]);
    if (std::find(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(c), columns[c]) !=
        columns.begin() + static_cast<std::ptrdiff_t>(c))
      return fmt::format("column '{}' is there twice; rename one", columns[c]);
  }
  return {};
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

std::string read_csv_text(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw IoError(fmt::format("'{}': no such file; expected a table in CSV", path.string()));
  if (!std::filesystem::is_regular_file(path, ignored))
    throw IoError(fmt::format("'{}': not a file; expected a table in CSV", path.string()));
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw IoError(fmt::format("'{}': cannot be read; check its permissions", path.string()));
  return text;
}

CsvWriter::CsvWriter(std::filesystem::path path, std::vector<std::string> columns)
    : path_(std::move(path)), temporary_(path_), columns_(std::move(columns)) {
  if (const std::string problem = header_problem(columns_); !problem.empty())
    throw InputError(fmt::format("table '{}': {}", path_.string(), problem));
  temporary_ += fmt::format(".{}.tmp", getpid());
  file_ = std::fopen(temporary_.c_str(), "wb");
  if (file_ == nullptr) fail("create", errno);
  line_ = fmt::format("{}\n", fmt::join(columns_, ","));
  if (std::fwrite(line_.data(), 1, line_.size(), file_) != line_.size()) fail("write", errno);
}

CsvWriter::CsvWriter(std::filesystem::path path, std::vector<std::string> columns, Growing growing)
    : path_(std::move(path)), columns_(std::move(columns)) {
  if (const std::string problem = header_problem(columns_); !problem.empty())
    throw InputError(fmt::format("table '{}': {}", path_.string(), problem));
  line_ = fmt::format("{}\n", fmt::join(columns_, ","));
  if (growing.from == 0) write_file_atomically(path_, line_);  // never without its header
  file_ = std::fopen(path_.c_str(), "rb+");
  if (file_ == nullptr) fail("go on with", errno);
  if (growing.from == 0) growing.from = line_.size();
  std::string header(line_.size(), '\0');
  const bool same = std::fread(header.data(), 1, header.size(), file_) == header.size() && header == line_;
  const bool long_enough =
      std::fseek(file_, static_cast<long>(growing.from) - 1, SEEK_SET) == 0 && std::fgetc(file_) == '\n';
  if (!same || !long_enough) {
    discard();
    throw IoError(fmt::format("table '{}' is not what it was when the checkpoint was written{}",
                              path_.string(), same ? ": rows are missing" : ""));
  }
  if (ftruncate(fileno(file_), static_cast<off_t>(growing.from)) != 0) fail("go on with", errno);
  written_ = growing.from;
}

CsvWriter::~CsvWriter() {
  if (temporary_.empty() && file_ != nullptr) {
    try {
      flush();
    } catch (const IoError&) {
      // Whoever needs the rows calls close(), and hears of it.
    }
  }
  discard();
}

void CsvWriter::row(std::span<const double> values) {
  if (file_ == nullptr) throw InputError(fmt::format("table '{}': a row after close()", path_.string()));
  if (values.size() != columns_.size())
    throw InputError(fmt::format("table '{}': a row of {} values for {} columns", path_.string(),
                                 values.size(), columns_.size()));
  line_.clear();
  for (const double value : values) {
    if (value != value)
      line_ += "nan";  // without the sign that formatting would keep
    else
      fmt::format_to(std::back_inserter(line_), "{}", value);
    line_ += ',';
  }
  line_.back() = '\n';
  if (temporary_.empty()) {
    constexpr std::size_t kMost = 1 << 16;
    waiting_ += line_;
    if (waiting_.size() > kMost) flush();
    return;
  }
  if (std::fwrite(line_.data(), 1, line_.size(), file_) != line_.size()) fail("write", errno);
}

/// By write() alone: rows reach the file whole, however the program ends.
void CsvWriter::flush() {
  const int file = fileno(file_);
  for (std::size_t at = 0; at < waiting_.size();) {
    const ssize_t n =
        pwrite(file, waiting_.data() + at, waiting_.size() - at, static_cast<off_t>(written_ + at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      const int error = errno;
      waiting_.clear();
      [[maybe_unused]] const int cut = ftruncate(file, static_cast<off_t>(written_));  // no part of a row
      fail("write", error);
    }
    at += static_cast<std::size_t>(n);
  }
  written_ += waiting_.size();
  waiting_.clear();
}

void CsvWriter::sync() {
  flush();
  if (fsync(fileno(file_)) != 0 && errno != EINVAL && errno != EROFS) fail("write", errno);
}

void CsvWriter::close() {
  if (file_ == nullptr) throw InputError(fmt::format("table '{}': closed twice", path_.string()));
  if (temporary_.empty()) flush();
  const bool closed = std::fclose(std::exchange(file_, nullptr)) == 0;  // a full disk may show only here
  if (!closed) fail("write", errno);
  if (temporary_.empty()) return;
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) fail("write", error.value());
  temporary_.clear();
}

void CsvWriter::fail(const char* doing, int error) {
  discard();
  throw IoError(fmt::format("cannot {} table '{}': {}; check the folder, its permissions and the space left",
                            doing, path_.string(), std::generic_category().message(error)));
}

void CsvWriter::discard() noexcept {
  if (file_ != nullptr) std::fclose(std::exchange(file_, nullptr));
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

std::vector<double> CsvTable::column(std::string_view name) const {
  const auto found = std::ranges::find(columns, name);
  if (found == columns.end())
    throw InputError(fmt::format("no column '{}' in the table; it has {}", name, fmt::join(columns, ", ")));
  std::vector<double> out;
  for (auto i = static_cast<std::size_t>(found - columns.begin()); i < values.size(); i += columns.size())
    out.push_back(values[i]);
  return out;
}

CsvTable read_csv(const std::filesystem::path& path) { return parse_csv(read_csv_text(path), path.string()); }

CsvTable parse_csv(std::string_view text, const std::string& name) {
  const auto refuse = [&](std::size_t line, const std::string& what) {
    throw IoError(fmt::format("{}:{}: {}", name, line, what));
  };
  if (text.empty()) refuse(1, "the file is empty; expected a header line with the names of the columns");
  CsvTable table;
  std::string_view rest = text;
  for (std::size_t line = 1; !rest.empty(); ++line) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) refuse(line, "the last line has no end; the file was cut short");
    const std::vector<std::string_view> fields = split(rest.substr(0, end));
    rest.remove_prefix(end + 1);
    if (line == 1) {
      table.columns.assign(fields.begin(), fields.end());
      if (const std::string problem = header_problem(table.columns); !problem.empty()) refuse(line, problem);
      continue;
    }
    if (fields.size() != table.columns.size())
      refuse(line, fmt::format("{} fields where the header names {}", fields.size(), table.columns.size()));
    for (std::size_t c = 0; c < fields.size(); ++c) {
      double value = 0.0;
      const char* const last = fields[c].data() + fields[c].size();
      const auto [stop, error] = std::from_chars(fields[c].data(), last, value);
      if (error != std::errc{} || stop != last)
        refuse(line,
               fmt::format("column '{}': '{}' is not a number", table.columns[c], fields[c].substr(0, 40)));
      table.values.push_back(value);
    }
  }
  return table;
}

}  // namespace abradem::io
