// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/case_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "abradem/core/units.h"

namespace abradem::io {
namespace {

template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <typename... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;  // clang 16 does not deduce aggregates

std::string format_vector(const Vec3& v, std::string_view unit) {
  if (unit.empty())
    return fmt::format("[{}, {}, {}]", core::format_number(v.x), core::format_number(v.y),
                       core::format_number(v.z));
  return fmt::format("[\"{}\", \"{}\", \"{}\"]", core::format_quantity(v.x, unit),
                     core::format_quantity(v.y, unit), core::format_quantity(v.z, unit));
}

std::string format_scalar(const Row& row, double value) {
  if (row.kind == Kind::length_unit) {
    for (const core::NamedUnit& u : core::named_units())
      if (u.unit.dimension == core::Dimension{.length = 1} &&
          core::parse_quantity(fmt::format("1 {}", u.symbol)).value == value)
        return fmt::format("\"{}\"", u.symbol);
  }
  if (row.unit.empty()) return core::format_number(value);
  return fmt::format("\"{}\"", core::format_quantity(value, row.unit));
}

/// A setup with one entry of everything, to read the defaults from.
Target target_with_defaults() {
  static simulation::Setup setup = [] {
    simulation::Setup s;
    s.materials.emplace_back();
    s.contacts.emplace_back();
    s.wear.emplace_back();
    s.walls.emplace_back().motion.rows.emplace_back();
    s.regions.emplace_back();
    s.particles.emplace_back();
    s.ploughing.emplace();
    s.insertions.emplace_back();
    s.shapes.emplace_back();
    s.shapes[0].spheres.emplace_back();
    s.shapes[0].fit.emplace();
    s.domain.emplace();
    s.measurement.emplace();
    s.measurement->wear_volume.emplace();
    s.measurement->depth.emplace();
    s.measurement->width.emplace();
    s.study.emplace();
    s.study->variations.emplace_back();
    return s;
  }();
  return {.setup = &setup,
          .material = setup.materials.data(),
          .contact = setup.contacts.data(),
          .wear = setup.wear.data(),
          .wall = setup.walls.data(),
          .motion = &setup.walls[0].motion,
          .motion_row = setup.walls[0].motion.rows.data(),
          .region = setup.regions.data(),
          .particle = setup.particles.data(),
          .insertion = setup.insertions.data(),
          .variation = setup.study->variations.data(),
          .shape = setup.shapes.data(),
          .sphere = setup.shapes[0].spheres.data()};
}

/// { k = 0.001, F0 = "2 N" }
std::string format_constants(const std::vector<core::NamedQuantity>& constants) {
  std::vector<std::string> items;
  for (const core::NamedQuantity& c : constants) {
    const std::string unit = core::si_unit(c.dimension);
    items.push_back(fmt::format(
        "{} = {}", toml_key(c.name),
        unit.empty() ? core::format_number(c.value) : toml_string(core::format_quantity(c.value, unit))));
  }
  return fmt::format("{{ {} }}", fmt::join(items, ", "));
}

/// { "wall.disc.mesh.size" = ["0.1 mm", "0.2 mm"] }
std::string format_varied(const Row& row, const std::vector<simulation::VariedKey>& keys) {
  std::string out;
  for (const simulation::VariedKey& k : keys) {
    const std::string values = fmt::format("{}", fmt::join(k.values, ", "));
    out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", toml_key(k.key),
                       row.kind == Kind::variations ? "[" + values + "]" : values);
  }
  return "{ " + out + " }";
}

}  // namespace

std::vector<const Row*> rows_of(const Section& section) {
  std::vector<const Row*> result;
  for (const Row& row : case_rows())
    if (row.section == section.path) result.push_back(&row);
  return result;
}

std::vector<const Section*> sections_in(const Section& section) {
  std::vector<const Section*> result;
  for (const Section& s : case_sections()) {
    if (s.path.empty()) continue;
    std::string_view parent = s.path;
    if (parent.ends_with(".*")) parent.remove_suffix(2);
    const std::size_t dot = parent.rfind('.');
    parent = dot == std::string_view::npos ? std::string_view{} : parent.substr(0, dot);
    if (parent == section.path) result.push_back(&s);
  }
  return result;
}

