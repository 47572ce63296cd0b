// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

namespace abradem::cli {

/// Makes the folder of a run: creates it, or empties it of an earlier run when `force` is given. Only what a
/// run writes is ever deleted, and only from a folder that holds a run; nothing is deleted before the folder
/// has proved writable.
/// @throws InputError when the path is no folder, holds something, or holds what is not a run
/// @throws IoError when it cannot be created or written
void prepare_output_folder(const std::filesystem::path& folder, bool force);

/// Writes a whole file. @throws IoError
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace abradem::cli
