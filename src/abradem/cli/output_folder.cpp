// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/output_folder.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "abradem/core/error.h"

namespace abradem::cli {
namespace {

namespace fs = std::filesystem;

/// Everything a run writes; the first is written by every run before anything else and tells its folder from
/// others.
constexpr std::array kWritten{"case.resolved.toml", "case.toml", "run.json", "run.log", "report.html",
                              "series.pvd",         "tables",    "vtk",      "restart"};

[[noreturn]] void cannot(std::string_view what, const fs::path& path, const std::string& why) {
  throw IoError(fmt::format("{} '{}': {}", what, path.string(), why));
}

/// Not part of a run; left behind only by a power cut between two lines below.
void prove_writable(const fs::path& folder) {
  const fs::path probe = folder / ".abradem-write-test";
  write_file(probe, "");
  std::error_code ignored;
  fs::remove(probe, ignored);
}

}  // namespace

void prepare_output_folder(const fs::path& folder, bool force) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (fs::exists(status) && !fs::is_directory(status))
    throw InputError(fmt::format("output folder '{}' is a file; choose another with -o", folder.string()));
  if (!fs::exists(status)) {
    fs::create_directories(folder, error);
    if (error) cannot("cannot create the output folder", folder, error.message());
    prove_writable(folder);
    return;
  }
  const bool empty = fs::is_empty(folder, error);
  if (error) cannot("cannot read the output folder", folder, error.message());
  if (!empty && !fs::exists(folder / kWritten.front(), error))
    throw InputError(fmt::format(
        "output folder '{}' holds files that are not of a run; choose another with -o", folder.string()));
  if (!empty && !force)
    throw InputError(
        fmt::format("output folder '{}' already holds a run; add --force to replace it, or choose another "
                    "with -o",
                    folder.string()));
  prove_writable(folder);
  for (const char* name : kWritten) {
    fs::remove_all(folder / name, error);
    if (error) cannot("cannot remove what an earlier run left,", folder / name, error.message());
  }
}

void write_file(const fs::path& path, std::string_view text) {
  const auto close = [](std::FILE* file) { std::fclose(file); };
  std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "wb"), close);
  if (!file) cannot("cannot write", path, std::strerror(errno));
  const bool written = std::fwrite(text.data(), 1, text.size(), file.get()) == text.size();
  if (!written || std::fflush(file.get()) != 0) cannot("cannot write", path, std::strerror(errno));
}

}  // namespace abradem::cli
