// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/table.h"

#include <array>
#include <string_view>

#include "run_fixture.h"

namespace abradem::report {
namespace {

using namespace std::string_view_literals;

constexpr std::array kColumns = {"revolution"sv, "depth_mm"sv};

class TableFile : public RunFixture {
 protected:
  std::filesystem::path with(const std::string& text) {
    write_text(folder_ / "t.csv", text);
    return folder_ / "t.csv";
  }
};

TEST_F(TableFile, ReadsColumnsInAnyOrderWithExtraOnesAndEmptyFields) {
  EXPECT_EQ(read_table(with("revolution,depth_mm\n1,0.0081\n2,0.00"), kColumns).rows(), 1U);  // cut short
  const Table table = read_table(with("depth_mm, extra ,revolution\r\n0.5,1,2\r\n,3e-2,nan\n\n"), kColumns);
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table["depth_mm"][0], 0.5);
  EXPECT_EQ(table["extra"][1], 0.03);
  EXPECT_TRUE(std::isnan(table["depth_mm"][1]));
  EXPECT_TRUE(std::isnan(table["revolution"][1]));
}

TEST_F(TableFile, AMissingFileIsNamed) {
  const std::string message = io_error([&] { (void)read_table(folder_ / "none.csv", kColumns); });
  EXPECT_NE(message.find("none.csv: no such file"), std::string::npos) << message;
}

TEST_F(TableFile, AFolderInItsPlaceIsRefused) {
  EXPECT_NE(io_error([&] { (void)read_table(folder_, kColumns); }), "");
}

TEST_F(TableFile, AMissingColumnIsNamedBesideThoseThere) {
  const auto file = with("revolution,depth_um\n1,2\n");
  const std::string message = io_error([&] { (void)read_table(file, kColumns); });
  EXPECT_NE(message.find("t.csv:1: column 'depth_mm' is missing; the header has: revolution, depth_um"),
            std::string::npos)
      << message;
}

TEST_F(TableFile, AWordAmongNumbersIsFoundByLineAndColumn) {
  const auto file = with("revolution,depth_mm\n1,2\n2,deep\n");
  const std::string message = io_error([&] { (void)read_table(file, kColumns); });
  EXPECT_NE(message.find("t.csv:3: column 'depth_mm': 'deep' is not a number"), std::string::npos) << message;
}

TEST_F(TableFile, ACutOffRowIsFound) {
  const auto file = with("revolution,depth_mm\n1,2\n2\n");
  const std::string message = io_error([&] { (void)read_table(file, kColumns); });
  EXPECT_NE(message.find("t.csv:3: 1 fields where the header names 2"), std::string::npos) << message;
}

TEST_F(TableFile, AnEmptyFileIsRefusedAndAHeaderAloneIsATableWithoutRows) {
  const auto empty = with("");
  EXPECT_NE(io_error([&] { (void)read_table(empty, kColumns); }).find("empty"), std::string::npos);
  EXPECT_EQ(read_table(with("revolution,depth_mm\n"), kColumns).rows(), 0u);
}

TEST(Thinning, KeepsWholeRevolutionsWithTheFirstAndTheLast) {
  Table table{"t", {"revolution", "angle_deg"}, {{}, {}}};
  for (int turn = 1; turn <= 100; ++turn) {
    for (int k = 0; k < 10; ++k) {
      table.columns[0].push_back(turn);
      table.columns[1].push_back(k);
    }
  }
  const Table thin = thin_revolutions(table, 105);
  EXPECT_EQ(thin.rows(), 100u);
  EXPECT_EQ(thin["revolution"].front(), 1.0);
  EXPECT_EQ(thin["revolution"].back(), 100.0);
  EXPECT_EQ(thin["angle_deg"][9], 9.0);
  EXPECT_EQ(thin_revolutions(table, 1).rows(), 20u);
  EXPECT_EQ(thin_revolutions(table, 1000).rows(), 1000u);
  EXPECT_EQ(thin_rows(table, 300).rows(), 250u);
}

TEST(ToCsv, WritesSevenDigitsAndNothingForNaN) {
  const Table table{"t", {"a", "b"}, {{1.0 / 3.0}, {std::nan("")}}};
  EXPECT_EQ(to_csv(table), "a,b\n0.3333333,\n");
}

}  // namespace
}  // namespace abradem::report
