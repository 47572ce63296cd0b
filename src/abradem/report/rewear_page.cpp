// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/rewear_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "abradem/report/text.h"

namespace abradem::report {
namespace {

using namespace std::string_view_literals;

constexpr auto& kLaws = wear::kMechanismNames;
constexpr double kMm3 = 1e9, kUm = 1e6;
constexpr std::size_t kWorst = 10;

std::string region_name(const RewearSummary& s, const analysis::RewornRegion& r) {
  const RewearSummary::Wall& wall = s.walls.at(static_cast<std::size_t>(r.wall));
  const std::string& region = wall.regions.at(static_cast<std::size_t>(r.region));
  return region == wall.name ? (wall.regions.size() > 1 ? "rest of " + wall.name : wall.name) : region;
}

/// Laws that wear anything.
std::vector<std::size_t> used_laws(const analysis::Reworn& reworn) {
  std::vector<std::size_t> used;
  for (std::size_t m = 0; m < kLaws.size(); ++m)
    if (std::ranges::any_of(reworn.regions,
                            [&](const analysis::RewornRegion& r) { return r.volumes[m] > 0.0; }))
      used.push_back(m);
  return used;
}

DataTable by_region(const RewearSummary& s) {
  DataTable table{
      .id = fmt::format("rewear_{}_volumes", s.name),
      .title = "Volume worn",
      .caption = "By the laws assumed here. Exact: nothing in it comes from classes of contacts or impacts.",
      .columns = {"region", "volume [mm³]"}};
  const std::vector<std::size_t> used = used_laws(s.reworn);
  for (const std::size_t m : used) table.columns.push_back(fmt::format("{} [mm³]", kLaws[m]));
  table.columns.emplace_back("exact");
  for (const analysis::RewornRegion& r : s.reworn.regions) {
    std::vector<std::string> row{region_name(s, r), readable(kMm3 * wear::total(r.volumes))};
    for (const std::size_t m : used) row.push_back(readable(kMm3 * r.volumes[m]));
    row.emplace_back(r.exact ? "yes" : "no");
    table.rows.push_back(std::move(row));
  }
  return table;
}

DataTable worst(const RewearSummary& s) {
  std::vector<const analysis::RewornElement*> elements;
  for (const analysis::RewornElement& e : s.reworn.elements) elements.push_back(&e);
  const auto depth = [](const analysis::RewornElement* e) { return wear::total(e->volumes) / e->area; };
  std::ranges::stable_sort(elements, std::greater{}, depth);
  if (elements.size() > kWorst) elements.resize(kWorst);
  DataTable table{.id = fmt::format("rewear_{}_worst", s.name),
                  .title = "Worst elements",
                  .caption = "Depth: volume over area.",
                  .columns = {"wall", "element", "depth [µm]", "volume [mm³]"}};
  for (const analysis::RewornElement* e : elements)
    table.rows.push_back({s.walls.at(static_cast<std::size_t>(e->wall)).name, std::to_string(e->element),
                          readable(kUm * depth(e)), readable(kMm3 * wear::total(e->volumes))});
  return table;
}

double volume_of_wall(const RewearSummary& s, std::size_t wall) {
  double sum = 0.0;
  for (const analysis::RewornRegion& r : s.reworn.regions)
    if (static_cast<std::size_t>(r.wall) == wall) sum += wear::total(r.volumes);
  return sum;
}

}  // namespace

Page rewear_page(const RewearSummary& s) {
  Page page{.title = s.title};
  page.summary = s.assumptions;
  for (std::size_t w = 0; w < s.walls.size(); ++w) {
    page.cards.emplace_back(s.walls[w].name, readable(kMm3 * volume_of_wall(s, w)) + " mm³");
    page.cards.emplace_back(s.walls[w].name + " in the run", readable(kMm3 * s.walls[w].before) + " mm³");
  }
  PageSection section{.title = "Wear by other laws"};
  section.items.emplace_back(Paragraph{
      "Worked out from what the run recorded, on the surfaces and trajectories of the run: what other wear "
      "would have done to the motion is not in it."});
  section.items.emplace_back(by_region(s));
  section.items.emplace_back(worst(s));
  page.sections.push_back(std::move(section));
  return page;
}

std::string rewear_text(const RewearSummary& s) {
  std::string out = s.assumptions + "\n\n";
  std::size_t width = 8;
  for (const analysis::RewornRegion& r : s.reworn.regions) width = std::max(width, region_name(s, r).size());
  const std::vector<std::size_t> used = used_laws(s.reworn);
  out += fmt::format("{:{}}  {:>14}", "region", width, "volume [mm3]");
  for (const std::size_t m : used) out += fmt::format("  {:>14}", kLaws[m]);
  out += "  exact\n";
  for (const analysis::RewornRegion& r : s.reworn.regions) {
    out += fmt::format("{:{}}  {:>14.6g}", region_name(s, r), width, kMm3 * wear::total(r.volumes));
    for (const std::size_t m : used) out += fmt::format("  {:>14.6g}", kMm3 * r.volumes[m]);
    out += r.exact ? "  yes\n" : "  no\n";
  }
  return out;
}

std::string rewear_json(const RewearSummary& s) {
  std::string out = fmt::format("{{\n  \"name\": {},\n  \"regions\": [", json_string(s.name));
  bool first = true;
  for (const analysis::RewornRegion& r : s.reworn.regions) {
    out += fmt::format("{}\n    {{\"wall\": {}, \"region\": {}, \"exact\": {}, \"wear_volume_mm3\": {}",
                       first ? "" : ",", json_string(s.walls.at(static_cast<std::size_t>(r.wall)).name),
                       json_string(region_name(s, r)), r.exact, json_number(kMm3 * wear::total(r.volumes)));
    for (std::size_t m = 0; m < kLaws.size(); ++m)
      out += fmt::format(", \"{}_mm3\": {}", kLaws[m], json_number(kMm3 * r.volumes[m]));
    out += "}";
    first = false;
  }
  return out + "\n  ]\n}\n";
}

}  // namespace abradem::report
