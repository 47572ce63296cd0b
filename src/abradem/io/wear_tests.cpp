// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/wear_tests.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "abradem/core/error.h"
#include "abradem/io/measured_table.h"

namespace abradem::io {

namespace {

using namespace std::string_view_literals;

constexpr core::Dimension kForce{.mass = 1, .length = 1, .time = -2}, kLength{.length = 1},
    kVolume{.length = 3}, kMass{.mass = 1}, kDensity{.mass = 1, .length = -3};
constexpr std::array kForceNames{"force"sv, "load"sv, "normal_force"sv, "normal_load"sv};
constexpr std::array kDistanceNames{"distance"sv, "sliding_distance"sv};
constexpr std::array kVolumeNames{"volume"sv, "wear_volume"sv};
constexpr std::array kMassNames{"mass_loss"sv};
constexpr std::array kDensityNames{"density"sv};
constexpr std::array kMaterialNames{"material"sv};

/// Logarithms are taken of them.
std::vector<double> positive(const MeasuredTable& table, std::span<const std::string_view> names,
                             const core::Dimension& dimension) {
  std::vector<double> values = table.quantities(names, dimension);
  for (std::size_t r = 0; r < values.size(); ++r)
    if (!(values[r] > 0.0))
      throw IoError(
          table.at(r, *table.find(names),
                   fmt::format("column '{}': a test needs a positive value; leave out tests without wear "
                               "(a power law has none)",
                               table.header()[*table.find(names)])));
  return values;
}

std::vector<double> volumes(const MeasuredTable& table) {
  if (table.find(kVolumeNames) || !table.find(kMassNames)) return positive(table, kVolumeNames, kVolume);
  std::vector<double> volume = positive(table, kMassNames, kMass);
  const std::vector<double> density = positive(table, kDensityNames, kDensity);
  for (std::size_t r = 0; r < volume.size(); ++r) volume[r] /= density[r];
  return volume;
}

}  // namespace

std::vector<study::WearTests> read_wear_tests(const std::filesystem::path& path) {
  const MeasuredTable table(path);
  const std::vector<double> force = positive(table, kForceNames, kForce),
                            distance = positive(table, kDistanceNames, kLength), volume = volumes(table);
  const std::vector<std::string> material =
      table.find(kMaterialNames) ? table.texts(kMaterialNames) : std::vector<std::string>(table.rows());
  std::vector<study::WearTests> out;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    auto same = std::ranges::find(out, material[r], &study::WearTests::material);
    if (same == out.end()) same = out.insert(out.end(), {.material = material[r]});
    same->volume.push_back(volume[r]);
    same->force.push_back(force[r]);
    same->distance.push_back(distance[r]);
  }
  if (out.empty()) throw IoError(fmt::format("{}: no tests below the header", path.string()));
  return out;
}

}  // namespace abradem::io
