// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>

#include "abradem/cli/commands.h"
#include "abradem/cli/mesh_loader.h"
#include "abradem/cli/output_folder.h"
#include "abradem/cli/print.h"
#include "abradem/cli/stop_signals.h"
#include "abradem/core/error.h"
#include "abradem/io/atomic_file.h"
#include "abradem/io/case_file.h"
#include "abradem/io/case_motions.h"
#include "abradem/io/wear_tests.h"
#include "abradem/report/calibration_report.h"
#include "abradem/report/groove_calibration_report.h"
#include "abradem/report/page.h"
#include "abradem/report/wear_law_report.h"
#include "abradem/study/calibration.h"
#include "abradem/study/groove_calibration.h"
#include "abradem/study/wear_law.h"

namespace abradem::cli {

namespace {

namespace fs = std::filesystem;
constexpr const char* kRecord = "calibration.json";  // by which a folder of an earlier calibration is known

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
  io::read_motion_files(setup);
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

/// Many tests in a table need no case: the law is fitted to them.
int calibrate_tests(const CalibrateArguments& arguments) {
  const auto refuse = [](bool given, const char* option) {
    if (given) throw InputError(fmt::format("{} belongs to a case; a table of tests has none", option));
  };
  refuse(!arguments.overrides.empty(), "--set");
  refuse(!arguments.method.empty(), "--method");
  refuse(!arguments.pair.empty(), "--pair");
  refuse(arguments.unknown != "wear_coefficient", "--for");
  std::vector<study::WearLawFit> fits;
  for (const study::WearTests& tests : io::read_wear_tests(arguments.path))
    fits.push_back(study::fit_wear_law(tests, arguments.coverage));
  write_results(arguments, report::wear_law_page(fits, fs::path(arguments.path).filename().string()),
                report::wear_law_json(fits));
  if (!arguments.json) print_result(report::wear_law_text(fits));
  return static_cast<int>(ExitCode::ok);
}

bool is_table(const std::string& path) {
  std::string end = fs::path(path).extension().string();
  for (char& c : end) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return end == ".csv";
}

}  // namespace

int calibrate_command(const CalibrateArguments& arguments) {
  if (arguments.threads > 0) omp_set_num_threads(arguments.threads);
  if (!arguments.output.empty())
    check_result_folder(arguments.output, kRecord, "a calibration", arguments.force);
  return is_table(arguments.path) ? calibrate_tests(arguments) : calibrate_case(arguments);
}

}  // namespace abradem::cli
