// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/normality_table.h"

#include <array>

namespace abradem::io {

namespace {

constexpr std::array kOfOneQuantity{"sections",
                                    "outliers",
                                    "chi2_bins",
                                    "chi2",
                                    "chi2_df",
                                    "p_chi2",
                                    "p_chi2_upper",
                                    "p_equal_width",
                                    "p_anderson_darling",
                                    "p_shapiro_wilk",
                                    "correlation_length",
                                    "correlation_time",
                                    "effective_count",
                                    "independent_step",
                                    "independent_sections",
                                    "independent_p_chi2",
                                    "independent_p_equal_width",
                                    "independent_p_anderson_darling",
                                    "independent_p_shapiro_wilk",
                                    "bins_passing",
                                    "bins_p_min",
                                    "bins_p_max",
                                    "equal_width_bins_passing"};

}  // namespace

std::vector<std::string> normality_columns() {
  std::vector<std::string> columns{"revolution"};
  for (const char* quantity : {"depth_", "width_"})
    for (const char* column : kOfOneQuantity) columns.push_back(std::string(quantity) + column);
  return columns;
}

std::vector<double> normality_values(const analysis::SectionStatistics& s) {
  const analysis::Normality &all = s.normality.all, &independent = s.normality.independent;
  const analysis::Correlation& c = s.normality.correlation;
  return {static_cast<double>(all.count),
          static_cast<double>(s.outliers),
          static_cast<double>(all.equiprobable.bins),
          all.equiprobable.statistic,
          static_cast<double>(all.equiprobable.df),
          all.equiprobable.p,
          all.equiprobable.p_upper,
          all.equal_width.p,
          all.anderson_darling.p,
          all.shapiro_wilk.p,
          c.length,
          c.time,
          c.effective_count,
          static_cast<double>(c.independent_step),
          static_cast<double>(independent.count),
          independent.equiprobable.p,
          independent.equal_width.p,
          independent.anderson_darling.p,
          independent.shapiro_wilk.p,
          s.equiprobable.share_passing,
          s.equiprobable.p_min,
          s.equiprobable.p_max,
          s.equal_width.share_passing};
}

NormalityTable::NormalityTable(const std::filesystem::path& folder, analysis::Ends ends, std::uint64_t from)
    : ends_(ends), table_(folder / "normality.csv", normality_columns(), CsvWriter::Growing{from}) {}

void NormalityTable::add(double revolution, std::span<const analysis::Contour> contours) {
  std::vector<double> row{revolution};
  for (double analysis::Contour::*measure : {&analysis::Contour::depth, &analysis::Contour::width}) {
    std::vector<double> values;
    for (const analysis::Contour& c : contours) values.push_back(c.*measure);
    const std::vector<double> cells = normality_values(analysis::section_statistics(values, ends_));
    row.insert(row.end(), cells.begin(), cells.end());
  }
  table_.row(row);
}

}  // namespace abradem::io
