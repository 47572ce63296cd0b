// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/mesh_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "abradem/core/error.h"

namespace abradem::io::detail {

namespace {

bool is_space(char c) noexcept { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

template <class Number>
bool parse(std::string_view word, Number& value) noexcept {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size();
}

}  // namespace

std::string shown(std::string_view word) {
  std::string result;
  for (const char c : word.substr(0, 40)) result += c >= ' ' && c <= '~' ? c : '?';
  return word.size() > 40 ? result + "…" : result;
}

void MeshText::fail(const std::string& what) const {
  throw GeometryError(fmt::format("cannot read mesh '{}': {}", name, what));
}

std::string_view WordReader::word_in_line() {
  const std::string_view data = text_.data;
  while (position_ < data.size() && is_space(data[position_])) ++position_;
  const std::size_t begin = position_;
  while (position_ < data.size() && data[position_] != '\n' && !is_space(data[position_])) ++position_;
  return data.substr(begin, position_ - begin);
}

std::string_view WordReader::word() {
  for (;;) {
    const std::string_view found = word_in_line();
    if (!found.empty() || at_end()) return found;
    next_line();
  }
}

void WordReader::next_line() {
  const std::size_t end = text_.data.find('\n', position_);
  position_ = end == std::string_view::npos ? text_.data.size() : end + 1;
  ++line_;
}

void WordReader::fail(const std::string& what) const { text_.fail(fmt::format("line {}: {}", line_, what)); }

double WordReader::any_number(std::string_view word, std::string_view what) const {
  double value = 0.0;
  if (word.empty())
    fail(fmt::format("expected {}, but {}", what, at_end() ? "the file ends" : "the line ends"));
  if (!parse(word, value)) fail(fmt::format("expected {}, found '{}'", what, shown(word)));
  return value;
}

double WordReader::number(std::string_view word, std::string_view what) const {
  const double value = any_number(word, what);
  if (!std::isfinite(value)) fail(fmt::format("{} is '{}'; expected a finite number", what, shown(word)));
  return value;
}

std::int64_t WordReader::integer(std::string_view word, std::string_view what) const {
  std::int64_t value = 0;
  if (word.empty())
    fail(fmt::format("expected {}, but {}", what, at_end() ? "the file ends" : "the line ends"));
  if (!parse(word, value)) fail(fmt::format("expected {}, found '{}'", what, shown(word)));
  return value;
}

bool equals_ignoring_case(std::string_view a, std::string_view b) noexcept {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::ranges::equal(a, b, {}, lower, lower);
}

void add_polygon(geometry::TriangleMesh& mesh, std::span<const geometry::Index> corners) {
  if (mesh.triangles.size() + corners.size() > std::size_t{std::numeric_limits<geometry::Index>::max()})
    throw GeometryError("cannot read a mesh of more than 2^31 triangles: coarsen it");
  for (std::size_t k = 2; k < corners.size(); ++k)
    mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
}

}  // namespace abradem::io::detail
