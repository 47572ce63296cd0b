// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/checkpoint.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

#include "abradem/core/archive.h"
#include "abradem/core/error.h"
#include "abradem/core/hash.h"
#include "abradem/core/version.h"
#include "abradem/io/atomic_file.h"

namespace abradem::io {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic =
    "\x89"
    "ABRADM\n";
/// Raised when a field keeps its name and type but not its meaning; other changes the fields' tags show.
constexpr std::uint32_t kFormat = 3;
constexpr std::size_t kHead = 8 + 4 + 8 + 8, kKept = 2;
constexpr std::string_view kPrefix = "step-", kSuffix = ".checkpoint";

template <typename T>
void put(std::string& bytes, T value) {
  char word[sizeof value];
  std::memcpy(word, &value, sizeof value);
  core::order_bytes(word, sizeof value, sizeof value);
  bytes.append(word, sizeof value);
}

template <typename T>
T get(std::string_view bytes, std::size_t at) {
  char word[sizeof(T)];
  std::memcpy(word, bytes.data() + at, sizeof(T));
  core::order_bytes(word, sizeof(T), sizeof(T));
  T value;
  std::memcpy(&value, word, sizeof(T));
  return value;
}

std::uint64_t checksum(std::string_view bytes) {
  core::StateHash hash;
  std::size_t at = 0;
  for (; at + 8 <= bytes.size(); at += 8) hash.add(get<std::uint64_t>(bytes, at));
  for (; at < bytes.size(); ++at) hash.add(std::uint64_t{static_cast<unsigned char>(bytes[at])});
  return hash.value();
}

}  // namespace

std::string to_bytes(const Checkpoint& checkpoint) {
  core::ArchiveWriter archive;
  Checkpoint::visit(checkpoint, archive);
  const std::string& body = archive.bytes();
  std::string bytes(kMagic);
  bytes.reserve(kHead + body.size());
  put(bytes, kFormat);
  put(bytes, static_cast<std::uint64_t>(body.size()));
  put(bytes, checksum(body));
  return bytes += body;
}

Checkpoint checkpoint_from(std::string_view bytes) {
  if (!bytes.starts_with(kMagic.substr(0, std::min(bytes.size(), kMagic.size()))) || bytes.empty())
    throw IoError("it is no checkpoint of abradem");
  if (bytes.size() < kHead) throw IoError("it is cut short");
  if (const auto format = get<std::uint32_t>(bytes, 8); format != kFormat)
    throw IoError(
        fmt::format("it has format {}, and this program (abradem {}, {}) reads format {}; go on with "
                    "the program that wrote it",
                    format, core::version(), core::commit(), kFormat));
  const std::string_view body = bytes.substr(kHead);
  if (get<std::uint64_t>(bytes, 12) != body.size())
    throw IoError(fmt::format("it is cut short: {} of {} bytes", body.size(), get<std::uint64_t>(bytes, 12)));
  if (get<std::uint64_t>(bytes, 20) != checksum(body))
    throw IoError("it is damaged: its checksum is another");
  Checkpoint checkpoint;
  core::ArchiveReader archive(body);
  Checkpoint::visit(checkpoint, archive);
  return checkpoint;
}

fs::path write_checkpoint(const fs::path& folder, const Checkpoint& checkpoint) {
  const fs::path restart = folder / "restart";
  std::error_code error;
  fs::create_directories(restart, error);
  if (error)
    throw IoError(fmt::format("cannot create the folder '{}': {}", restart.string(), error.message()));
  fs::path file = restart / fmt::format("{}{:015}{}", kPrefix, checkpoint.steps, kSuffix);
  write_file_atomically(file, to_bytes(checkpoint), true);
  const std::vector<fs::path> files = checkpoint_files(folder);
  for (std::size_t i = kKept; i < files.size(); ++i) fs::remove(files[i], error);
  return file;
}

std::vector<fs::path> checkpoint_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder / "restart", error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with(kPrefix) && name.ends_with(kSuffix)) files.push_back(entry->path());
  }
  std::ranges::sort(files, std::ranges::greater{});  // the steps are written with leading noughts
  return files;
}

Checkpoint read_checkpoint(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad())
    throw IoError(fmt::format("checkpoint '{}' cannot be read", file.string()));
  try {
    return checkpoint_from(bytes);
  } catch (const IoError& why) {
    throw IoError(fmt::format("checkpoint '{}': {}", file.string(), why.what()));
  }
}

std::optional<Checkpoint> newest_checkpoint(const fs::path& folder, std::vector<std::string>* refused) {
  for (const fs::path& file : checkpoint_files(folder)) {
    try {
      return read_checkpoint(file);
    } catch (const IoError& why) {
      if (refused != nullptr) refused->emplace_back(why.what());
    }
  }
  return std::nullopt;
}

}  // namespace abradem::io
