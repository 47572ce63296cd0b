// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/case_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "abradem/core/suggest.h"
#include "abradem/io/case_checks.h"
#include "abradem/io/case_problems.h"
#include "abradem/io/case_schema.h"
#include "abradem/io/case_study.h"
#include "abradem/io/case_toml.h"
#include "abradem/io/case_units.h"
#include "abradem/io/case_values.h"

namespace abradem::io {
namespace {

namespace fs = std::filesystem;

/// A number without its unit, or an array with one.
bool is_bare(const Value& value) {
  return value.type == Value::Type::integer || value.type == Value::Type::number ||
         std::ranges::any_of(value.items, is_bare);
}

/// Walks the table of sections and rows along the tree of the file.
class CaseReader {
 public:
  CaseReader(Problems& problems, Places& places) : problems_(problems), places_(places) {}

  void read_root(const Value& tree, simulation::Setup& setup) {
    Target target;
    target.setup = &setup;
    read_table(case_sections().front(), tree, {}, target, "");
  }

 private:
  static std::string join(const std::string& path, std::string_view key) {
    return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
  }
  static std::string header(const std::string& path) {
    return path.empty() ? "at the top of the file" : fmt::format("in [{}]", path);
  }

  void read_table(const Section& section, const Value& table, const Place& place, const Target& target,
                  const std::string& path) {
    refuse_unknown_keys(section, table, path);
    std::vector<std::string_view> used;
    for (const Row* row : rows_of(section)) read_row(*row, table, place, target, path, used);
    refuse_idle_keys(section, table, target, path, used);
    for (const Section* child : sections_in(section)) read_child(*child, table, place, target, path);
  }

  void refuse_unknown_keys(const Section& section, const Value& table, const std::string& path) {
    std::vector<std::string_view> known;
    for (const Row* row : rows_of(section)) {
      known.push_back(row->key);
      if (!row->also.empty()) known.push_back(row->also);
    }
    for (const Section* child : sections_in(section)) known.push_back(own_word(*child));
    for (const Entry& e : table.entries) {
      if (std::ranges::find(known, e.key) != known.end()) continue;
      const std::string nearest = core::nearest_spelling(e.key, known);
      std::string advice = nearest.empty() ? home_of(e.key) : fmt::format("; did you mean '{}'?", nearest);
      if (advice.empty()) advice = fmt::format("; known are {}", fmt::join(known, ", "));
      problems_.error(e.place, fmt::format("unknown key '{}' {}{}", e.key, header(path), advice));
    }
  }

  static std::string home_of(std::string_view key) {
    for (const Row& row : case_rows())
      if (row.key == key && !row.section.empty()) return fmt::format("; it belongs in [{}]", row.section);
    return {};
  }

  void read_row(const Row& row, const Value& table, const Place& place, const Target& target,
                const std::string& path, std::vector<std::string_view>& used) {
    if (!places_.good(join(path, row.when.key)) && !row.when.key.empty()) {
      used.push_back(row.key);  // what decides about the row is wrong itself: one message is enough
      if (!row.also.empty()) used.push_back(row.also);
      return;
    }
    if (!applies(row, target)) return;
    const Entry* entry = table.find(row.key);
    const Entry* other = row.also.empty() ? nullptr : table.find(row.also);
    if (entry != nullptr && other != nullptr)
      problems_.error(other->place, fmt::format("'{}' and '{}' are the same; give one", row.key, row.also));
    if (entry == nullptr) entry = other;
    const std::string key_path = join(path, row.key);
    if (entry == nullptr) {
      if (!row.implied_by.empty() && table.find(row.implied_by) != nullptr) {
        const auto implied = std::ranges::find(row.choices, row.implied_by) - row.choices.begin();
        std::get<ChoiceSlot>(row.slot(target)).set(static_cast<int>(implied));
      } else if (row.need == Need::required) {
        problems_.error(place, fmt::format("missing key '{}' {}: {} Example: {} = {}", row.key, header(path),
                                           row.doc, row.key, row.example));
        places_.set_wrong(key_path);
      }
      return;
    }
    used.push_back(entry->key);
    places_.set(key_path, entry->value.place);
    if (!row.unit.empty() && is_bare(entry->value)) places_.set_bare(key_path);
    if (!read_value(row, entry->value, target, problems_)) places_.set_wrong(key_path);
  }

  /// Keys that exist, but not for this shape or kind of motion.
  void refuse_idle_keys(const Section& section, const Value& table, const Target& target,
                        const std::string& path, const std::vector<std::string_view>& used) {
    for (const Row* row : rows_of(section)) {
      const Entry* entry = table.find(row->key);
      if (entry == nullptr || applies(*row, target) || std::ranges::find(used, entry->key) != used.end())
        continue;
      const Row& decider = *sibling(*row, row->when.key);
      problems_.error(entry->place, fmt::format("'{}' {} counts only where {}; here {} = {}", row->key,
                                                header(path), describe_when(*row), decider.key,
                                                *format_value(decider, decider.slot(target))));
    }
  }

