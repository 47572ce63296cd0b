// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// The commands, each behind plain arguments; main.cpp alone knows the command line. They return the exit
/// code, or throw an Error that carries it. Results go to stdout, everything else to stderr.
namespace abradem::cli {

struct RunArguments {
  std::string case_path;
  std::string output;  ///< folder; empty: out/<name of the case>
  std::vector<std::string> overrides;
  int threads = 0;  ///< 0: as many as the machine has
  bool force = false, quiet = false, dry_run = false, json = false;
  bool no_report = false;  ///< leave out report.html
  bool no_study = false;   ///< run the case alone, as if it had no [study]
};
int run_command(const RunArguments& arguments);

struct ResumeArguments {
  std::string folder;                  ///< of a run
  std::vector<std::string> overrides;  ///< of run.end and output.checkpoint_every
  int threads = 0;                     ///< 0: as many as the machine has
  bool quiet = false, json = false, no_report = false;
};
/// Goes on with a run from its newest checkpoint, to the same bits as if it had never stopped.
int resume_command(const ResumeArguments& arguments);

struct SweepArguments {
  std::string case_path;
  std::string output;  ///< folder; empty: out/<name of the case>-sweep
  std::vector<std::string> overrides;
  std::vector<std::string> vary;  ///< KEY=VALUES
  std::string design = "grid";    ///< grid, list, lhs or sobol
  int samples = 0;                ///< of lhs and sobol
  std::optional<std::uint64_t> seed;
  int jobs = 0;               ///< runs at a time; 0: as many as the machine has cores
  int only = 0;               ///< the one run to make, from 1; 0: all
  std::string export_format;  ///< slurm or snakemake; empty: run it here
  std::string export_path;    ///< file to write; empty: stdout
  bool force = false, quiet = false, json = false, collect = false;
};
/// Runs a case with many values of some of its keys.
int sweep_command(const SweepArguments& arguments);

struct CalibrateArguments {
  std::string path;    ///< case file, or a table of tests (.csv)
  std::string output;  ///< folder of the page; empty: none is written
  std::vector<std::string> overrides;
  std::string unknown = "wear_coefficient";  ///< or "revolutions", "groove"
  std::string method;                        ///< of the trials; empty: quasi_static where it can be
  std::string pair;                          ///< "abrader/worn"; empty: the only one
  double coverage = 0.95;                    ///< of the intervals
  int threads = 0;                           ///< 0: as many as the machine has
  bool force = false, quiet = false, json = false;
};
/// Finds the wear coefficient or the number of revolutions that the measurement asks for.
int calibrate_command(const CalibrateArguments& arguments);

struct AnalyseArguments {
  std::vector<std::string> paths;                ///< tables of profiles
  std::string output;                            ///< folder of the page; empty: none is written
  std::string level = "none";                    ///< none, mean or line
  std::string shoulder, width_at, track_radius;  ///< lengths with units; empty: default, none, unknown
  bool force = false, quiet = false, json = false;
};
/// Measures the grooves of measured profiles, and tests them.
int analyse_command(const AnalyseArguments& arguments);

struct FlowArguments {
  std::string folder;                 ///< of a run with frames
  std::string from, to, reach;        ///< the line, with units
  std::string averaged;               ///< direction along which distance does not count; empty: none
  std::string component;              ///< direction of an own column; empty: none
  std::string begin, end;             ///< times of the frames; empty: the first, the last
  std::string output;                 ///< table (.csv) to write; empty: none
  std::string page;                   ///< page (.html) to write; empty: none
  std::vector<std::string> measured;  ///< tables of measured velocities to draw beside them
  int bins = 20;
  bool quiet = false;
};
/// Averages the velocities of particles along a line, over the frames of a run.
int flow_command(const FlowArguments& arguments);

struct RewearArguments {
  std::string folder;                  ///< of a run that kept maps
  std::string law;                     ///< laws, separated by commas; empty: those of the run
  std::string pair;                    ///< "abrader/worn" that `law` is for; empty: all
  std::vector<std::string> overrides;  ///< of keys of [wear]
  std::string name;                    ///< of what is written; empty: the next number
  bool quiet = false, json = false;
};
/// Works out the wear by other laws or coefficients from what a run has recorded.
int rewear_command(const RewearArguments& arguments);

struct CheckArguments {
  std::string path;
  std::vector<std::string> overrides;
  std::string unit = "mm";  ///< of a mesh file
  bool json = false;        ///< mesh file: the table as JSON
};
/// Reads a case file or, by its suffix, a mesh file and says what is wrong with it.
int check_command(const CheckArguments& arguments);

struct NewArguments {
  std::string name;  ///< of the template
  std::string path;  ///< file to write; empty: stdout
  bool force = false;
};
int new_command(const NewArguments& arguments);

/// Prints the schema of the case file. @param format "json" or "md"
int schema_command(const std::string& format);

/// Makes the report of a run's folder again.
int report_command(const std::string& folder);

/// Version, commit, compiler and flags, a line each.
[[nodiscard]] std::string version_text();

}  // namespace abradem::cli
