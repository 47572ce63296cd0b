// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/core/archive.h"

#include <gtest/gtest.h>

#include <limits>

namespace abradem::core {
namespace {

struct Spring {
  Vec3 s;
  std::int32_t key = 0;
  bool operator==(const Spring&) const = default;
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("s", self.s)("key", self.key);
  }
};

struct Thing {
  double x = 0.0;
  bool flag = false;
  std::uint64_t steps = 0;
  std::string text;
  std::vector<double> numbers;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<Spring> springs;
  std::optional<Spring> maybe, none;
  bool operator==(const Thing&) const = default;
  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("x", self.x)("flag", self.flag)("steps", self.steps)("text", self.text);
    archive("numbers", self.numbers)("triangles", self.triangles)("springs", self.springs);
    archive("maybe", self.maybe)("none", self.none);
  }
};

template <typename T>
std::string bytes_of(const char* name, const T& value) {
  ArchiveWriter archive;
  archive(name, value);
  return archive.take();
}

TEST(Archive, GivesBackWhatWasPutIn) {
  Thing thing{-0.0,
              true,
              1ULL << 63,
              "two\nlines\0"
              "and a nought",
              {1.0, std::numeric_limits<double>::denorm_min(), -std::numeric_limits<double>::infinity()},
              {{1, -2, 3}},
              {{{1, 2, 3}, 4}, {{5, 6, 7}, -8}},
              Spring{{9, 9, 9}, 9},
              {}};
  const std::string bytes = bytes_of("thing", thing);
  Thing read;
  read.none = Spring{};
  ArchiveReader archive(bytes);
  archive("thing", read);
  EXPECT_TRUE(archive.at_end());
  EXPECT_EQ(read, thing);
  EXPECT_TRUE(std::signbit(read.x));
  EXPECT_EQ(bytes_of("thing", read), bytes);
}

// The order of bytes is that of the file, not of the machine.
TEST(Archive, IsLittleEndianOnEveryMachine) {
  EXPECT_EQ(bytes_of("x", 1.0).substr(4), std::string("\0\0\0\0\0\0\xf0\x3f", 8));
  EXPECT_EQ(bytes_of("n", std::uint64_t{0x0102030405060708}).substr(4), "\x08\x07\x06\x05\x04\x03\x02\x01");
  EXPECT_EQ(bytes_of("i", std::int32_t{-2}).substr(4), std::string("\xfe\xff\xff\xff"));
  std::string two = "abcdefgh";
  order_bytes(two.data(), two.size(), 4, std::endian::big);
  EXPECT_EQ(two, "dcbahgfe");
  order_bytes(two.data(), two.size(), 4, std::endian::little);
  EXPECT_EQ(two, "dcbahgfe");
}

template <typename T>
std::string refusal(const std::string& bytes, const char* name, T value = {}) {
  try {
    ArchiveReader archive(bytes);
    archive(name, value);
  } catch (const IoError& error) {
    return error.what();
  }
  return {};
}

TEST(Archive, RefusesAFieldOfAnotherNameOrType) {
  const std::string bytes = bytes_of("speed", 1.0);
  EXPECT_EQ(refusal<double>(bytes, "speed"), "");
  EXPECT_EQ(refusal<double>(bytes, "spin"), "the field 'spin' is not where it is expected (byte 4 of 12)");
  EXPECT_NE(refusal<std::uint64_t>(bytes, "speed"), "");
  EXPECT_NE(refusal<std::int64_t>(bytes_of("n", std::uint64_t{1}), "n"), "");
  EXPECT_NE(refusal<std::vector<Vec3>>(bytes_of("p", std::vector<double>(3)), "p"), "");
  EXPECT_NE(refusal<Spring>(bytes_of("s", Vec3{}), "s"), "");
}

TEST(Archive, RefusesWhatIsCutShortWithoutAskingForMemory) {
  Thing thing;
  thing.numbers.assign(10, 1.0);
  thing.springs.resize(3);
  const std::string bytes = bytes_of("thing", thing);
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_NE(refusal<Thing>(bytes.substr(0, n), "thing"), "") << n;
  // 2^61 numbers in twelve bytes.
  std::string huge = bytes_of("numbers", std::vector<double>{});
  huge[11] = 0x20;
  EXPECT_EQ(refusal<std::vector<double>>(huge, "numbers"),
            "the field 'numbers' is cut short (byte 12 of 12)");
}

TEST(Archive, HoldsFixedListsToTheirLengthAndIndicesToTheirRange) {
  const std::vector<std::int32_t> three{0, 2, 1};
  ArchiveWriter out;
  out.fixed("list", three).indices("places", three, 3);
  const auto read = [&](std::size_t length, std::size_t count) -> std::string {
    std::vector<std::int32_t> list(length), places;
    try {
      ArchiveReader(out.bytes()).fixed("list", list).indices("places", places, count);
    } catch (const IoError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(read(3, 3), "");
  EXPECT_NE(read(2, 3).find("has another length than the case gives it"), std::string::npos);
  EXPECT_NE(read(3, 2).find("points to what does not exist"), std::string::npos);
}

}  // namespace
}  // namespace abradem::core
