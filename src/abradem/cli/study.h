// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/cli/commands.h"
#include "abradem/io/case_file.h"

namespace abradem::cli {

/// Makes the runs of a study that has been read and found good, and draws its page. Runs that are there
/// already are kept; one that fails does not keep the page from being drawn.        docs/reference/study.md
/// @return 130 when interrupted; that of the first run that failed for another reason than that its state
///         became unphysical, which is a result; else 0
int run_study(const RunArguments& arguments, const io::Case& study);

}  // namespace abradem::cli
