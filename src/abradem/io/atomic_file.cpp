// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/atomic_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <vector>

#include "abradem/core/error.h"

namespace abradem::io {

namespace {

/// Folders have to be told to keep a new name; a file system that cannot is none the worse.
void sync_folder(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const int handle = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0) return;
  fsync(handle);
  close(handle);
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::string_view content, bool durable) {
  std::filesystem::path temporary = path;
  temporary += fmt::format(".{}.tmp", getpid());
  const auto fail = [&](int error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw IoError(
        fmt::format("cannot write '{}': {}", path.string(), std::generic_category().message(error)));
  };
  std::FILE* file = std::fopen(temporary.c_str(), "wb");
  if (file == nullptr) fail(errno);
  const bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size() &&
                       (!durable || (std::fflush(file) == 0 && fsync(fileno(file)) == 0));
  const int write_error = errno;
  const bool closed = std::fclose(file) == 0;  // a full disk may show only here
  if (!written) fail(write_error);
  if (!closed) fail(errno);
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) fail(error.value());
  if (durable) sync_folder(path);
}

void remove_temporaries(const std::filesystem::path& folder) noexcept {
  std::error_code error;
  std::vector<std::filesystem::path> left;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".tmp") left.push_back(entry->path());
  for (const std::filesystem::path& file : left) std::filesystem::remove(file, error);
}

}  // namespace abradem::io
