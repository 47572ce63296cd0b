// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "abradem/core/error.h"
#include "abradem/core/vec3.h"

/// A state as bytes. A class describes its state once, for saving and for loading:
///
///     template <typename Self, typename Archive>
///     static void visit(Self& self, Archive& archive) {
///       archive("steps", self.steps_)("springs", self.springs_);
///     }
///
/// Every field is written after a tag of four bytes that holds its name and type, so that a reader of
/// another version stops at the first field that differs and never takes one for another. Numbers are
/// little-endian on every machine; doubles keep their bits.
namespace abradem::core {

namespace archive_detail {

/// A number, or a fixed group of equal numbers without gaps between them.
template <typename T>
struct Plain {
  using Scalar = T;
};
template <>
struct Plain<Vec3> {
  using Scalar = double;
};
template <typename T, std::size_t N>
struct Plain<std::array<T, N>> {
  using Scalar = T;
};
template <typename T>
using ScalarOf = typename Plain<T>::Scalar;
template <typename T>
concept IsPlain = std::is_arithmetic_v<ScalarOf<T>> && !std::same_as<T, bool> &&
                  std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(ScalarOf<T>) == 0;
static_assert(sizeof(Vec3) == 3 * sizeof(double));

constexpr std::uint32_t mix(std::uint32_t hash, std::uint32_t word) noexcept {
  return (hash ^ word) * 16777619u;
}

template <typename T>
struct IsVector : std::false_type {};
template <typename T, typename A>
struct IsVector<std::vector<T, A>> : std::true_type {};
template <typename T>
struct IsOptional : std::false_type {};
template <typename T>
struct IsOptional<std::optional<T>> : std::true_type {};

template <typename T>
constexpr std::uint32_t type_code() noexcept {
  if constexpr (std::same_as<T, bool>)
    return 1;
  else if constexpr (std::same_as<T, std::string>)
    return 2;
  else if constexpr (IsVector<T>::value)
    return mix(3, type_code<typename T::value_type>());
  else if constexpr (IsOptional<T>::value)
    return mix(4, type_code<typename T::value_type>());
  else if constexpr (IsPlain<T>)
    return mix(std::is_floating_point_v<ScalarOf<T>> ? 5
               : std::is_signed_v<ScalarOf<T>>       ? 6
                                                     : 7,
               static_cast<std::uint32_t>(256 * sizeof(T) + sizeof(ScalarOf<T>)));
  else
    return 8;
}

template <typename T>
constexpr std::uint32_t tag_of(std::string_view name) noexcept {
  std::uint32_t hash = 2166136261u;
  for (const char c : name) hash = mix(hash, static_cast<unsigned char>(c));
  return mix(hash, type_code<T>());
}

}  // namespace archive_detail

/// Turns numbers of `size` bytes each between a machine's order and little-endian, in place.
inline void order_bytes(char* bytes, std::size_t length, std::size_t size,
                        std::endian machine = std::endian::native) noexcept {
  if (machine == std::endian::little || size < 2) return;
  for (std::size_t at = 0; at + size <= length; at += size) std::reverse(bytes + at, bytes + at + size);
}

class ArchiveWriter {
 public:
  static constexpr bool kLoading = false;

  template <typename T>
  ArchiveWriter& operator()(std::string_view name, const T& value) {
    put(archive_detail::tag_of<T>(name));
    write(value);
    return *this;
  }
  /// A list whose length follows from the setup: one of another length is refused when it is read.
  template <typename T>
  ArchiveWriter& fixed(std::string_view name, const std::vector<T>& items) {
    return (*this)(name, items);
  }
  /// A list of places in another that has `count` items; others are refused when they are read.
  ArchiveWriter& indices(std::string_view name, const std::vector<std::int32_t>& items, std::size_t) {
    return (*this)(name, items);
  }

  [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }
  [[nodiscard]] std::string take() noexcept { return std::move(bytes_); }

