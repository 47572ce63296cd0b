// SPDX-License-Identifier: BSD-3-Clause
// make_report <folder>: what `abradem report` does, for the browser test, which needs no other part.
#include <fmt/format.h>

#include "abradem/core/error.h"
#include "abradem/report/report.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: make_report <output folder of a run>\n");
    return static_cast<int>(abradem::ExitCode::input);
  }
  try {
    fmt::print("{}\n", abradem::report::write_report(argv[1]).string());
    return 0;
  } catch (const abradem::Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
