// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <filesystem>
#include <optional>

#include "abradem/cli/commands.h"
#include "abradem/cli/output_folder.h"
#include "abradem/cli/print.h"
#include "abradem/cli/quantity.h"
#include "abradem/core/error.h"
#include "abradem/core/units.h"
#include "abradem/io/atomic_file.h"
#include "abradem/io/profiles_csv.h"
#include "abradem/report/page.h"
#include "abradem/report/profile_report.h"

namespace abradem::cli {

namespace {

namespace fs = std::filesystem;
constexpr const char* kRecord = "analysis.json";  // by which a folder of an earlier analysis is known

std::optional<double> length(const std::string& text, const char* option) {
  if (text.empty()) return std::nullopt;
  const core::Quantity q = quantity_of(text, option);
  if (q.dimension == core::Dimension{.length = 1} && q.value > 0.0) return q.value;
  throw InputError(
      fmt::format("{} {}: expected a length above 0 with its unit, such as \"0.3 mm\"", option, text));
}

report::ProfileOptions options_of(const AnalyseArguments& arguments) {
  using analysis::Baseline;
  report::ProfileOptions options;
  options.baseline = arguments.level == "line"   ? Baseline::line
                     : arguments.level == "mean" ? Baseline::mean
                                                 : Baseline::none;
  options.shoulder = length(arguments.shoulder, "--shoulder");
  options.width_depth = length(arguments.width_at, "--width-at");
  options.track_radius = length(arguments.track_radius, "--track-radius");
  return options;
}

}  // namespace

int analyse_command(const AnalyseArguments& arguments) {
  const report::ProfileOptions options = options_of(arguments);
  const fs::path output = arguments.output;
  if (!output.empty()) check_result_folder(output, kRecord, "an analysis", arguments.force);
  std::vector<io::ReadSection> sections;
  for (const std::string& path : arguments.paths) {
    std::vector<io::ReadSection> read = io::read_profiles(path);
    const std::string file = fs::path(path).filename().string() + ", ";
    if (arguments.paths.size() == 1)
      for (io::ReadSection& section : read)
        if (section.name.starts_with(file)) section.name.erase(0, file.size());
    sections.insert(sections.end(), std::make_move_iterator(read.begin()),
                    std::make_move_iterator(read.end()));
  }
  const report::ProfileAnalysis analysis = report::analyse_profiles(sections, options);
  for (const std::string& warning : report::profile_warnings(analysis)) print_message("warning: " + warning);

  const std::string json = report::profile_json(analysis);
  if (!output.empty()) {
    const std::string first = fs::path(arguments.paths.front()).filename().string();
    const std::string source = arguments.paths.size() == 1
                                   ? first
                                   : fmt::format("{} and {} more", first, arguments.paths.size() - 1);
    const fs::path written = report::write_page(output, report::profile_page(analysis, source));
    io::write_file_atomically(output / kRecord, json);
    if (!arguments.quiet) print_message(fmt::format("report: {}", written.string()));
  }
  print_result(arguments.json ? json : report::profile_text(analysis));
  return static_cast<int>(ExitCode::ok);
}

}  // namespace abradem::cli