std::string_view own_word(const Section& section) {
  std::string_view path = section.path;
  if (path.ends_with(".*")) path.remove_suffix(2);
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

const Row* sibling(const Row& row, std::string_view key) {
  for (const Row& other : case_rows())
    if (other.section == row.section && other.key == key) return &other;
  return nullptr;
}

bool applies(const Row& row, const Target& target) {
  if (row.when.key.empty()) return true;
  const Row& decider = *sibling(row, row.when.key);
  const auto counts = [&](int index) {
    return std::ranges::find(row.when.values, decider.choices[static_cast<std::size_t>(index)]) !=
           row.when.values.end();
  };
  const Slot slot = decider.slot(target);
  if (const auto* several = std::get_if<ChoicesSlot>(&slot))
    return std::ranges::any_of(several->get(), counts);
  return counts(std::get<ChoiceSlot>(slot).get());
}

std::string describe_when(const Row& row) {
  if (row.when.key.empty()) return {};
  return fmt::format("{} = {}", row.when.key, fmt::join(row.when.values, " or "));
}

std::string describe_limits(const Row& row) {
  const Limits& l = row.limits;
  const std::string low = core::format_number(l.low), high = core::format_number(l.high);
  if (std::isinf(l.low) && std::isinf(l.high)) return {};
  if (std::isinf(l.high)) return fmt::format("{} {}", l.low_excluded ? ">" : ">=", low);
  if (!l.low_excluded && !l.high_excluded) return fmt::format("{} to {}", low, high);
  return fmt::format("{} {} and {} {}", l.low_excluded ? ">" : ">=", low, l.high_excluded ? "<" : "<=", high);
}

std::optional<std::string> default_text(const Row& row) {
  if (row.need != Need::has_default) return std::nullopt;
  return format_value(row, row.slot(target_with_defaults()));
}

std::optional<std::string> format_value(const Row& row, const Slot& slot) {
  using Text = std::optional<std::string>;
  return std::visit(Overloaded{
                        [&](std::monostate) -> Text {
                          return row.kind == Kind::version ? "1" : toml_string(row.choices.front());
                        },
                        [&](const std::string* text) -> Text {
                          if (row.need == Need::optional && text->empty()) return std::nullopt;
                          return toml_string(*text);
                        },
                        [&](const double* value) -> Text {
                          // What must be above 0 and is 0 was not given.
                          if (row.need == Need::optional && *value == 0.0 && row.limits.low_excluded)
                            return std::nullopt;
                          return format_scalar(row, *value);
                        },
                        [&](const std::optional<double>* value) -> Text {
                          return *value ? Text(format_scalar(row, **value)) : std::nullopt;
                        },
                        [&](const Vec3* v) -> Text { return format_vector(*v, row.unit); },
                        [](const int* value) -> Text { return std::to_string(*value); },
                        [](const std::uint64_t* value) -> Text { return std::to_string(*value); },
                        [](const simulation::Duration* d) -> Text {
                          return d->in_revolutions
                                     ? fmt::format("\"{} rev\"", core::format_number(d->value))
                                     : fmt::format("\"{}\"", core::format_quantity(d->value, "s"));
                        },
                        [](const simulation::TimeStep* step) -> Text {
                          if (!step->of_rayleigh)
                            return fmt::format("\"{}\"", core::format_quantity(step->value, "s"));
                          std::string percent = core::format_quantity(step->value, "%");
                          std::erase(percent, ' ');
                          return fmt::format("\"{} rayleigh\"", percent);
                        },
                        [](const simulation::Acceleration* a) -> Text {
                          return a->automatic ? "\"auto\"" : core::format_number(a->factor);
                        },
                        [&](const ChoiceSlot& choice) -> Text {
                          return toml_string(row.choices[static_cast<std::size_t>(choice.get())]);
                        },
                        [&](const ChoicesSlot& several) -> Text {
                          std::vector<std::string> names;
                          for (const int i : several.get())
                            names.push_back(toml_string(row.choices[static_cast<std::size_t>(i)]));
                          return names.size() == 1 ? names[0] : fmt::format("[{}]", fmt::join(names, ", "));
                        },
                        [](const std::vector<core::NamedQuantity>* constants) -> Text {
                          return constants->empty() ? std::nullopt : Text(format_constants(*constants));
                        },
                        [&](const std::vector<simulation::VariedKey>* keys) -> Text {
                          return keys->empty() ? std::nullopt : Text(format_varied(row, *keys));
                        },
                    },
                    slot);
}

std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string toml_key(std::string_view key) {
  const auto bare = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !key.empty() && std::ranges::all_of(key, bare) ? std::string(key) : toml_string(key);
}

}  // namespace abradem::io
