// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "support/case_texts.h"
#include "support/says.h"

namespace abradem::test {
namespace {

namespace fs = std::filesystem;

const std::string kExample = ABRADEM_SOURCE_DIR "/cases/pin-on-disc.toml";

// ---- usage
// ---------------------------------------------------------------------------------------------------

TEST(Usage, HelpAndVersionGoToStdoutAndSucceed) {
  const Outcome help = run_program("--help");
  EXPECT_EQ(help.exit_code, 0);
  for (const char* command : {"run", "check", "new", "schema"}) EXPECT_TRUE(contains(help.out, command));
  const Outcome run_help = run_program("run --help");
  EXPECT_EQ(run_help.exit_code, 0);
  for (const char* option : {"--output", "--force", "--set", "--threads", "--quiet", "--dry-run", "--json"})
    EXPECT_TRUE(contains(run_help.out, option));
  const Outcome version = run_program("--version");
  EXPECT_EQ(version.exit_code, 0);
  for (const char* line : {"abradem ", "commit ", "compiler ", "flags "})
    EXPECT_TRUE(contains(version.out, line));
}

TEST(Usage, MistakesAreNamedAndEndWithTwo) {
  const auto complains = [](const std::string& arguments, const std::string& message) {
    const Outcome outcome = run_program(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_TRUE(contains(outcome.err, message)) << arguments;
  };
  complains("", "subcommand is required");
  complains("chek x", "unknown command 'chek'; did you mean 'check'?");
  complains("run", "CASE is required");
  complains("run x --dryrun", "did you mean '--dry-run'?");
  complains("run x --threads 0", "--threads");
  complains("run x --threads two", "--threads");
  complains("run x --dry-run --json", "--dry-run");
  complains("schema --format xml", "--format");
}

// ---- check
// ---------------------------------------------------------------------------------------------------

TEST(Check, AGoodCaseSucceedsAndSaysSoOnStderr) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(ABRADEM_SOURCE_DIR "/cases")) {
    if (entry.path().extension() != ".toml") continue;
    const Outcome outcome = run_program("check '" + entry.path().string() + "'");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(contains(outcome.err, "no errors"));
  }
}

TEST(Check, ReportsEveryProblemWithItsPlace) {
  const ScratchFolder folder;
  write_file(folder.path() / "bad.toml", "schema = 1\ntitel = 3\n[run]\nend = \"12 kg\"\n");
  const Outcome outcome = run_program("check bad.toml", folder.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.err,
                       "bad.toml:2:1: error: unknown key 'titel' at the top of the file; did you mean "
                       "'title'?\n    titel = 3\n    ^\n"));
  EXPECT_TRUE(contains(outcome.err, "bad.toml:4:7: error: 'end': expected a time"));
  EXPECT_TRUE(contains(outcome.err, "the case has no wall"));
  EXPECT_TRUE(contains(outcome.err, "bad.toml: 5 errors"));
}

TEST(Check, LooksIntoTheTablesOfParticles) {
  const ScratchFolder folder;
  write_file(folder.path() / "sizes.csv", "radius_mm;share\r\n2;0,5\r\n");
  write_file(folder.path() / "case.toml", std::string(kGlass) + R"([wall.floor]
material = "glass"
mesh = { shape = "plane" }
[insertion.feed]
material = "glass"
number = 3
size = { kind = "table", file = "sizes.csv" }
volume = { low = [0, 0, 0], high = [1, 1, 1] }
[run]
end = "1 s"
)");
  const Outcome bad = run_program("check case.toml", folder.path());
  EXPECT_EQ(bad.exit_code, 5) << bad.err;
  EXPECT_TRUE(contains(
      bad.err, "sizes.csv:2:3: column 'share': '0,5' is not a number; expected digits with a decimal point"));
  write_file(folder.path() / "sizes.csv", "radius_mm;share\r\n2;0.5\r\n");
  EXPECT_EQ(run_program("check case.toml", folder.path()).exit_code, 0);
}

