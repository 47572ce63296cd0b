// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "abradem/geometry/triangle_mesh.h"

/// What the readers of mesh files share. Not part of the public interface.
namespace abradem::io::detail {

/// The content of a mesh file and its name for messages.
struct MeshText {
  std::string name;
  std::string_view data;

  /// Throws GeometryError("cannot read mesh 'name': what").
  [[noreturn]] void fail(const std::string& what) const;
};

/// Words of a text, separated by white space; knows the line it is on.
class WordReader {
 public:
  explicit WordReader(const MeshText& text, std::size_t position = 0, int line = 1)
      : text_(text), position_(position), line_(line) {}

  /// The next word, on any line; empty at the end.
  std::string_view word();
  /// The next word of this line; empty at its end. `next_line` goes on.
  std::string_view word_in_line();
  void next_line();
  [[nodiscard]] bool at_end() const noexcept { return position_ >= text_.data.size(); }
  [[nodiscard]] std::size_t position() const noexcept { return position_; }
  [[nodiscard]] std::size_t remaining() const noexcept { return text_.data.size() - position_; }

  /// A finite number. @throws GeometryError naming the line, what was expected and what is there
  double number(std::string_view word, std::string_view what) const;
  /// The same, but infinite and not-a-number pass.
  double any_number(std::string_view word, std::string_view what) const;
  std::int64_t integer(std::string_view word, std::string_view what) const;
  [[noreturn]] void fail(const std::string& what) const;

 private:
  const MeshText& text_;
  std::size_t position_;
  int line_;
};

/// At most 40 printable characters of something that may be binary, for messages.
[[nodiscard]] std::string shown(std::string_view word);

[[nodiscard]] bool equals_ignoring_case(std::string_view a, std::string_view b) noexcept;

/// Cuts a polygon into a fan of triangles. @throws GeometryError beyond what Index can number
void add_polygon(geometry::TriangleMesh& mesh, std::span<const geometry::Index> corners);

// The readers, in file units; indices are checked, coordinates finite.
[[nodiscard]] geometry::TriangleMesh read_stl(const MeshText& text);
[[nodiscard]] geometry::TriangleMesh read_obj(const MeshText& text);
[[nodiscard]] geometry::TriangleMesh read_ply(const MeshText& text);

}  // namespace abradem::io::detail
