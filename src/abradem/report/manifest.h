// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abradem::report {

/// Where the removed volume went [mm^3].
struct LedgerSummary {
  double law_volume_mm3 = 0.0;        ///< sum of alpha F_n |v_t| dt
  double deposited_volume_mm3 = 0.0;  ///< what the elements were charged with
  double swept_volume_mm3 = 0.0;      ///< what the mesh lost
  double residual_relative = 0.0;     ///< of swept against deposited [-]
  double kappa = 0.0;                 ///< swept / law [-]
};

struct LimitCheck {
  std::string name, value, limit;  ///< as text, unit included where the run gave one
  bool ok = true;
};

struct MeanSd {
  double mean = 0.0, sd = 0.0;
};
struct Band {
  double low = 0.0, high = 0.0;
};
/// What the laboratory found.
struct Measurement {
  std::optional<MeanSd> wear_volume_mm3;
  std::optional<Band> depth_mm, width_mm;
  std::optional<double> revolutions;
};

/// A run's manifest, run.json. The record, the ledger and the results are always there; the rest is optional.
struct Manifest {
  std::string status;  ///< running, completed, interrupted or failed
  int exit_code = 0;
  std::string version, commit, compiler, state_hash;
  std::int64_t threads = 0, steps = 0;
  std::uint64_t seed = 0;
  double wall_seconds = 0.0, steps_per_second = 0.0;
  LedgerSummary ledger;
  std::vector<std::pair<std::string, double>> results;  ///< last row of revolutions.csv; NaN where null

  std::string inputs_hash;  ///< empty in records that have none
  std::string error;        ///< of a failed run
  std::string case_title;
  std::string counted = "revolution";  ///< by the column `revolution`: revolution, cycle or output
  std::vector<LimitCheck> limits;
  std::vector<std::string> warnings;
  std::vector<std::pair<std::string, std::string>> setup;  ///< name and value, as text
  std::vector<std::string> walls;  ///< their names, in the order of the case; empty in old records
  Measurement measurement;
  double settle_s = 0.0;                            ///< at the start, in which nothing wears
  std::vector<std::optional<double>> thickness_mm;  ///< of each of `walls`, where the case says it
};

/// Reads run.json.
/// @throws IoError when it is missing, is not JSON, or a fixed key is missing or of another kind (the message
///         names the file and the key)
[[nodiscard]] Manifest read_manifest(const std::filesystem::path& file);

}  // namespace abradem::report
