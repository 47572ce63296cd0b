// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/profiles_csv.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string_view>
#include <tuple>

#include "abradem/core/error.h"
#include "abradem/io/measured_table.h"

namespace abradem::io {

namespace {

using namespace std::string_view_literals;

constexpr core::Dimension kLength{.length = 1}, kAngle{.angle = 1}, kNone{};
constexpr std::array kRadiusNames{"radius"sv, "x"sv, "position"sv, "distance"sv};
constexpr std::array kHeightNames{"height"sv, "z"sv};
constexpr std::array kRevolutionNames{"revolution"sv, "revolutions"sv};
constexpr std::array kAngleNames{"angle"sv};
constexpr std::array kSectionNames{"section"sv};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The column, or NaN in every row where the table has none.
std::vector<double> optional(const MeasuredTable& table, std::span<const std::string_view> names,
                             const core::Dimension& dimension) {
  return table.find(names) ? table.quantities(names, dimension) : std::vector<double>(table.rows(), kNan);
}

/// Rows as an instrument that went backwards wrote them are turned; anything else must ascend.
void put_in_order(ReadSection& section, const MeasuredTable& table, std::size_t first_row) {
  auto& profile = section.profile;
  const std::size_t column = *table.find(kRadiusNames);
  if (profile.size() < 2)
    throw IoError(table.at(first_row, column, "a section of one point; 2 or more are needed"));
  const bool backwards = profile[1].radius < profile[0].radius;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const double step = profile[i].radius - profile[i - 1].radius;
    if (!(backwards ? step < 0.0 : step > 0.0))
      throw IoError(table.at(
          first_row + i, column,
          fmt::format("{} follows {} mm; the points of a section must go one way along it, none twice "
                      "(several sections need a column 'section', 'angle' or 'revolution')",
                      fmt::format("{:g}", 1e3 * profile[i].radius),
                      fmt::format("{:g}", 1e3 * profile[i - 1].radius))));
  }
  if (backwards) std::ranges::reverse(profile);
}

}  // namespace

std::vector<ReadSection> read_profiles(const std::filesystem::path& path) {
  const MeasuredTable table(path);
  const std::vector<double> radius = table.quantities(kRadiusNames, kLength),
                            height = table.quantities(kHeightNames, kLength);
  const std::vector<double> revolution = optional(table, kRevolutionNames, kNone),
                            angle = optional(table, kAngleNames, kAngle);
  const std::vector<std::string> name =
      table.find(kSectionNames) ? table.texts(kSectionNames) : std::vector<std::string>(table.rows());
  const auto key = [&](std::size_t r) {
    const auto told = [](double x) { return std::isnan(x) ? -std::numeric_limits<double>::infinity() : x; };
    return std::tuple{told(revolution[r]), told(angle[r]), name[r]};
  };

  std::vector<ReadSection> out;
  std::set<std::tuple<double, double, std::string>> seen;
  std::size_t first = 0;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    if (r == 0 || key(r) != key(r - 1)) {
      if (!out.empty()) put_in_order(out.back(), table, first);
      if (!seen.insert(key(r)).second)
        throw IoError(
            fmt::format("{}:{}: a section that has ended begins again; keep the rows of a section together",
                        table.file(), table.line(r)));
      first = r;
      std::string label = path.filename().string();
      if (!std::isnan(revolution[r])) label += fmt::format(", revolution {:g}", revolution[r]);
      if (!std::isnan(angle[r])) label += fmt::format(", {:g} deg", angle[r] * 180.0 / std::numbers::pi);
      if (!name[r].empty()) label += ", " + name[r];
      out.push_back({std::move(label), revolution[r], angle[r], {}});
    }
    out.back().profile.push_back({radius[r], height[r]});
  }
  if (out.empty()) throw IoError(fmt::format("{}: no points below the header", path.string()));
  put_in_order(out.back(), table, first);
  return out;
}

}  // namespace abradem::io
