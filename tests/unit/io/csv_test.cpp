// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/csv.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include "abradem/core/error.h"

namespace abradem::io {
namespace {

namespace fs = std::filesystem;

class Csv : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("abradem-csv-" + std::to_string(getpid()) + "-" +
                                           testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path file() const { return folder_ / "table.csv"; }
  void put(const std::string& text) const { std::ofstream(file(), std::ios::binary) << text; }
  [[nodiscard]] std::string text() const {
    std::ifstream stream(file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  [[nodiscard]] long files() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }
  [[nodiscard]] std::string refusal() const {
    try {
      (void)read_csv(file());
    } catch (const IoError& e) {
      return e.what();
    }
    return "accepted";
  }

  fs::path folder_;
};

void expect_mention(const std::string& message, const std::string& what) {
  EXPECT_NE(message.find(what), std::string::npos) << "'" << what << "' is not in: " << message;
}

TEST_F(Csv, ReadsLikeThis) {
  CsvWriter table(file(), {"revolution", "depth_mm"});
  table.row({1.0, 0.0081});
  table.row({2.0, 0.1 + 0.2});
  table.row({-0.0, -std::numeric_limits<double>::quiet_NaN()});
  table.row({1e-300, -std::numeric_limits<double>::infinity()});
  table.close();
  EXPECT_EQ(text(), "revolution,depth_mm\n1,0.0081\n2,0.30000000000000004\n-0,nan\n1e-300,-inf\n");
}

TEST_F(Csv, EveryDoubleComesBackBitForBit) {
  std::mt19937_64 random(11);
  std::vector<double> values{0.0, -0.0, std::numeric_limits<double>::denorm_min(),
                             std::numeric_limits<double>::max(), std::numeric_limits<double>::infinity()};
  while (values.size() < 3000) {
    const double value = std::bit_cast<double>(random());
    if (!std::isnan(value)) values.push_back(value);
  }
  CsvWriter writer(file(), {"a", "b", "c"});
  for (std::size_t i = 0; i < values.size(); i += 3) writer.row(std::span(values).subspan(i, 3));
  writer.close();
  const CsvTable table = read_csv(file());
  ASSERT_EQ(table.rows(), 1000u);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(table.values[i]), std::bit_cast<std::uint64_t>(values[i]))
        << values[i];
  EXPECT_EQ(table.row(7)[1], values[22]);
  EXPECT_EQ(table.column("c")[7], values[23]);
  EXPECT_THROW((void)table.column("d"), InputError);
}

TEST_F(Csv, NanAndAnEmptyTableComeBack) {
  CsvWriter writer(file(), {"p"});
  writer.row({std::numeric_limits<double>::quiet_NaN()});
  writer.close();
  EXPECT_TRUE(std::isnan(read_csv(file()).values.at(0)));
  CsvWriter(file(), {"x_mm", "y_mm"}).close();
  EXPECT_EQ(read_csv(file()).rows(), 0u);
  EXPECT_EQ(read_csv(file()).columns, (std::vector<std::string>{"x_mm", "y_mm"}));
}

TEST_F(Csv, OldTableStaysUntilTheNewOneIsWhole) {
  put("x\n1\n");
  {
    CsvWriter writer(file(), {"x"});
    for (int i = 0; i < 100000; ++i) writer.row({1.0 * i});  // more than any buffer holds
    EXPECT_EQ(text(), "x\n1\n");
  }
  EXPECT_EQ(text(), "x\n1\n");
  EXPECT_EQ(files(), 1);  // given up: nothing else stays
  CsvWriter writer(file(), {"x"});
  writer.row({2.0});
  writer.close();
  EXPECT_EQ(text(), "x\n2\n");
  EXPECT_EQ(files(), 1);
  EXPECT_THROW(writer.row({3.0}), InputError);
  EXPECT_THROW(writer.close(), InputError);
}

TEST_F(Csv, WriterRefusesWhatItCannotWrite) {
  EXPECT_THROW(CsvWriter(file(), {}), InputError);
  EXPECT_THROW(CsvWriter(file(), {"depth (mm)"}), InputError);
  EXPECT_THROW(CsvWriter(file(), {"a", ""}), InputError);
  EXPECT_THROW(CsvWriter(file(), {"a", "b", "a"}), InputError);
  EXPECT_EQ(files(), 0);
  CsvWriter writer(file(), {"a", "b"});
  EXPECT_THROW(writer.row({1.0}), InputError);
  try {
    CsvWriter(folder_ / "missing" / "table.csv", {"a"});
    FAIL();
  } catch (const IoError& e) {
    expect_mention(e.what(), "missing/table.csv");
    expect_mention(e.what(), "No such file or directory");
  }
  fs::create_directories(folder_ / "folder.csv" / "inside");
  CsvWriter onto_folder(folder_ / "folder.csv", {"a"});
  EXPECT_THROW(onto_folder.close(), IoError);
}

TEST_F(Csv, FullDiskIsAnError) {
  const fs::path full = "/dev/full";
  ASSERT_TRUE(fs::exists(full));
  // The temporary name is a link to a device that takes nothing.
  fs::create_symlink(full, file().string() + "." + std::to_string(getpid()) + ".tmp");
  CsvWriter writer(file(), {"a"});
  EXPECT_THROW(writer.close(), IoError);
  EXPECT_EQ(files(), 0);
}

TEST_F(Csv, ReaderRefusesMalformedFiles) {
  expect_mention(refusal(), "no such file");
  put("");
  expect_mention(refusal(), "table.csv:1: the file is empty");
  put("a,b\n1,2\n3\n");
  expect_mention(refusal(), "table.csv:3: 1 fields where the header names 2");
  put("a,b\n1,2,3\n");
  expect_mention(refusal(), "table.csv:2: 3 fields");
  put("a,b\n1,2\n3,4");
  expect_mention(refusal(), "table.csv:3: the last line has no end");
  put("a,b\n1,\n");
  expect_mention(refusal(), "column 'b': '' is not a number");
  for (const char* field : {"1.5mm", " 1", "1 ", "0x10p", "+1", "one", "1;5", "--1", "1e999"}) {
    put(std::string("a,b\n1,") + field + "\n");
    expect_mention(refusal(), std::string("table.csv:2: column 'b': '") + field);
  }
  put("a,b\n1,2\n\n3,4\n");
  expect_mention(refusal(), "table.csv:3");
  put("a,a\n1,2\n");
  expect_mention(refusal(), "'a' is there twice");
  put("a,\n1,2\n");
  expect_mention(refusal(), "column 2 is named ''");
  put("a,b\r\n1,2\r\n");
  expect_mention(refusal(), "table.csv:1");
  fs::remove(file());
  fs::create_directory(file());
  expect_mention(refusal(), "not a file");
}

}  // namespace
}  // namespace abradem::io
