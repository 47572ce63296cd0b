// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

#include "abradem/analysis/flow_profile.h"
#include "abradem/cli/commands.h"
#include "abradem/cli/print.h"
#include "abradem/cli/quantity.h"
#include "abradem/core/error.h"
#include "abradem/core/units.h"
#include "abradem/io/atomic_file.h"
#include "abradem/io/case_file.h"
#include "abradem/io/csv.h"
#include "abradem/io/measured_table.h"
#include "abradem/io/vtp_read.h"
#include "abradem/report/flow_page.h"

namespace abradem::cli {
namespace {

namespace fs = std::filesystem;

double quantity(std::string_view text, const char* option, const core::Dimension& dimension) {
  const core::Quantity q = quantity_of(text, option);
  if (q.dimension == dimension) return q.value;
  const std::string_view example = core::example(dimension);
  throw InputError(fmt::format("{} {}: expected {}{}", option, text, core::describe(dimension),
                               example.empty() ? "" : fmt::format(" such as \"{}\"", example)));
}

/// "0, 0, -120 mm": three numbers, and a unit for all of them behind the last; none for a direction.
Vec3 vector(std::string_view text, const char* option, const core::Dimension& dimension) {
  const std::size_t unit_at = text.find_last_of("0123456789.") + 1;
  const std::string unit(text.substr(unit_at));
  std::string_view rest = text.substr(0, unit_at);
  std::array<double, 3> values{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t comma = k < 2 ? rest.find(',') : rest.size();
    if (comma == std::string_view::npos || rest.empty())
      throw InputError(
          fmt::format("{} {}: expected three numbers with commas{}", option, text,
                      dimension == core::Dimension{} ? "" : " and a unit, as in \"0, 0, 2 mm\""));
    values[k] = quantity(std::string(rest.substr(0, comma)) + unit, option, dimension);
    rest.remove_prefix(std::min(rest.size(), comma + 1));
  }
  return {values[0], values[1], values[2]};
}

constexpr core::Dimension kLength{.length = 1}, kTime{.time = 1};

analysis::FlowLine line_of(const FlowArguments& a) {
  analysis::FlowLine line;
  line.from = vector(a.from, "--from", kLength);
  line.to = vector(a.to, "--to", kLength);
  line.reach = quantity(a.reach, "--reach", kLength);
  line.bins = a.bins;
  if (!a.averaged.empty()) line.averaged = vector(a.averaged, "--average-along", {});
  return line;
}

/// The frames with particles, of the times asked for.
std::vector<io::SeriesFrame> frames_of(const FlowArguments& a) {
  const double begin = a.begin.empty() ? -INFINITY : quantity(a.begin, "--begin", kTime);
  const double end = a.end.empty() ? INFINITY : quantity(a.end, "--end", kTime);
  std::vector<io::SeriesFrame> frames;
  std::size_t all = 0;
  for (io::SeriesFrame& frame : io::read_pvd(fs::path(a.folder) / "series.pvd")) {
    if (!frame.file.filename().string().starts_with("particles_")) continue;
    ++all;
    if (frame.time >= begin && frame.time <= end) frames.push_back(std::move(frame));
  }
  if (frames.empty())
    throw InputError(
        fmt::format("{}: none of its {} frames with particles lies between --begin and --end; "
                    "[output] every and frames of the case say which are written",
                    a.folder, all));
  return frames;
}

void add_frame(analysis::FlowProfile& profile, const fs::path& file) {
  const io::VtpSurface spheres = io::read_vtp(file);
  const auto found = spheres.point_data.find("velocity_m_per_s");
  const std::vector<Vec3>& centres = spheres.mesh.vertices;
  if (found == spheres.point_data.end() || found->second.values.size() != 3 * centres.size())
    throw IoError(fmt::format("{}: no array velocity_m_per_s of its points", file.string()));
  const std::vector<double>& v = found->second.values;
  std::vector<Vec3> velocities;
  for (std::size_t i = 0; i < centres.size(); ++i)
    velocities.push_back({v[3 * i], v[3 * i + 1], v[3 * i + 2]});
  profile.add(centres, velocities);
}

std::string title_of(const fs::path& folder) {
  const fs::path file = folder / "case.resolved.toml";
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw IoError(fmt::format("{}: no such file; expected the output folder of a run", file.string()));
  return io::parse_case(std::string(std::istreambuf_iterator<char>(stream), {}), file.string(), folder, {},
                        io::NamedFiles::kept)
      .setup.title;
}

/// Velocities by distance, in the direction shown.
void read_measured(const fs::path& file, report::FlowSummary& summary) {
  using namespace std::string_view_literals;
  constexpr core::Dimension kSpeed{.length = 1, .time = -1};
  const io::MeasuredTable table(file);
  const std::vector<double> distance = table.quantities(std::array{"distance"sv}, kLength);
  const auto add = [&](std::string_view column, const std::string& name) {
    summary.measured.push_back({fmt::format("{}{}", file.filename().string(), name), distance,
                                table.quantities(std::array{column}, kSpeed, true)});
  };
  if (!summary.component.empty()) {
    add("component", "");
    return;
  }
  std::size_t found = 0;
  for (const std::string_view axis : {"x"sv, "y"sv, "z"sv}) {
    const std::string column = fmt::format("velocity_{}", axis);
    if (!table.find(std::array{std::string_view(column)})) continue;
    add(column, fmt::format(", {}", axis));
    ++found;
  }
  if (found == 0)
    throw InputError(
        fmt::format("{}: no column velocity_x, velocity_y or velocity_z; with --component it is component",
                    file.string()));
}

report::FlowSummary summary_of(const FlowArguments& a, const analysis::FlowProfile& profile,
                               const Vec3& component, double first, double last) {
  report::FlowSummary s;
  s.title = title_of(a.folder);
  s.sentence = fmt::format(
      "Mean velocities along the line from ({}) to ({}), over {} frames from {:.6g} to {:.6g} s, of "
      "particles "
      "no further from it than {}{}.",
      a.from, a.to, profile.moments(), first, last, a.reach,
      a.averaged.empty() ? "" : fmt::format(", all along ({})", a.averaged));
  if (!a.component.empty()) s.component = fmt::format("in the direction ({})", a.component);
  s.direction = component;
  s.moments = static_cast<double>(profile.moments());
  s.bins = profile.bins();
  for (const std::string& file : a.measured) read_measured(file, s);
  return s;
}

const std::vector<std::string> kColumns{"distance_mm",
                                        "x_mm",
                                        "y_mm",
                                        "z_mm",
                                        "particles",
                                        "velocity_x_m_per_s",
                                        "velocity_y_m_per_s",
                                        "velocity_z_m_per_s",
                                        "fluctuation_m_per_s"};

}  // namespace

int flow_command(const FlowArguments& a) {
  analysis::FlowProfile profile(line_of(a));
  const Vec3 component = a.component.empty() ? Vec3{} : normalized(vector(a.component, "--component", {}));
  const std::vector<io::SeriesFrame> frames = frames_of(a);
  for (const io::SeriesFrame& frame : frames) add_frame(profile, frame.file);
  std::string page;
  if (!a.page.empty())
    page = report::page_html(
        report::flow_page(summary_of(a, profile, component, frames.front().time, frames.back().time)));

  std::vector<std::string> columns = kColumns;
  if (!a.component.empty()) columns.emplace_back("component_m_per_s");
  std::vector<std::vector<double>> rows;
  for (const analysis::FlowBin& bin : profile.bins()) {
    rows.push_back({1e3 * bin.distance, 1e3 * bin.middle.x, 1e3 * bin.middle.y, 1e3 * bin.middle.z,
                    static_cast<double>(bin.samples) / static_cast<double>(profile.moments()), bin.velocity.x,
                    bin.velocity.y, bin.velocity.z, bin.fluctuation});
    if (!a.component.empty()) rows.back().push_back(dot(bin.velocity, component));
  }
  if (!a.output.empty()) {
    io::CsvWriter table(a.output, columns);
    for (const std::vector<double>& row : rows) table.row(row);
    table.close();
  }
  if (!a.page.empty()) io::write_file_atomically(a.page, page);
  if (!a.quiet) print_message(fmt::format("{} frames", profile.moments()));
  if (!a.quiet && !a.page.empty()) print_message(fmt::format("page: {}", a.page));
  std::string text;
  const std::vector<std::size_t> shown =
      a.component.empty() ? std::vector<std::size_t>{0, 4, 5, 6, 7, 8} : std::vector<std::size_t>{0, 4, 9, 8};
  for (const std::size_t c : shown) text += fmt::format("{:>21}", columns[c]);
  for (const std::vector<double>& row : rows) {
    text += '\n';
    for (const std::size_t c : shown) text += fmt::format("{:>21.5g}", row[c]);
  }
  print_result(text + '\n');
  return static_cast<int>(ExitCode::ok);
}

}  // namespace abradem::cli