  void read_child(const Section& section, const Value& parent, const Place& parent_place,
                  const Target& target, const std::string& parent_path) {
    const std::string_view word = own_word(section);
    const std::string path = join(parent_path, word);
    const Entry* entry = parent.find(word);
    if (entry == nullptr) {
      if (section.presence == Presence::required)
        problems_.error(parent_place, fmt::format("missing [{}]: {}", path, section.doc));
      if (section.presence == Presence::at_least_one)
        problems_.error(parent_place,
                        fmt::format("the case has no {}; add {}: {}", word,
                                    section.naming == Naming::list ? fmt::format("[[{}]]", path)
                                                                   : fmt::format("[{}.NAME]", path),
                                    section.doc));
      if (section.presence != Presence::optional) places_.set_wrong(path);
      return;
    }
    places_.set(path, entry->place);
    if (section.naming == Naming::one_or_list && entry->value.type == Value::Type::table) {
      Target inner = target;
      section.enter(inner, 0);
      read_table(section, entry->value, entry->place, inner, path);
      return;
    }
    if (section.naming == Naming::list || section.naming == Naming::one_or_list) {
      read_list(section, *entry, target, path);
      return;
    }
    if (entry->value.type != Value::Type::table) {
      problems_.error(entry->value.place, fmt::format("'{}' {} is a table, not a value: {}", word,
                                                      header(parent_path), section.doc));
      places_.set_wrong(path);
      return;
    }
    if (section.naming == Naming::none) {
      section.add(target);
      read_table(section, entry->value, entry->place, target, path);
      return;
    }
    if (entry->value.entries.empty() && section.presence == Presence::at_least_one) {
      problems_.error(entry->place,
                      fmt::format("the case has no {}; add [{}.NAME]: {}", word, path, section.doc));
      places_.set_wrong(path);
    }
    for (const Entry& named : entry->value.entries) read_named(section, named, target, path);
  }

  /// [[path]], as often as it stands there.
  void read_list(const Section& section, const Entry& entry, const Target& target, const std::string& path) {
    const auto is_table = [](const Value& item) { return item.type == Value::Type::table; };
    if (entry.value.type != Value::Type::array || entry.value.items.empty() ||
        !std::ranges::all_of(entry.value.items, is_table)) {
      problems_.error(
          entry.value.place,
          fmt::format("'{}' is {}a list of tables, each under [[{}]]: {}", entry.key,
                      section.naming == Naming::one_or_list ? "a table or " : "", path, section.doc));
      places_.set_wrong(path);
      return;
    }
    // The one of one_or_list is there from the start.
    bool there = section.naming == Naming::one_or_list;
    for (const Value& item : entry.value.items) {
      if (!there) section.add(target);
      there = false;
      Target inner = target;
      section.enter(inner, section.count(inner) - 1);
      const std::string item_path = fmt::format("{}[{}]", path, section.count(inner));
      places_.set(item_path, item.place);
      read_table(section, item, item.place, inner, item_path);
    }
  }

  void read_named(const Section& section, const Entry& named, const Target& target, const std::string& path) {
    const std::string full = join(path, toml_key(named.key));
    places_.set(full, named.place);
    if (named.value.type != Value::Type::table) {
      const std::string sample = section.naming == Naming::pair ? "\"NAME/NAME\"" : "NAME";
      problems_.error(named.place,
                      fmt::format("'{}' cannot stand directly in [{}]; it needs a table with a name, [{}.{}]",
                                  named.key, path, path, sample));
      places_.set_wrong(path);
      return;
    }
    if (!good_name(section, named, path)) {
      places_.set_wrong(path);
      return;
    }
    section.add(target);
    Target inner = target;
    section.enter(inner, section.count(inner) - 1);
    section.rename(inner, named.key);
    read_table(section, named.value, named.place, inner, full);
  }

