// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/pin_and_ridges_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "abradem/report/text.h"

namespace abradem::report {
namespace {

using Kind = Series::Kind;

/// Rows of a table that belong to one particle.
Table of_particle(const Table& table, double particle) {
  std::vector<std::size_t> rows;
  for (std::size_t r = 0; r < table.rows(); ++r)
    if (table["particle"][r] == particle) rows.push_back(r);
  return take_rows(table, rows);
}

/// The particles of a table, in the order of the case.
std::vector<double> particles(const Table& table) {
  std::vector<double> out;
  for (const double p : table["particle"])
    if (std::ranges::find(out, p) == out.end()) out.push_back(p);
  return out;
}

/// "pin" where there is one, else "pin 2" by its place in the case.
std::string pin_name(const std::vector<double>& all, double particle) {
  return all.size() == 1 ? "pin" : fmt::format("pin {:.0f}", particle + 1.0);
}

/// What of which pin; of one pin, only what.
std::string with_pin(const std::vector<double>& all, double particle, std::string_view what) {
  return all.size() == 1 ? std::string(what) : fmt::format("{}, {}", pin_name(all, particle), what);
}

std::string mm3(double volume) { return readable(volume, 6) + " mm³"; }

/// How far two volumes of one ledger lie apart, over the larger.
std::string apart(double a, double b) {
  const double larger = std::max(std::abs(a), std::abs(b));
  return larger > 0.0 ? readable(std::abs(a - b) / larger, 2) + " [-]" : "–";
}

DataTable ledgers(const RunFolder& run) {
  DataTable table{.id = "pin-and-ridges-ledger",
                  .title = "The ledgers of the pin and of the ridges",
                  .caption = "After the last output. The disc's own ledger is further down.",
                  .columns = {"entry", "value", "what it means"}};
  if (run.tip && run.tip->rows() > 0) {
    const std::vector<double> all = particles(*run.tip);
    for (const double p : all) {
      const Table one = of_particle(*run.tip, p);
      const double law = one["law_volume_mm3"].back(), removed = one["removed_volume_mm3"].back();
      const auto add = [&](std::string_view what, std::string value, std::string meaning) {
        table.rows.push_back(
            {fmt::format("{}: {}", capital(pin_name(all, p)), what), std::move(value), std::move(meaning)});
      };
      add("law volume", mm3(law), "What Archard's law takes off the pin.");
      add("missing in its shape", mm3(removed), "What the map of its tip has lost, by geometry alone.");
      add("mass lost", readable(one["mass_ug"].back()) + " µg", "What a balance would find.");
      add("apart", apart(law, removed),
          "Of law and shape. What waits to be taken off between two outputs counts as apart.");
    }
  }
  if (run.ridges && run.ridges->rows() > 0) {
    const Table& ridges = *run.ridges;
    const double removed = ridges["removed_volume_mm3"].back(),
                 displaced = ridges["displaced_volume_mm3"].back(), piled = ridges["piled_volume_mm3"].back(),
                 groove = ridges["groove_volume_mm3"].back();
    table.rows.push_back({"Groove: left it", mm3(groove), "Removed and displaced together."});
    table.rows.push_back({"Groove: removed",
                          fmt::format("{} ({} %)", mm3(removed), readable(100.0 * removed / groove, 3)),
                          "Lost as debris: what weighing the disc finds."});
    table.rows.push_back(
        {"Groove: displaced", mm3(displaced), "Moved aside, over all passes; some of it twice."});
    table.rows.push_back({"Ridges: piled up", mm3(piled), "What the mesh gained."});
    table.rows.push_back({"Ridges: apart", apart(displaced, piled), "Of displaced and piled up."});
  }
  return table;
}

Figure tip_profile(const RunFolder& run) {
  Figure figure{.id = "tip-profile",
                .title = "The worn end of the pin",
                .caption =
                    "Sections through its middle at the end of the run, along and across the slide; "
                    "heights exaggerated.",
                .columns = 2};
  const std::vector<double> all = particles(*run.tip_profile);
  for (const double p : all) {
    const Table one = of_particle(*run.tip_profile, p);
    const std::vector<double>& sphere = one["sphere_um"];
    const auto worn = [&](std::string_view recession) {
      std::vector<double> height = one[recession];
      for (std::size_t k = 0; k < height.size(); ++k) height[k] += sphere[k];
      return height;
    };
    const std::vector<double> along = worn("recession_along_um"), across = worn("recession_across_um");
    // As far as it is worn and a little beyond: the sphere rises steeply.
    double reach = 0.0;
    for (std::size_t k = 0; k < sphere.size(); ++k)
      if (along[k] > sphere[k] || across[k] > sphere[k])
        reach = std::max(reach, std::abs(one["distance_mm"][k]));
    double top = 0.0;
    for (std::size_t k = 0; k < sphere.size(); ++k)
      if (std::abs(one["distance_mm"][k]) <= 1.15 * reach) top = std::max({top, along[k], across[k]});
    Panel panel{.title = all.size() > 1 ? capital(pin_name(all, p)) : "",
                .x = {.title = "distance from the middle [mm]"},
                .y = {.title = "height of the tip [µm]"}};
    if (reach > 0.0) {
      panel.x.range = {-1.15 * reach, 1.15 * reach};
      panel.y.range = {0.0, 1.05 * top};
    }
    const std::vector<double>& x = one["distance_mm"];
    panel.series = {
        {.kind = Kind::line, .name = "as new", .x = x, .y = sphere, .colour = 7, .dash = Series::Dash::dash},
        {.kind = Kind::line, .name = "worn, along the slide", .x = x, .y = along, .colour = 0},
        {.kind = Kind::line, .name = "worn, across", .x = x, .y = across, .colour = 1}};
    figure.panels.push_back(std::move(panel));
  }
  if (figure.panels.size() == 1) figure.columns = 1;
  return figure;
}

Series curve(const Table& table, std::string_view column, std::string name, int colour) {
  return {.kind = Kind::line_markers,
          .name = std::move(name),
          .x = table["revolution"],
          .y = table[column],
          .colour = colour};
}

Figure tip_growth(const RunFolder& run) {
  const Axis revolutions{.title = run.manifest.counted + "s [-]"};
  Figure figure{
      .id = "tip-growth",
      .title = fmt::format("Wear of the pin against {}s", run.manifest.counted),
      .caption = "Size of the flat: where the tip stands back by more than 10 nm.",
      .columns = 2,
  };
  Panel flat{.title = "Size of the flat", .x = revolutions, .y = {.title = "size of the flat [mm]"}};
  Panel mass{.title = "Mass lost", .x = revolutions, .y = {.title = "mass lost [µg]"}};
  const std::vector<double> all = particles(*run.tip);
  for (std::size_t k = 0; k < all.size() && k < 4; ++k) {
    const Table one = of_particle(*run.tip, all[k]);
    const int colour = static_cast<int>(2 * k);
    flat.series.push_back(curve(one, "flat_along_mm", with_pin(all, all[k], "along the slide"), colour));
    flat.series.push_back(curve(one, "flat_across_mm", with_pin(all, all[k], "across"), colour + 1));
    mass.series.push_back(curve(one, "mass_ug", all.size() > 1 ? pin_name(all, all[k]) : "", colour));
  }
  figure.panels = {std::move(flat), std::move(mass)};
  return figure;
}

Figure ridge_growth(const RunFolder& run) {
  const Table& table = *run.ridges;
  const Axis revolutions{.title = run.manifest.counted + "s [-]"};
  Figure figure{.id = "ridge-growth",
                .title = fmt::format("Ridges against {}s", run.manifest.counted),
                .caption =
                    "Mean over the contours; bars: standard deviation. Areas are those of a section: "
                    "the groove below the first surface, both ridges above it.",
                .columns = 2};
  Panel height{.title = "Height", .x = revolutions, .y = {.title = "height of the ridges [µm]"}};
  Series mean{.kind = Kind::line_markers, .x = table["revolution"], .colour = 0};
  for (std::size_t r = 0; r < table.rows(); ++r) {
    const double h = 1e3 * table["ridge_height_mean_mm"][r], sd = 1e3 * table["ridge_height_sd_mm"][r];
    mean.y.push_back(h);
    mean.y_low.push_back(h - sd);
    mean.y_high.push_back(h + sd);
  }
  height.series.push_back(std::move(mean));
  Panel area{.title = "Areas of a section", .x = revolutions, .y = {.title = "area [mm²]"}};
  area.series = {curve(table, "groove_area_mean_mm2", "groove", 1),
                 curve(table, "ridge_area_mean_mm2", "ridges", 0)};
  figure.panels = {std::move(height), std::move(area)};
  return figure;
}

Figure displaced_volume(const RunFolder& run) {
  const Table& table = *run.ridges;
  Figure figure{.id = "displaced-volume",
                .title = "Where the groove's metal went",
                .caption =
                    "Removed: lost as debris. Displaced: moved to the ridges, of which later passes "
                    "take a part again."};
  Panel panel{.x = {.title = run.manifest.counted + "s [-]"}, .y = {.title = "volume [mm³]"}};
  panel.series = {curve(table, "groove_volume_mm3", "left the groove", 2),
                  curve(table, "removed_volume_mm3", "removed", 1),
                  curve(table, "displaced_volume_mm3", "displaced", 0)};
  figure.panels = {std::move(panel)};
  return figure;
}

std::string sentence(const RunFolder& run) {
  std::string text;
  if (run.tip && run.tip->rows() > 0) {
    const std::vector<double> all = particles(*run.tip);
    for (const double p : all) {
      const Table one = of_particle(*run.tip, p);
      text += fmt::format("{}{} lost {} µg and stands on a flat of {} by {} mm (along by across the slide).",
                          text.empty() ? "" : " ", all.size() > 1 ? capital(pin_name(all, p)) : "The pin",
                          readable(one["mass_ug"].back(), 3), readable(one["flat_along_mm"].back(), 3),
                          readable(one["flat_across_mm"].back(), 3));
    }
  }
  if (run.ridges && run.ridges->rows() > 0) {
    const Table& t = *run.ridges;
    text += fmt::format(
        "{}Of what left the groove, {} % was lost and the rest moved aside; the ridges are {} µm high, and "
        "their section is {} % of the groove's.",
        text.empty() ? "" : " ",
        readable(100.0 * t["removed_volume_mm3"].back() / t["groove_volume_mm3"].back(), 3),
        readable(1e3 * t["ridge_height_mean_mm"].back(), 3),
        readable(100.0 * t["ridge_area_mean_mm2"].back() / t["groove_area_mean_mm2"].back(), 3));
  }
  return text;
}

}  // namespace

std::optional<PageSection> pin_and_ridges_section(const RunFolder& run) {
  const bool tip = run.tip && run.tip->rows() > 0, ridges = run.ridges && run.ridges->rows() > 0;
  if (!tip && !ridges) return std::nullopt;
  PageSection section{.title = tip && ridges ? "The worn pin and the ridges"
                               : tip         ? "The worn pin"
                                             : "The ridges"};
  section.items.emplace_back(Paragraph{sentence(run)});
  if (tip && run.tip_profile && run.tip_profile->rows() > 0) section.items.emplace_back(tip_profile(run));
  if (tip) section.items.emplace_back(tip_growth(run));
  if (ridges) {
    section.items.emplace_back(ridge_growth(run));
    section.items.emplace_back(displaced_volume(run));
  }
  section.items.emplace_back(ledgers(run));
  return section;
}

}  // namespace abradem::report
