// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/output_folder.h"

#include <fmt/core.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <ranges>
#include <utility>

#include "abradem/cli/path_lock.h"
#include "abradem/core/error.h"
#include "abradem/io/atomic_file.h"

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

constexpr const char* kProbe = ".abradem-write-test";

/// Is there nothing but what a run leaves that is killed before its first file is whole?
bool holds_only_a_beginning(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name != kProbe &&
        !(name.ends_with(".tmp") && (name.starts_with(kProbe) || name.starts_with(kWritten.front()))))
      return false;
  }
  return !error;
}

/// Not part of a run; left behind only by a kill or a power cut between two lines below.
void prove_writable(const fs::path& folder) {
  const fs::path probe = folder / kProbe;
  io::write_file_atomically(probe, "");
  std::error_code ignored;
  fs::remove(probe, ignored);
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder, bool force) : folder_(std::move(folder)) {
  std::error_code error;
  const fs::file_status status = fs::status(folder_, error);
  if (fs::exists(status) && !fs::is_directory(status))
    throw InputError(fmt::format("output folder '{}' is a file; choose another with -o", folder_.string()));
  try {
    if (fs::exists(status))
      take_over(force);
    else
      create();
  } catch (const IoError&) {
    discard();
    throw;
  }
}

OutputFolder::~OutputFolder() {
  if (kept_) return;
  std::error_code ignored;
  for (const char* name : kWritten) fs::remove_all(folder_ / name, ignored);
  discard();
}

void OutputFolder::create() {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path p = fs::absolute(folder_).lexically_normal(); !p.empty() && !fs::exists(p, error);
       p = p.parent_path())
    if (p.has_filename()) missing.insert(missing.begin(), p);
  for (const fs::path& p : missing) {
    if (!fs::create_directory(p, error) && error)
      cannot("cannot create the output folder", folder_, error.message());
    created_.push_back(p);
  }
  prove_writable(folder_);
}

void OutputFolder::take_over(bool force) {
  std::error_code error;
  bool empty = fs::is_empty(folder_, error);
  if (error) cannot("cannot read the output folder", folder_, error.message());
  if (!empty && holds_only_a_beginning(folder_)) {
    for (const auto& entry : fs::directory_iterator(folder_, error)) fs::remove(entry.path(), error);
    empty = true;
  }
  if (!empty && !fs::exists(folder_ / kWritten.front(), error))
    throw InputError(fmt::format(
        "output folder '{}' holds files that are not of a run; choose another with -o", folder_.string()));
  if (!empty && !force)
    throw InputError(
        fmt::format("output folder '{}' already holds a run; add --force to replace it, or choose another "
                    "with -o",
                    folder_.string()));
  const PathLock lock(folder_ / "run.log", PathLock::Kind::exclusive);  // nobody is running in it
  prove_writable(folder_);
  // The file that tells the folder of a run goes last, so that a second try may follow a failed one.
  for (const char* name : std::views::reverse(kWritten)) {
    fs::remove_all(folder_ / name, error);
    if (error) cannot("cannot remove what an earlier run left,", folder_ / name, error.message());
  }
}

/// Removes the folders created, as far as they are empty.
void OutputFolder::discard() noexcept {
  std::error_code ignored;
  for (const fs::path& p : std::views::reverse(created_)) fs::remove(p, ignored);
  created_.clear();
}

void check_result_folder(const fs::path& folder, std::string_view record, std::string_view what, bool force) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status))
    throw InputError(fmt::format("output folder '{}' is a file; choose another with -o", folder.string()));
  if (fs::is_empty(folder, error)) return;
  if (!fs::exists(folder / record, error))
    throw InputError(fmt::format("output folder '{}' holds files that are not of {}; choose another with -o",
                                 folder.string(), what));
  if (!force)
    throw InputError(fmt::format(
        "output folder '{}' already holds {}; add --force to replace it, or choose another with -o",
        folder.string(), what));
}

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_file(const fs::path& path, std::string_view text) {
  const auto close = [](std::FILE* file) { std::fclose(file); };
  std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "wb"), close);
  if (!file) cannot("cannot write", path, std::strerror(errno));
  const bool written = std::fwrite(text.data(), 1, text.size(), file.get()) == text.size();
  if (!written || std::fflush(file.get()) != 0) cannot("cannot write", path, std::strerror(errno));
}

}  // namespace abradem::cli