TEST(Check, WhatIsNoCaseFileEndsWithTwo) {
  const ScratchFolder folder;
  write_file(folder.path() / "empty.toml", "");
  write_file(folder.path() / "binary.toml", std::string("\x7f"
                                                        "ELF\0\1\2\xff",
                                                        8));
  for (const char* name : {"missing.toml", ".", "empty.toml", "binary.toml"}) {
    const Outcome outcome = run_program(std::string("check ") + name, folder.path());
    EXPECT_EQ(outcome.exit_code, 2) << name;
    EXPECT_TRUE(contains(outcome.err, name));
  }
}

TEST(Check, TakesOverrides) {
  EXPECT_EQ(run_program("check " + kExample + " --set run.seed=2").exit_code, 0);
  const Outcome outcome = run_program("check " + kExample + " --set run.sed=2 --set 'run.end=1 N'");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.err, "--set: error: unknown key 'sed' in [run]; did you mean 'seed'?"));
  EXPECT_TRUE(contains(outcome.err, "--set: error: 'end': expected a time"));
}

// ---- run
// -----------------------------------------------------------------------------------------------------

TEST(DryRun, PrintsTheResolvedCaseAndWritesNothing) {
  const ScratchFolder folder;
  const Outcome outcome =
      run_program("run " + kExample + " --dry-run --set wall.disc.mesh.size='0.2 mm'", folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "size = \"0.2 mm\""));
  EXPECT_TRUE(contains(outcome.err, "nothing was written; a run would write to out/pin-on-disc"));
  EXPECT_TRUE(fs::is_empty(folder.path()));
  // The output is a case file itself, with the same meaning.
  write_file(folder.path() / "resolved.toml", outcome.out);
  const Outcome again = run_program("run resolved.toml --dry-run --quiet", folder.path());
  EXPECT_EQ(again.out, outcome.out);
  EXPECT_EQ(again.err, "");
}

