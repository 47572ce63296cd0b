// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/particles_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "abradem/report/text.h"

namespace abradem::report {
namespace {

using Kind = Series::Kind;

constexpr std::string_view kModelled = "modelled_time_s";

const Axis kTime{.title = "time [s]"};

Series against_time(const Table& table, std::string_view column, std::string name, int colour) {
  return {.kind = Kind::line,
          .name = std::move(name),
          .x = table["time_s"],
          .y = table[column],
          .colour = colour};
}

bool accelerated(const Table& table) {
  return std::ranges::find(table.names, kModelled) != table.names.end();
}

/// The time that the flow took: less than the test's where its wear is accelerated.
const std::vector<double>& flow_time(const Table& table) {
  return table[accelerated(table) ? kModelled : "time_s"];
}

/// What leaves per second between two rows, at the middle of them.
Series mass_flow(const Table& table) {
  const std::vector<double>&time = table["time_s"], &flowed = flow_time(table),
        &mass = table["removed_mass_kg"];
  Series flow{.kind = Kind::line, .colour = 1};
  for (std::size_t r = 1; r < table.rows(); ++r) {
    if (!(flowed[r] > flowed[r - 1])) continue;
    flow.x.push_back(0.5 * (time[r] + time[r - 1]));
    flow.y.push_back((mass[r] - mass[r - 1]) / (flowed[r] - flowed[r - 1]));
  }
  return flow;
}

Figure numbers(const Table& table) {
  Figure figure{.id = "particle-numbers",
                .title = "Particles",
                .caption = "In the run, put in and taken out since it began.",
                .columns = 2};
  Panel count{.title = "Number", .x = kTime, .y = {.title = "particles [-]"}};
  count.series = {against_time(table, "particles", "in the run", 0),
                  against_time(table, "inserted", "put in", 2),
                  against_time(table, "removed", "taken out", 1)};
  Panel contacts{.title = "Contacts", .x = kTime, .y = {.title = "contacts [-]"}};
  contacts.series = {against_time(table, "contacts", "of two particles", 4),
                     against_time(table, "wall_contacts", "with walls", 3)};
  figure.panels = {std::move(count), std::move(contacts)};
  return figure;
}

Figure flow(const Table& table) {
  Figure figure{
      .id = "mass-flow",
      .title = "Mass that left",
      .caption =
          std::string("Particles whose centre left the domain; the rate is that between two outputs.") +
          (accelerated(table) ? " Both are of the flow as it was modelled: the wear alone is "
                                "accelerated."
                              : ""),
      .columns = 2};
  Panel mass{.title = "Mass", .x = kTime, .y = {.title = "mass [kg]"}};
  mass.series = {against_time(table, "mass_kg", "in the run", 0),
                 against_time(table, "removed_mass_kg", "taken out", 1)};
  Panel rate{.title = "Rate", .x = kTime, .y = {.title = "mass flow [kg/s]"}};
  rate.series = {mass_flow(table)};
  figure.panels = {std::move(mass), std::move(rate)};
  return figure;
}

Figure energies(const Table& table) {
  Figure figure{.id = "particle-energy",
                .title = "Motion",
                .caption = "Kinetic: of translation and spin. Elastic: stored in the contacts.",
                .columns = 2};
  Panel energy{.title = "Energy", .x = kTime, .y = {.title = "energy [J]"}};
  energy.series = {against_time(table, "kinetic_energy_J", "kinetic", 0),
                   against_time(table, "elastic_energy_J", "elastic", 1)};
  Panel speed{.title = "Fastest particle", .x = kTime, .y = {.title = "speed [m/s]"}};
  speed.series = {against_time(table, "fastest_m_per_s", "", 2)};
  figure.panels = {std::move(energy), std::move(speed)};
  return figure;
}

std::string number(const Table& table, std::string_view column) {
  return readable_count(static_cast<long long>(table[column].back()));
}

std::string sentence(const Table& table) {
  std::string text = fmt::format(
      "At {} s the run holds {} particles of {} kg in {} contacts with each other and {} with walls.",
      readable(table["time_s"].back()), number(table, "particles"), readable(table["mass_kg"].back()),
      number(table, "contacts"), number(table, "wall_contacts"));
  if (table["removed"].back() > 0.0)
    text += fmt::format(" {} left it, {} kg.", number(table, "removed"),
                        readable(table["removed_mass_kg"].back()));
  return text;
}

}  // namespace

std::optional<Outflow> mean_outflow(const Table& particles) {
  const std::vector<double>&time = flow_time(particles), &mass = particles["removed_mass_kg"];
  if (mass.empty() || mass.front() > 0.0 || !(mass.back() > 0.0)) return std::nullopt;
  std::size_t first = 0;
  while (mass[first + 1] == 0.0) ++first;
  return Outflow{(mass.back() - mass[first]) / (time.back() - time[first]), time[first]};
}

std::optional<PageSection> particles_section(const RunFolder& run) {
  if (!run.particles || run.particles->rows() == 0) return std::nullopt;
  const Table& table = *run.particles;
  PageSection section{.title = "Particles"};
  section.items.emplace_back(Paragraph{sentence(table)});
  section.items.emplace_back(numbers(table));
  if (table["removed"].back() > 0.0) section.items.emplace_back(flow(table));
  section.items.emplace_back(energies(table));
  return section;
}

}  // namespace abradem::report
