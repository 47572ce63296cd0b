// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "abradem/cli/commands.h"
#include "abradem/cli/mesh_loader.h"
#include "abradem/cli/print.h"
#include "abradem/cli/stop_signals.h"
#include "abradem/core/error.h"
#include "abradem/io/atomic_file.h"
#include "abradem/io/case_file.h"
#include "abradem/report/calibration_report.h"
#include "abradem/report/groove_calibration_report.h"
#include "abradem/report/page.h"
#include "abradem/study/calibration.h"
#include "abradem/study/groove_calibration.h"

namespace abradem::cli {

namespace {

namespace fs = std::filesystem;
constexpr const char* kRecord = "calibration.json";  // by which a folder of an earlier calibration is known

/// Refuses, before any work, a folder that the result may not be written to.
void check_folder(const fs::path& folder, bool force) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status))
    throw InputError(fmt::format("output folder '{}' is a file; choose another with -o", folder.string()));
  if (fs::is_empty(folder, error)) return;
  if (!fs::exists(folder / kRecord, error))
    throw InputError(
        fmt::format("output folder '{}' holds files that are not of a calibration; choose another with -o",
                    folder.string()));
  if (!force)
    throw InputError(
        fmt::format("output folder '{}' already holds a calibration; add --force to replace it, or choose "
                    "another with -o",
                    folder.string()));
}

/// What is being done, on one changing line of a terminal; a line per part elsewhere.
class Status {
 public:
  explicit Status(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}
  ~Status() { clear(); }
  Status(const Status&) = delete;
  Status& operator=(const Status&) = delete;

  void show(const std::string& doing, double fraction) {
    if (quiet_) return;
    const auto now = std::chrono::steady_clock::now();
    if (terminal_ && now - shown_ > std::chrono::milliseconds(100)) {
      print_raw(fmt::format("\r\033[K{}: {:.0f} %", doing, 100.0 * fraction));
      shown_ = now, line_ = true;
    } else if (!terminal_ && doing != doing_) {
      print_message(doing);
    }
    doing_ = doing;
  }
  void clear() {
    if (line_) print_raw("\r\033[K");
    line_ = false;
  }

 private:
  bool quiet_, terminal_, line_ = false;
  std::string doing_;
  std::chrono::steady_clock::time_point shown_{};
};

/// A guided pin under a load needs no dynamics: the same wear in far fewer steps.
bool can_be_quasi_static(const simulation::Setup& setup) {
  return !setup.particles.empty() &&
         std::ranges::all_of(setup.particles, [](const simulation::ParticleSetup& p) {
           return p.guide == simulation::Guide::vertical && norm2(p.load) > 0.0;
         });
}

void write_results(const CalibrateArguments& arguments, const report::Page& page, const std::string& json) {
  if (!arguments.output.empty()) {
    const fs::path folder = arguments.output;
    const fs::path written = report::write_page(folder, page);
    io::write_file_atomically(folder / kRecord, json);
    if (!arguments.quiet) print_message(fmt::format("report: {}", written.string()));
  }
  if (arguments.json) print_result(json);
}

int calibrate_case(const CalibrateArguments& arguments) {
  io::Case read = io::load_case(arguments.path, arguments.overrides);
  if (!arguments.quiet)
    for (const std::string& note : read.notes) print_message(note);
  simulation::Setup setup = std::move(read.setup);
  if (arguments.method.empty()) {
    if (setup.run.method == simulation::Method::dynamic && can_be_quasi_static(setup)) {
      setup.run.method = simulation::Method::quasi_static;
      if (!arguments.quiet)
        print_message(
            "note: the particles are guided, so the trials are quasi-static: the same wear in far fewer "
            "steps "
            "(--method dynamic runs them in time)");
    }
  } else {
    setup.run.method =
        arguments.method == "dynamic" ? simulation::Method::dynamic : simulation::Method::quasi_static;
  }

  Status status(arguments.quiet);
  const StopSignals signals;
  if (arguments.unknown == "groove") {
    study::GrooveCalibrationOptions options;
    options.coverage = arguments.coverage;
    options.pair = arguments.pair;
    options.watch = [&](const std::string& doing, double fraction) {
      status.show(doing, fraction);
      return !StopSignals::requested();
    };
    const study::GrooveCalibration result = study::calibrate_groove(setup, MeshLoader(setup), options);
    status.clear();
    write_results(arguments, report::groove_calibration_page(result, setup.title),
                  report::groove_calibration_json(result));
    if (!arguments.json) print_result(report::groove_calibration_text(result));
    return static_cast<int>(ExitCode::ok);
  }
  study::CalibrationOptions options;
  options.unknown =
      arguments.unknown == "revolutions" ? study::Unknown::revolutions : study::Unknown::wear_coefficient;
  options.coverage = arguments.coverage;
  options.pair = arguments.pair;
  options.watch = [&](const std::string& doing, double fraction) {
    status.show(doing, fraction);
    return !StopSignals::requested();
  };
  const study::CalibrationResult result = study::calibrate(setup, MeshLoader(setup), options);
  status.clear();
  write_results(arguments, report::calibration_page(result, setup.title), report::calibration_json(result));
  if (!arguments.json) print_result(report::calibration_text(result));
  return static_cast<int>(ExitCode::ok);
}

}  // namespace

int calibrate_command(const CalibrateArguments& arguments) {
  if (arguments.threads > 0) omp_set_num_threads(arguments.threads);
  if (!arguments.output.empty()) check_folder(arguments.output, arguments.force);
  return calibrate_case(arguments);
}

}  // namespace abradem::cli
