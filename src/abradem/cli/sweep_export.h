// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "abradem/cli/commands.h"
#include "abradem/study/design.h"

/// A sweep for machines that are not this one: as a Slurm job array or a Snakemake workflow.
///                                                                      docs/reference/sweep.md#on-a-cluster
namespace abradem::cli {

/// Where the sweep goes: what was asked for, else out/<name of the case>-sweep.
[[nodiscard]] std::filesystem::path sweep_output(const SweepArguments& arguments);

/// What a shell needs after `abradem sweep` to make this sweep, quoted.
[[nodiscard]] std::string sweep_command_line(const SweepArguments& arguments);

/// Writes the script to arguments.export_path, or to stdout. Paths in it are absolute.
/// @throws InputError when the file exists and --force is not given, IoError when it cannot be written
void export_sweep(const SweepArguments& arguments, const std::vector<study::Point>& points);

}  // namespace abradem::cli
