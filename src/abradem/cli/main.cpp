// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <string>
#include <vector>

#include "abradem/cli/commands.h"
#include "abradem/cli/print.h"
#include "abradem/cli/templates.h"
#include "abradem/core/error.h"
#include "abradem/core/suggest.h"
#include "abradem/io/case_problems.h"

namespace {

using namespace abradem;

/// What the command line said.
struct Arguments {
  cli::RunArguments run;
  cli::ResumeArguments resume;
  cli::SweepArguments sweep;
  cli::CalibrateArguments calibrate;
  cli::AnalyseArguments analyse;
  cli::FlowArguments flow;
  cli::RewearArguments rewear;
  cli::CheckArguments check;
  cli::NewArguments create;
  std::string report_folder;
  std::string schema_format = "json";
};

void add_overrides(CLI::App& command, std::vector<std::string>& overrides) {
  command
      .add_option("--set", overrides,
                  "Override a key of the case, as in --set run.end=\"24 s\"; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void declare_sweep(CLI::App& app, cli::SweepArguments& a) {
  CLI::App* sweep = app.add_subcommand("sweep", "Run a case with many values of some of its keys");
  sweep->add_option("CASE", a.case_path, "Case file (TOML)")->required();
  sweep
      ->add_option("--vary", a.vary,
                   "A key and its values, as in --vary \"wall.disc.mesh.size=0.1 mm,0.2 mm\", or a range of "
                   "them, 0.1..1 mm (with :N for N values of it, :log for equal ratios); may be repeated")
      ->type_name("KEY=VALUES")
      ->allow_extra_args(false)
      ->required();
  sweep
      ->add_option("--design", a.design,
                   "grid: all with all (default); list: side by side; lhs: Latin hypercube; sobol")
      ->check(CLI::IsMember({"grid", "list", "lhs", "sobol"}));
  sweep->add_option("--samples", a.samples, "Number of runs of lhs and sobol")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  sweep->add_option("--seed", a.seed, "Seed of lhs (default: 1)")->type_name("S");
  sweep
      ->add_option("-o,--output", a.output,
                   "Folder for everything that comes out (default: out/<name of the case>-sweep)")
      ->type_name("DIR");
  add_overrides(*sweep, a.overrides);
  sweep->add_option("--jobs", a.jobs, "Runs at a time (default: as many as the machine has cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  CLI::Option* only =
      sweep->add_option("--case", a.only, "Make only run K, from 1, and no table: for job arrays")
          ->type_name("K")
          ->check(CLI::Range(1, 100000));
  CLI::Option* collect =
      sweep->add_flag("--collect", a.collect, "Run nothing; make the table and the report of what is there")
          ->excludes(only);
  CLI::Option* exported =
      sweep->add_option("--export", a.export_format, "Write a job array or a workflow instead of running")
          ->check(CLI::IsMember({"slurm", "snakemake"}))
          ->excludes(only)
          ->excludes(collect);
  sweep->add_option("--to", a.export_path, "File for --export (default: stdout)")
      ->type_name("FILE")
      ->needs(exported);
  sweep->add_flag("--force", a.force, "Replace runs of other inputs in that folder, and repeat failed ones");
  sweep->add_flag("--quiet", a.quiet, "No progress, only warnings and errors");
  sweep->add_flag("--json", a.json, "Print batch.json (with --case: run.json) to stdout at the end");
}

void declare_calibrate(CLI::App& app, cli::CalibrateArguments& a) {
  CLI::App* calibrate = app.add_subcommand(
      "calibrate", "Find the wear coefficient (or the revolutions) that the measurement asks for");
  calibrate
      ->add_option(
          "CASE|TESTS", a.path,
          "Case file (TOML) with [measurement]; or a table (.csv) of many tests, to which a wear law is "
          "fitted")
      ->required();
  add_overrides(*calibrate, a.overrides);
  calibrate
      ->add_option(
          "--for", a.unknown,
          "What is sought: wear_coefficient (default), for the case's revolutions; revolutions, for its wear "
          "coefficient; or groove: the coefficients of disc and pin and the removed fraction, from volume, "
          "depth and width")
      ->check(CLI::IsMember({"wear_coefficient", "revolutions", "groove"}));
  calibrate->add_option("--pair", a.pair, "Which coefficient, where the case has several")
      ->type_name("ABRADER/WORN");
  calibrate
      ->add_option("--method", a.method,
                   "Method of the trial runs (default: quasi_static for guided particles)")
      ->check(CLI::IsMember({"quasi_static", "dynamic"}));
  calibrate->add_option("--coverage", a.coverage, "Coverage of the intervals (default: 0.95)")
      ->type_name("P");
  calibrate->add_option("-o,--output", a.output, "Folder for a page with figures (default: none)")
      ->type_name("DIR");
  calibrate->add_flag("--force", a.force, "Replace an earlier calibration in that folder");
  calibrate->add_option("--threads", a.threads, "Number of threads (default: as many as the machine has)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  calibrate->add_flag("--quiet", a.quiet, "No progress, only warnings and errors");
  calibrate->add_flag("--json", a.json, "Print the result as JSON");
}

void declare_analyse(CLI::App& app, cli::AnalyseArguments& a) {
  CLI::App* analyse =
      app.add_subcommand("analyse", "Measure depth, width and area of measured profiles, and test them");
  analyse
      ->add_option(
          "PROFILES", a.paths,
          "Tables (.csv) with columns radius_mm (or x_mm) and height_mm; several sections: also revolution, "
          "angle_deg or section; or one file per section")
      ->required();
  analyse
      ->add_option(
          "--level", a.level,
          "What is taken away as unworn surface: none (default); mean: the mean of the shoulders; line: a "
          "straight line through them, for a tilted baseline")
      ->check(CLI::IsMember({"none", "mean", "line"}));
  analyse
      ->add_option(
          "--shoulder", a.shoulder,
          "Length of the unworn shoulder at either end, as in \"0.3 mm\" (default: a tenth of the section)")
      ->type_name("LENGTH");
  analyse->add_option("--width-at", a.width_at, "Also measure the width at this depth, as in \"2 um\"")
      ->type_name("DEPTH");
  analyse
      ->add_option("--track-radius", a.track_radius,
                   "Radius of a round track: gives the worn volume, and lengths along it")
      ->type_name("LENGTH");
  analyse->add_option("-o,--output", a.output, "Folder for a page with figures and tables (default: none)")
      ->type_name("DIR");
  analyse->add_flag("--force", a.force, "Replace an earlier analysis in that folder");
  analyse->add_flag("--quiet", a.quiet, "No messages, only warnings and errors");
  analyse->add_flag("--json", a.json, "Print the result as JSON");
}

void declare_resume(CLI::App& app, cli::ResumeArguments& a) {
  CLI::App* resume =
      app.add_subcommand("resume", "Go on with a run that ended early, or let one that ended go on further");
  resume->add_option("DIR", a.folder, "Output folder of the run")->required();
  resume
      ->add_option("--set", a.overrides,
                   "A later end, as in --set run.end=\"24 rev\", or output.checkpoint_every")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  resume->add_option("--threads", a.threads, "Number of threads (default: as many as the machine has)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  resume->add_flag("--quiet", a.quiet, "No progress, only warnings and errors");
  resume->add_flag("--no-report", a.no_report, "Leave out report.html");
  resume->add_flag("--json", a.json, "Print run.json to stdout at the end");
}

void declare_flow(CLI::App& app, cli::FlowArguments& a) {
  CLI::App* flow = app.add_subcommand(
      "flow", "Average the velocities of particles along a line, over the frames of a run");
  flow->add_option("DIR", a.folder, "Output folder of the run")->required();
  flow->add_option("--from", a.from, "Where the line begins, as in \"0, 0, -120 mm\"")
      ->type_name("POINT")
      ->required();
  flow->add_option("--to", a.to, "Where it ends")->type_name("POINT")->required();
  flow->add_option("--reach", a.reach,
                   "How far from the line the centre of a particle may be, as in \"5 mm\"")
      ->type_name("LENGTH")
      ->required();
  flow->add_option("--bins", a.bins, "Parts of the line (default: 20)")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  flow->add_option("--average-along", a.averaged,
                   "Direction across the line in which distance does not count, as in \"0, 1, 0\"")
      ->type_name("VECTOR");
  flow->add_option("--component", a.component, "Add the velocity in this direction")->type_name("VECTOR");
  flow->add_option("--begin", a.begin, "First time, as in \"2 s\" (default: the first frame)")
      ->type_name("TIME");
  flow->add_option("--end", a.end, "Last time (default: the last frame)")->type_name("TIME");
  flow->add_option("-o,--output", a.output, "Table to write (.csv)")->type_name("FILE");
  CLI::Option* page =
      flow->add_option("--page", a.page, "Page with figures to write (.html)")->type_name("FILE");
  flow->add_option("--measured", a.measured,
                   "Table of measured velocities by distance to draw beside them; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->needs(page);
  flow->add_flag("--quiet", a.quiet, "No messages, only warnings and errors");
}

void declare_rewear(CLI::App& app, cli::RewearArguments& a) {
  CLI::App* rewear = app.add_subcommand(
      "rewear", "Work out the wear by another law or coefficient from a run's maps, without running again");
  rewear->add_option("DIR", a.folder, "Output folder of a run that kept maps")->required();
  rewear
      ->add_option("--law", a.law,
                   "Law, or several with commas: archard, shear_work, finnie, oka, impact_energy, "
                   "expression (default: those of the run)")
      ->type_name("LAWS");
  rewear->add_option("--pair", a.pair, "The pair that --law is for (default: all of the case)")
      ->type_name("ABRADER/WORN");
  rewear
      ->add_option("--set", a.overrides,
                   "Another key of [wear], as in --set 'wear.\"ore/steel\".wear_coefficient=2e-12 1/Pa'; may "
                   "be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  rewear
      ->add_option("--name", a.name,
                   "Name of what is written into DIR: rewear_NAME.html and tables/rewear_NAME*.csv (default: "
                   "the next free number)")
      ->type_name("NAME");
  rewear->add_flag("--quiet", a.quiet, "No messages, only warnings and errors");
  rewear->add_flag("--json", a.json, "Print the volumes as JSON");
}

void declare(CLI::App& app, Arguments& a) {
  app.set_version_flag(
      "--version", [] { return cli::version_text(); }, "Print version, commit, compiler and flags");
  app.require_subcommand(1);

  CLI::App* run = app.add_subcommand("run", "Run a case and write its folder");
  run->add_option("CASE", a.run.case_path, "Case file (TOML)")->required();
  run->add_option("-o,--output", a.run.output,
                  "Folder for everything that comes out (default: out/<name of the case>)")
      ->type_name("DIR");
  run->add_flag("--force", a.run.force, "Replace an earlier run in that folder");
  add_overrides(*run, a.run.overrides);
  run->add_option("--threads", a.run.threads, "Number of threads (default: as many as the machine has)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  run->add_flag("--quiet", a.run.quiet, "No progress, only warnings and errors");
  run->add_flag("--no-report", a.run.no_report, "Leave out report.html; 'abradem report DIR' makes it later");
  run->add_flag("--no-study", a.run.no_study, "Run the case alone, as if it had no [study]");
  CLI::Option* dry =
      run->add_flag("--dry-run", a.run.dry_run, "Print the resolved case to stdout and write nothing");
  run->add_flag("--json", a.run.json, "Print run.json to stdout at the end")->excludes(dry);

  declare_resume(app, a.resume);
  declare_sweep(app, a.sweep);
  declare_calibrate(app, a.calibrate);
  declare_analyse(app, a.analyse);
  declare_flow(app, a.flow);
  declare_rewear(app, a.rewear);

  CLI::App* check = app.add_subcommand("check", "Say what is wrong with a case file or a mesh");
  check->add_option("CASE|MESH", a.check.path, "Case file (TOML), or mesh (.stl, .obj, .ply)")->required();
  add_overrides(*check, a.check.overrides);
  check->add_option("--unit", a.check.unit, "Mesh: its unit of length (default: mm)")->type_name("UNIT");
  check->add_flag("--json", a.check.json, "Mesh: print the table as JSON");

  CLI::App* report = app.add_subcommand("report", "Make the report of a run's folder again");
  report->add_option("DIR", a.report_folder, "Output folder of a run")->required();

  std::string names;
  for (const cli::CaseTemplate& t : cli::case_templates())
    names += (names.empty() ? "" : ", ") + std::string(t.name);
  CLI::App* create = app.add_subcommand("new", "Write a commented case file to start from");
  create->add_option("TEMPLATE", a.create.name, "One of: " + names)->required();
  create->add_option("FILE", a.create.path, "File to write (default: stdout)");
  create->add_flag("--force", a.create.force, "Replace the file if it exists");

  CLI::App* schema = app.add_subcommand("schema", "Print every key a case file may have");
  schema->add_option("--format", a.schema_format, "json: JSON Schema for editors; md: the reference page")
      ->check(CLI::IsMember({"json", "md"}));
}

int dispatch(const CLI::App& app, const Arguments& a) {
  if (app.got_subcommand("run")) return cli::run_command(a.run);
  if (app.got_subcommand("resume")) return cli::resume_command(a.resume);
  if (app.got_subcommand("sweep")) return cli::sweep_command(a.sweep);
  if (app.got_subcommand("calibrate")) return cli::calibrate_command(a.calibrate);
  if (app.got_subcommand("analyse")) return cli::analyse_command(a.analyse);
  if (app.got_subcommand("flow")) return cli::flow_command(a.flow);
  if (app.got_subcommand("rewear")) return cli::rewear_command(a.rewear);
  if (app.got_subcommand("check")) return cli::check_command(a.check);
  if (app.got_subcommand("report")) return cli::report_command(a.report_folder);
  if (app.got_subcommand("new")) return cli::new_command(a.create);
  return cli::schema_command(a.schema_format);
}

/// "did you mean" for a mistyped command or option; empty where nothing is near.
std::string advice(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> known;
  const CLI::App* command = &app;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    known.push_back(sub->get_name());
    if (argc > 1 && sub->get_name() == argv[1]) command = sub;
  }
  std::string word = argc > 1 ? argv[1] : "";
  if (command != &app) {
    known.clear();
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    word.clear();
    for (int i = 2; i < argc && word.empty(); ++i) {
      const std::string argument = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
      if (argument.starts_with("--") && std::find(known.begin(), known.end(), argument) == known.end())
        word = argument;
    }
  }
  if (word.empty()) return {};
  const std::string nearest =
      core::nearest_spelling(word, std::vector<std::string_view>(known.begin(), known.end()));
  return nearest.empty() || nearest == word ? std::string{} : fmt::format("; did you mean '{}'?", nearest);
}

int run_program(int argc, char** argv) {
  CLI::App app("Abradem: discrete element method with walls that wear and change shape", "abradem");
  Arguments arguments;
  declare(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    const bool unknown = argc > 1 && app.get_subcommands().empty();
    const std::string what =
        unknown ? fmt::format("unknown {} '{}'", argv[1][0] == '-' ? "option" : "command", argv[1])
                : error.what();
    cli::print_message(fmt::format("abradem: error: {}{}\nTry 'abradem --help' or 'abradem COMMAND --help'.",
                                   what, advice(app, argc, argv)));
    return static_cast<int>(ExitCode::input);
  }
  return dispatch(app, arguments);
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file over the limit is then an error of writing, with a message
  try {
    return run_program(argc, argv);
  } catch (const io::CaseError& error) {
    cli::print_message(error.what());  // already says file, line and column
    return static_cast<int>(error.code());
  } catch (const Error& error) {
    cli::print_message(fmt::format("abradem: error: {}", error.what()));
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    cli::print_message("abradem: error: out of memory; make the mesh coarser or the case smaller");
    return static_cast<int>(ExitCode::internal);
  } catch (const std::exception& error) {
    cli::print_message(
        fmt::format("abradem: internal error: {}; please report it with the case file", error.what()));
    return static_cast<int>(ExitCode::internal);
  } catch (...) {
    cli::print_message("abradem: internal error of unknown kind; please report it with the case file");
    return static_cast<int>(ExitCode::internal);
  }
}
