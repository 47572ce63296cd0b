// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/case_problems.h"

#include <fmt/core.h>

#include <algorithm>
#include <tuple>

namespace abradem::io {

const Entry* Value::find(std::string_view key) const noexcept {
  for (const Entry& e : entries)
    if (e.key == key) return &e;
  return nullptr;
}

Entry* Value::find(std::string_view key) noexcept {
  for (Entry& e : entries)
    if (e.key == key) return &e;
  return nullptr;
}

Problems::Problems(std::string name, std::string text) {
  sources_.push_back({std::move(name), std::move(text)});
}

int Problems::add_source(std::string text) {
  sources_.push_back({"--set", std::move(text)});
  return static_cast<int>(sources_.size()) - 1;
}

void Problems::error(const Place& place, std::string message) { add(errors_, place, std::move(message)); }

void Problems::note(const Place& place, std::string message) { add(notes_, place, std::move(message)); }

/// The runs of a study share most of their case: what is wrong with it is said once.
void Problems::add(std::vector<Problem>& list, const Place& place, std::string message) {
  const auto same = [&](const Problem& p) {
    return p.message == message && p.place.source == place.source && p.place.line == place.line &&
           p.place.column == place.column;
  };
  if (std::ranges::none_of(list, same)) list.push_back({place, std::move(message)});
}

std::vector<std::string> Problems::notes() const {
  std::vector<std::string> result;
  for (const Problem& note : notes_) result.push_back(render(note, "note"));
  return result;
}

void Problems::throw_if_any() {
  if (errors_.empty()) return;
  std::stable_sort(errors_.begin(), errors_.end(), [](const Problem& a, const Problem& b) {
    return std::tie(a.place.source, a.place.line, a.place.column) <
           std::tie(b.place.source, b.place.line, b.place.column);
  });
  constexpr std::size_t kShown = 40;  // a screen or two; a file with more is usually wrong in one way
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, errors_.size()); ++i) text += render(errors_[i], "error");
  if (errors_.size() > kShown) text += fmt::format("… and {} more\n", errors_.size() - kShown);
  const std::size_t n = errors_.size();
  text += fmt::format("{}: {} error{}", sources_.front().name, n, n == 1 ? "" : "s");
  throw CaseError(text, errors_);
}

std::string Problems::line_of(const Place& place) const {
  const std::string& text = sources_[static_cast<std::size_t>(place.source)].text;
  std::size_t start = 0;
  for (int line = 1; line < place.line; ++line) {
    start = text.find('\n', start);
    if (start == std::string::npos) return {};
    ++start;
  }
  std::string line = text.substr(start, text.find('\n', start) - start);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

std::string Problems::render(const Problem& problem, const char* kind) const {
  const Place& place = problem.place;
  const std::string& name = sources_[static_cast<std::size_t>(place.source)].name;
  if (place.line == 0) return fmt::format("{}: {}: {}\n", name, kind, problem.message);
  // An override is one line of its own; a line number would only mislead.
  const std::string where =
      place.source == 0 ? fmt::format("{}:{}:{}", name, place.line, place.column) : name;
  const std::string line = line_of(place);
  std::string result = fmt::format("{}: {}: {}\n", where, kind, problem.message);
  constexpr std::size_t kWidest = 400;  // a longer line is no line a person wrote
  if (line.empty() || line.size() > kWidest) return result;
  // Tabs are copied so that the caret stands under its column; UTF-8 continuation bytes take no column.
  std::string padding;
  int column = 1;
  for (const char c : line) {
    if ((c & 0xC0) == 0x80) continue;
    if (column++ >= place.column) break;
    padding += c == '\t' ? '\t' : ' ';
  }
  result += fmt::format("    {}\n    {}^\n", line, padding);
  return result;
}

}  // namespace abradem::io
