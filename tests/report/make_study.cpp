// SPDX-License-Identifier: BSD-3-Clause
// make_study <folder> <claims.json>: the page of the published study from runs made of formulas, for the
// browser test.
#include <fmt/format.h>

#include "abradem/core/error.h"
#include "abradem/report/page.h"
#include "support/study_fixture.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: make_study <folder> <claims.json>\n");
    return static_cast<int>(abradem::ExitCode::input);
  }
  try {
    const std::filesystem::path folder = argv[1];
    const abradem::test::SyntheticStudy study = abradem::test::published_study(folder);
    abradem::simulation::Setup setup = abradem::test::paper_setup();
    setup.study->page = abradem::simulation::StudyPage::paper;
    setup.study->published = std::filesystem::absolute(argv[2]);
    fmt::print("{}\n",
               abradem::report::write_page(folder, abradem::report::study_page(setup, study.runs(), folder))
                   .string());
    return 0;
  } catch (const abradem::Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
