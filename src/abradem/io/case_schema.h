// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "abradem/simulation/setup.h"

/// The one table of what a case file may say. Reading, validation, defaults, the resolved case, the JSON
/// Schema and the reference page all walk it; a new key is one new row (and, where it matters to others, a
/// check in case_checks.cpp). Defaults are the member initialisers of setup.h: there is no second place for
/// them.
namespace abradem::io {

/// Where in a Setup one is: the entry of each list that the rows of a section write to.
struct Target {
  simulation::Setup* setup = nullptr;
  simulation::MaterialSetup* material = nullptr;
  simulation::ContactSetup* contact = nullptr;
  simulation::WearSetup* wear = nullptr;
  simulation::WallSetup* wall = nullptr;
  simulation::MotionSetup* motion = nullptr;
  simulation::MotionRow* motion_row = nullptr;
  simulation::RegionSetup* region = nullptr;
  simulation::ParticleSetup* particle = nullptr;
  simulation::InsertionSetup* insertion = nullptr;
  simulation::VariationSetup* variation = nullptr;
  simulation::ShapeSetup* shape = nullptr;
  geometry::Ball* sphere = nullptr;
};

/// An enumeration behind its index in Row::choices.
struct ChoiceSlot {
  std::function<int()> get;
  std::function<void(int)> set;
};

/// A list of enumerations behind their indices in Row::choices.
struct ChoicesSlot {
  std::function<std::vector<int>()> get;
  std::function<void(const std::vector<int>&)> set;
};

/// The member a row fills. monostate: nothing to store, the key has one allowed value.
using Slot = std::variant<std::monostate, std::string*, double*, std::optional<double>*, Vec3*, int*,
                          std::uint64_t*, simulation::Duration*, simulation::TimeStep*, ChoiceSlot,
                          ChoicesSlot, std::vector<simulation::VariedKey>*, simulation::Acceleration*,
                          std::vector<core::NamedQuantity>*>;

enum class Kind {
  text,          ///< any text
  file,          ///< path of a file, relative to the folder of the case
  material,      ///< name of a [material.…]
  choice,        ///< one of Row::choices
  choices,       ///< one or several of Row::choices
  version,       ///< of the case format
  quantity,      ///< a number of the dimension of Row::unit
  integer,       ///< a whole number
  vector,        ///< three quantities
  direction,     ///< three plain numbers, not all zero; stored with length 1
  force_down,    ///< a vector, or one quantity along -z
  along_axis,    ///< a vector, or one quantity along the axis of the motion
  duration,      ///< a time or a number of revolutions
  time_step,     ///< a time or a percentage of the Rayleigh time
  acceleration,  ///< a number, or "auto"
  length_unit,   ///< a unit of length ("mm")
  changes,       ///< keys of the case, each with a value
  variations,    ///< keys of the case, each with a list of values
  constants,     ///< names that the user chooses, each with a quantity of any dimension
};

enum class Need { required, has_default, optional };

struct Limits {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false, high_excluded = false;
};

/// The key counts only where another key of the same table has one of these values (or holds one, where it is
/// a list).
struct When {
  std::string_view key;
  std::span<const std::string_view> values;
};

struct Row {
  std::string_view section;  ///< path of its section
  std::string_view key;
  Kind kind = Kind::quantity;
  Need need = Need::required;
  Slot (*slot)(const Target&) = nullptr;
  std::string_view unit = {};  ///< as shown; its dimension is the one checked; empty: dimensionless
  Limits limits = {};
  std::span<const std::string_view> choices = {};
  When when = {};
  std::string_view also = {};          ///< another spelling of the key
  std::string_view implied_by = {};    ///< a missing choice is the one of this name where this key is given
  std::string_view default_note = {};  ///< where the default is worked out from other keys: how
  std::string_view example = {};       ///< as written in the file
  std::string_view doc = {};           ///< one sentence
};

enum class Presence { required, optional, at_least_one };
/// [run], [wall.NAME], [contact."NAME/NAME"], [[study.variation]], [wall.NAME.motion] or [[wall.NAME.motion]]
enum class Naming { none, name, pair, list, one_or_list };

struct Section {
  std::string_view path;  ///< "wall.*.mesh"; "*" stands for the name; the root is empty
  std::string_view doc;
  Presence presence = Presence::optional;
  Naming naming = Naming::none;
  std::size_t (*count)(const Target&) = nullptr;  ///< how many the setup has
  void (*add)(const Target&) = nullptr;           ///< makes room for one more
  void (*enter)(Target&, std::size_t) = nullptr;  ///< points the target at the i-th
  std::string (*name)(const Target&) = nullptr;   ///< of the entry the target points at; pairs as "a/b"
  void (*rename)(const Target&, const std::string&) = nullptr;
};

[[nodiscard]] std::span<const Section> case_sections();
[[nodiscard]] std::span<const Row> case_rows();
/// The rows of one section, in the order of the table.
[[nodiscard]] std::vector<const Row*> rows_of(const Section& section);
/// Sections directly inside this one.
[[nodiscard]] std::vector<const Section*> sections_in(const Section& section);
/// The word a section is known by in its parent: "mesh" for "wall.*.mesh", "wall" for "wall.*".
[[nodiscard]] std::string_view own_word(const Section& section);
/// The row of this key in the row's own section; nullptr where there is none.
[[nodiscard]] const Row* sibling(const Row& row, std::string_view key);
/// Whether the row counts for this target (see When).
[[nodiscard]] bool applies(const Row& row, const Target& target);
/// "shape = annulus or disc"; empty for a row that always counts.
[[nodiscard]] std::string describe_when(const Row& row);
/// "> 0", "0 to 1"; empty where everything finite is allowed. In the unit the row shows.
[[nodiscard]] std::string describe_limits(const Row& row);
/// The default as it would be written in the file; nullopt where there is none.
[[nodiscard]] std::optional<std::string> default_text(const Row& row);
/// The value of a row as TOML, reading back to the same bits; nullopt for an optional one that is not set.
[[nodiscard]] std::optional<std::string> format_value(const Row& row, const Slot& slot);
/// Text as a TOML (and JSON) basic string with its quotes.
[[nodiscard]] std::string toml_string(std::string_view text);
/// A key as TOML writes it: bare where that is allowed, else quoted.
[[nodiscard]] std::string toml_key(std::string_view key);

/// The table as documents: docs/reference/case-file.md, and a JSON Schema (draft 2020-12) for editors.
[[nodiscard]] std::string case_reference_markdown();
[[nodiscard]] std::string case_json_schema();

}  // namespace abradem::io