  bool good_name(const Section& section, const Entry& named, const std::string& path) {
    const std::string& name = named.key;
    const auto slashes = std::ranges::count(name, '/');
    if (section.naming == Naming::pair) {
      if (slashes == 1 && name.front() != '/' && name.back() != '/') return true;
      problems_.error(named.place,
                      fmt::format("'{}' is not a pair; [{}.…] is named by two materials, such as "
                                  "[{}.\"iron_ore/mild_steel\"]",
                                  name, path, path));
      return false;
    }
    const bool control =
        std::ranges::any_of(name, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
    if (!name.empty() && slashes == 0 && !control) return true;
    problems_.error(named.place, fmt::format("'{}' cannot be a name: it is empty or has a '/' in it", name));
    return false;
  }

  Problems& problems_;
  Places& places_;
};

std::string read_text(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  const std::string name = path.string();
  if (!fs::exists(status))
    throw InputError(fmt::format(
        "case file '{}' does not exist; 'abradem new pin-on-disc {}' writes one to start from", name, name));
  if (fs::is_directory(status))
    throw InputError(fmt::format("'{}' is a folder; expected a case file (TOML), such as {}", name,
                                 (path / "case.toml").string()));
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("case file '{}' cannot be opened: {}", name, std::strerror(errno)));
  constexpr std::size_t kLargest = std::size_t{16} << 20;  // a page of text; stops a mesh or /dev/zero
  constexpr std::size_t kBlock = 1 << 14;
  std::string text;
  while (file && text.size() <= kLargest) {
    const std::size_t old = text.size();
    text.resize(old + kBlock);
    file.read(text.data() + old, kBlock);
    text.resize(old + static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad())
    throw InputError(fmt::format("case file '{}' cannot be read: {}", name, std::strerror(errno)));
  if (text.size() > kLargest)
    throw InputError(fmt::format("'{}' is larger than 16 MB; it is no case file", name));
  return text;
}

void refuse_what_is_no_text(std::string_view text, const std::string& name) {
  if (text.find_first_not_of(" \t\r\n\xEF\xBB\xBF") == std::string_view::npos)
    throw InputError(
        fmt::format("case file '{}' is empty; 'abradem new pin-on-disc' writes one to start from", name));
  if (text.find('\0') != std::string_view::npos)
    throw InputError(fmt::format("'{}' is not a text file; expected a case file (TOML)", name));
}

/// The setup of a tree; what is wrong with it goes to `problems`.
simulation::Setup read_tree(const Value& tree, const fs::path& folder, Problems& problems, NamedFiles files) {
  simulation::Setup setup;
  Places places;
  if (files == NamedFiles::kept) places.keep_files();
  CaseReader(problems, places).read_root(tree, setup);
  const auto made_absolute = [&](std::string& file) {
    if (!file.empty()) file = fs::absolute(folder / file).lexically_normal().string();
  };
  for (simulation::WallSetup& wall : setup.walls) {
    made_absolute(wall.mesh.file);
    made_absolute(wall.motion.file);
    for (simulation::MotionSetup& motion : wall.carried_by) made_absolute(motion.file);
  }
  for (simulation::InsertionSetup& insertion : setup.insertions) {
    made_absolute(insertion.size.file);
    made_absolute(insertion.volume.file);
    made_absolute(insertion.volume.run);
  }
  for (simulation::ShapeSetup& shape : setup.shapes)
    if (shape.fit) made_absolute(shape.fit->file);
  if (setup.study) made_absolute(setup.study->published);
  // A named pin was measured with patches; a plant's walls have triangles of any size.
  if (std::ranges::all_of(setup.particles, [](const auto& p) { return !p.shape.empty(); }))
    for (simulation::WallSetup& wall : setup.walls)
      if (!places.given(fmt::format("wall.{}.contact", toml_key(wall.name))) &&
          wall.deformation != simulation::DeformationRule::paper)
        wall.contact = wall.sides == simulation::Sides::both || adheres(setup, wall)
                           ? simulation::ContactRule::resolved
                           : simulation::ContactRule::automatic;
  // The default of one frame per revolution has no meaning where nothing turns.
  constexpr double kFrames = 10.0;
  if (!places.given("output.every") && !counts_revolutions(setup))
    setup.output.every = {setup.run.end.value / kFrames, false};
  check_case(setup, places, problems);
  check_units(setup, places, problems);
  return setup;
}

enum class Study { read, leave_out };

void leave_out_study(Value& tree) {
  std::erase_if(tree.entries, [](const Entry& e) { return e.key == "study"; });
}

Case parse(std::string_view text, const std::string& name, const fs::path& folder,
           std::span<const std::string> overrides, Study study, NamedFiles files) {
  refuse_what_is_no_text(text, name);
  Problems problems(name, std::string(text));
  Value tree = parse_toml(text, problems);
  problems.throw_if_any();  // nothing behind a syntax error can be trusted
  const Value base = tree;
  std::vector<Value> changes;
  for (const std::string& assignment : overrides) {
    changes.push_back(parse_override(assignment, problems));
    lay_over(tree, changes.back(), problems);
  }
  if (study == Study::leave_out) leave_out_study(tree);

  Case result;
  result.text = text;
  result.setup = read_tree(tree, folder, problems, files);
  if (result.setup.study)
    check_study(tree, base, changes, *result.setup.study, problems,
                [&](const Value& run) { static_cast<void>(read_tree(run, folder, problems, files)); });
  problems.throw_if_any();
  result.notes = problems.notes();
  return result;
}

}  // namespace

Case parse_case(std::string_view text, const std::string& name, const fs::path& folder,
                std::span<const std::string> overrides, NamedFiles files) {
  return parse(text, name, folder, overrides, Study::read, files);
}

Case load_single_run(const fs::path& path, std::span<const std::string> overrides) {
  return parse(read_text(path), path.string(), path.parent_path(), overrides, Study::leave_out,
               NamedFiles::needed);
}

Case load_case(const fs::path& path, std::span<const std::string> overrides) {
  return parse_case(read_text(path), path.string(), path.parent_path(), overrides);
}

simulation::Setup read_case(const fs::path& path, std::span<const std::string> overrides) {
  return load_case(path, overrides).setup;
}

}  // namespace abradem::io
