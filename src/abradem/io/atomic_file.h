// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

namespace abradem::io {

/// Writes a file so that a reader sees the old one or the whole new one, never a part: the content goes to a
/// temporary name in the same folder, which then takes the final name.
/// @param durable on the disk before the name is taken, so that even a power cut leaves one or the other
/// @throws IoError naming the path and the reason; nothing is left behind
void write_file_atomically(const std::filesystem::path& path, std::string_view content, bool durable = false);

/// Removes the temporary files that a killed program left in a folder. Nobody else may be writing there.
void remove_temporaries(const std::filesystem::path& folder) noexcept;

}  // namespace abradem::io
