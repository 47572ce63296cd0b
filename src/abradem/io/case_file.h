// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "abradem/simulation/setup.h"

namespace abradem::io {

/// A case file, read.
struct Case {
  simulation::Setup setup;         ///< resolved: defaults filled in, SI units, mesh files with absolute paths
  std::string text;                ///< the file, byte for byte
  std::vector<std::string> notes;  ///< what is allowed but probably not meant; complete lines for a person
};

/// Reads a case file and lays the overrides (`KEY=VALUE`, as of `--set`) over it.
/// @throws CaseError (an InputError) with every problem found, in one pass
/// @throws InputError when there is no such file or it is not text
[[nodiscard]] Case load_case(const std::filesystem::path& path, std::span<const std::string> overrides = {});

/// As load_case(), of the case without its [study], as one run: the study is neither read nor checked.
[[nodiscard]] Case load_single_run(const std::filesystem::path& path,
                                   std::span<const std::string> overrides = {});

/// As load_case(), when only the setup matters.
[[nodiscard]] simulation::Setup read_case(const std::filesystem::path& path,
                                          std::span<const std::string> overrides = {});

/// Whether the files that a case names must be there, or what they hold is kept elsewhere.
enum class NamedFiles { needed, kept };

/// Reads a case from memory.
/// @param name what messages call it   @param folder that relative mesh files are relative to
[[nodiscard]] Case parse_case(std::string_view text, const std::string& name,
                              const std::filesystem::path& folder,
                              std::span<const std::string> overrides = {},
                              NamedFiles files = NamedFiles::needed);

/// The setup as a case file with every key and its unit. Reading it gives the same setup, bit for bit.
[[nodiscard]] std::string resolved_case(const simulation::Setup& setup);

}  // namespace abradem::io
