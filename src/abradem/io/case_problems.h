// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "abradem/core/error.h"
#include "abradem/io/case_value.h"

namespace abradem::io {

/// One thing wrong with a case, or worth knowing (a note).
struct Problem {
  Place place;
  std::string message;
};

/// A case that cannot be used: every problem found, in the order of the file. what() is the whole text to
/// print, compiler style, with source lines and carets.
struct CaseError : InputError {
  CaseError(const std::string& text, std::vector<Problem> found)
      : InputError(text), problems(std::move(found)) {}
  std::vector<Problem> problems;
};

/// Collects problems and prints them with the lines they are in.
class Problems {
 public:
  /// @param name as the messages show it, normally the path as the user typed it   @param text the whole file
  Problems(std::string name, std::string text);

  /// Adds an override (`--set KEY=VALUE`) as a source. @return its number, for Place::source
  int add_source(std::string text);

  void error(const Place& place, std::string message);
  void note(const Place& place, std::string message);

  [[nodiscard]] bool empty() const noexcept { return errors_.empty(); }
  /// The notes, each printed like an error but called a note.
  [[nodiscard]] std::vector<std::string> notes() const;
  /// @throws CaseError when there is an error
  void throw_if_any();

 private:
  static void add(std::vector<Problem>& list, const Place& place, std::string message);
  struct Source {
    std::string name;
    std::string text;
  };
  [[nodiscard]] std::string render(const Problem& problem, const char* kind) const;
  [[nodiscard]] std::string line_of(const Place& place) const;

  std::vector<Source> sources_;
  std::vector<Problem> errors_;
  std::vector<Problem> notes_;
};

}  // namespace abradem::io