TEST(Run, ABadCaseLeavesNoFolder) {
  const ScratchFolder folder;
  const Outcome outcome = run_program("run " + kExample + " --set run.end=-1 -o result", folder.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

/// As little to compute as a run can have.
const std::string kShortRun =
    "run " + kExample +
    " --quiet --set wall.disc.mesh.size='1 mm' --set run.end='0.01 rev' --set output.every='0.01 rev'"
    " --set output.contours=8";

TEST(Run, WritesTheCaseAsItWasAndAsItWasResolved) {
  const ScratchFolder folder;
  const Outcome outcome = run_program(kShortRun, folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const fs::path result = folder.path() / "out" / "pin-on-disc";
  EXPECT_EQ(read_file(result / "case.toml"), read_file(kExample));
  EXPECT_TRUE(contains(read_file(result / "case.resolved.toml"), "size = \"1 mm\""));
  EXPECT_EQ(run_program("check case.resolved.toml", result).exit_code, 0);
}

TEST(Run, ReplacesAnEarlierRunOnlyWhenForced) {
  const ScratchFolder folder;
  ASSERT_EQ(run_program(kShortRun + " -o result", folder.path()).exit_code, 0);
  const fs::path stale = folder.path() / "result" / "run.log";
  const fs::path own = folder.path() / "result" / "notes.txt";
  write_file(stale, "from the earlier run, by name");
  write_file(own, "mine");
  const Outcome refused = run_program(kShortRun + " -o result", folder.path());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "output folder 'result' already holds a run; add --force to replace it"));
  EXPECT_EQ(read_file(stale), "from the earlier run, by name");
  EXPECT_EQ(run_program(kShortRun + " -o result --force", folder.path()).exit_code, 0);
  EXPECT_NE(read_file(stale), "from the earlier run, by name");
  EXPECT_EQ(read_file(own), "mine");
}

TEST(Run, NeverTouchesAFolderThatHoldsNoRun) {
  const ScratchFolder folder;
  write_file(folder.path() / "report.html", "mine");
  const Outcome outcome = run_program(kShortRun + " --force -o .", folder.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(contains(outcome.err, "holds files that are not of a run"));
  EXPECT_EQ(read_file(folder.path() / "report.html"), "mine");
}

/// What is left of a run that was killed before its first file was whole is nothing.
TEST(Run, TakesAFolderInWhichOneWasKilledAtItsVeryBeginning) {
  const ScratchFolder folder;
  write_file(folder.path() / ".abradem-write-test", "");
  write_file(folder.path() / "case.resolved.toml.123.tmp", "schema");
  EXPECT_EQ(run_program(kShortRun + " -o .", folder.path()).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "case.resolved.toml.123.tmp"));
}

TEST(Run, AFolderThatCannotBeUsedIsNamed) {
  const ScratchFolder folder;
  write_file(folder.path() / "file", "");
  const Outcome file = run_program(kShortRun + " -o file", folder.path());
  EXPECT_EQ(file.exit_code, 2);
  EXPECT_TRUE(contains(file.err, "output folder 'file' is a file"));
  const Outcome below = run_program(kShortRun + " -o file/below", folder.path());
  EXPECT_EQ(below.exit_code, 5);
  EXPECT_TRUE(contains(below.err, "cannot create the output folder 'file/below'"));
  // Nobody, not even root, writes there.
  const Outcome proc = run_program(kShortRun + " -o /proc/abradem", folder.path());
  EXPECT_EQ(proc.exit_code, 5);
}

// ---- new, schema
// ---------------------------------------------------------------------------------------------

TEST(New, WritesTheTemplatesThatAreInTheTree) {
  EXPECT_EQ(run_program("new pin-on-disc").out, read_file(kExample));
  EXPECT_EQ(run_program("new plate").out, read_file(ABRADEM_SOURCE_DIR "/cases/templates/plate.toml"));
  for (const char* name : {"hopper", "angle-of-repose", "templates/chute"}) {
    const std::string file = std::string(ABRADEM_SOURCE_DIR "/cases/") + name + ".toml";
    EXPECT_EQ(run_program("new " + std::filesystem::path(name).filename().string()).out, read_file(file));
    EXPECT_EQ(run_program("check " + file).exit_code, 0) << name;
  }
  EXPECT_EQ(run_program("new laboratory").out, read_file(ABRADEM_SOURCE_DIR "/cases/laboratory.toml"));
}

TEST(New, NeverOverwritesUnlessForced) {
  const ScratchFolder folder;
  EXPECT_EQ(run_program("new plate my.toml", folder.path()).exit_code, 0);
  EXPECT_EQ(run_program("check my.toml", folder.path()).exit_code, 0);
  write_file(folder.path() / "my.toml", "mine");
  const Outcome refused = run_program("new plate my.toml", folder.path());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "'my.toml' exists; add --force to replace it"));
  EXPECT_EQ(read_file(folder.path() / "my.toml"), "mine");
  EXPECT_EQ(run_program("new plate my.toml --force", folder.path()).exit_code, 0);
  EXPECT_NE(read_file(folder.path() / "my.toml"), "mine");
}

TEST(New, NamesWhatItCannotDo) {
  const Outcome name = run_program("new pin-on-disk");
  EXPECT_EQ(name.exit_code, 2);
  EXPECT_TRUE(contains(name.err, "did you mean 'pin-on-disc'?"));
  EXPECT_EQ(run_program("new plate .").exit_code, 2);
  EXPECT_EQ(run_program("new plate no/such/folder.toml").exit_code, 5);
}

TEST(Schema, IsJsonOrThePage) {
  const Outcome json = run_program("schema");
  EXPECT_EQ(json.exit_code, 0);
  EXPECT_TRUE(nlohmann::json::accept(json.out));
  EXPECT_EQ(run_program("schema --format md").out,
            read_file(ABRADEM_SOURCE_DIR "/docs/reference/case-file.md"));
}

TEST(Results, ThatCannotBeWrittenEndWithFive) {
  const Outcome outcome = run_program("schema >/dev/full");
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_TRUE(contains(outcome.err, "standard output"));
}

}  // namespace
}  // namespace abradem::test