 private:
  template <typename T>
  void put(const T& value) {
    put_all(&value, 1);
  }
  template <typename T>
  void put_all(const T* items, std::size_t count) {
    const std::size_t at = bytes_.size();
    bytes_.append(reinterpret_cast<const char*>(items), count * sizeof(T));
    order_bytes(bytes_.data() + at, count * sizeof(T), sizeof(archive_detail::ScalarOf<T>));
  }
  template <typename T>
  void write(const T& value) {
    using namespace archive_detail;
    if constexpr (std::same_as<T, bool>) {
      put(static_cast<std::uint8_t>(value));
    } else if constexpr (std::same_as<T, std::string>) {
      put(static_cast<std::uint64_t>(value.size()));
      bytes_ += value;
    } else if constexpr (IsVector<T>::value) {
      put(static_cast<std::uint64_t>(value.size()));
      if constexpr (IsPlain<typename T::value_type>)
        put_all(value.data(), value.size());
      else
        for (const auto& item : value) write(item);
    } else if constexpr (IsOptional<T>::value) {
      put(static_cast<std::uint8_t>(value.has_value()));
      if (value) write(*value);
    } else if constexpr (IsPlain<T>) {
      put(value);
    } else {
      T::visit(value, *this);
    }
  }
  std::string bytes_;
};

/// Reads what ArchiveWriter wrote. @throws IoError where it is cut short, or a field is another than
/// expected; what was read so far is then in no defined state
class ArchiveReader {
 public:
  static constexpr bool kLoading = true;
  explicit ArchiveReader(std::string_view bytes) noexcept : bytes_(bytes) {}

  template <typename T>
  ArchiveReader& operator()(std::string_view name, T& value) {
    std::uint32_t tag = 0;
    name_ = name;
    get_all(&tag, 1);
    require(tag == archive_detail::tag_of<T>(name), "is not where it is expected");
    read(value);
    return *this;
  }
  template <typename T>
  ArchiveReader& fixed(std::string_view name, std::vector<T>& items) {
    expected_ = items.size();
    return (*this)(name, items);
  }
  ArchiveReader& indices(std::string_view name, std::vector<std::int32_t>& items, std::size_t count) {
    (*this)(name, items);
    require(std::ranges::all_of(
                items, [&](std::int32_t i) { return i >= 0 && static_cast<std::size_t>(i) < count; }),
            "points to what does not exist");
    return *this;
  }
  /// @throws IoError about the field last read, unless `holds`
  void require(bool holds, std::string_view what) const {
    if (!holds)
      throw IoError(fmt::format("the field '{}' {} (byte {} of {})", name_, what, at_, bytes_.size()));
  }
  [[nodiscard]] bool at_end() const noexcept { return at_ == bytes_.size(); }

 private:
  template <typename T>
  void get_all(T* items, std::size_t count) {
    require(count <= (bytes_.size() - at_) / sizeof(T), "is cut short");
    if (count == 0) return;
    std::memcpy(items, bytes_.data() + at_, count * sizeof(T));
    order_bytes(reinterpret_cast<char*>(items), count * sizeof(T), sizeof(archive_detail::ScalarOf<T>));
    at_ += count * sizeof(T);
  }
  [[nodiscard]] bool get_flag() {
    std::uint8_t flag = 0;
    get_all(&flag, 1);
    require(flag <= 1, "is neither true nor false");
    return flag == 1;
  }
  /// Number of items that follow, each of at least `size` bytes: no more than there can be.
  [[nodiscard]] std::size_t get_count(std::size_t size, std::optional<std::size_t> expected = {}) {
    std::uint64_t count = 0;
    get_all(&count, 1);
    require(!expected || count == *expected, "has another length than the case gives it");
    require(count <= (bytes_.size() - at_) / size, "is cut short");
    return static_cast<std::size_t>(count);
  }
  template <typename T>
  void read(T& value) {
    using namespace archive_detail;
    const std::optional<std::size_t> expected = std::exchange(expected_, std::nullopt);
    if constexpr (std::same_as<T, bool>) {
      value = get_flag();
    } else if constexpr (std::same_as<T, std::string>) {
      value.resize(get_count(1));
      get_all(value.data(), value.size());
    } else if constexpr (IsVector<T>::value) {
      using Item = typename T::value_type;
      if constexpr (IsPlain<Item>) {
        value.resize(get_count(sizeof(Item), expected));
        get_all(value.data(), value.size());
      } else {
        value.resize(get_count(sizeof(std::uint32_t), expected));
        for (auto& item : value) read(item);
      }
    } else if constexpr (IsOptional<T>::value) {
      value.reset();
      if (get_flag()) read(value.emplace());
    } else if constexpr (IsPlain<T>) {
      get_all(&value, 1);
    } else {
      T::visit(value, *this);
    }
  }

  std::string_view bytes_, name_;
  std::size_t at_ = 0;
  std::optional<std::size_t> expected_;
};

}  // namespace abradem::core
