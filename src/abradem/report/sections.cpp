// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/sections.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "abradem/report/particles_section.h"
#include "abradem/report/text.h"

namespace abradem::report {
namespace {

/// The state after the last revolution; NaN where no revolution was completed.
struct LastRow {
  double revolution, time_s, volume_mm3, depth_um, depth_sd_um, width_mm, width_sd_mm;
};

LastRow last_row(const RunFolder& run) {
  const Table& table = run.revolutions;
  const auto last = [&](const char* name) {
    return table.rows() > 0 ? table[name].back() : std::numeric_limits<double>::quiet_NaN();
  };
  const double swept = last("swept_volume_mm3");
  return {last("revolution"),
          last("time_s"),
          std::isfinite(swept) ? swept : run.manifest.ledger.swept_volume_mm3,
          1e3 * last("depth_mean_mm"),
          1e3 * last("depth_sd_mm"),
          last("width_mean_mm"),
          last("width_sd_mm")};
}

/// "12 revolutions", "3 cycles"; where nothing repeats itself, the time.
std::string duration(const RunFolder& run, const LastRow& row) {
  const std::string& counted = run.manifest.counted;
  if (counted == "output") return readable(row.time_s) + " s";
  return fmt::format("{:.6g} {}{}", row.revolution, counted, row.revolution == 1.0 ? "" : "s");
}

enum class Mark { none, good, bad };

struct Card {
  std::string name, value, unit, note;
  Mark mark = Mark::none;
  std::string mark_text;
};

std::string html(const Card& card) {
  std::string out = fmt::format("<li class=\"card\"><h3>{}</h3><p class=\"value\">{}", escape_html(card.name),
                                escape_html(card.value));
  if (!card.unit.empty()) out += fmt::format(" <span class=\"unit\">{}</span>", escape_html(card.unit));
  out += "</p>";
  if (card.mark != Mark::none) {
    out += fmt::format("<p><span class=\"mark {}\">{}</span></p>", card.mark == Mark::good ? "good" : "bad",
                       escape_html(card.mark_text));
  }
  return out + fmt::format("<p class=\"note\">{}</p></li>\n", escape_html(card.note));
}

/// Says where a value lies against the laboratory's range.
void compare(Card& card, double value, double low, double high) {
  if (!std::isfinite(value)) return;
  card.mark = value >= low && value <= high ? Mark::good : Mark::bad;
  card.mark_text = card.mark == Mark::good ? "inside the measured range"
                   : value < low           ? "below the measured range"
                                           : "above the measured range";
}

std::string after_laboratory_revolutions(const Measurement& lab) {
  return lab.revolutions ? fmt::format(", after {:.6g} rev", *lab.revolutions) : std::string{};
}

Card volume_card(const RunFolder& run, const LastRow& row) {
  Card card{"Wear volume", readable(row.volume_mm3),
            "mm³",         "What the mesh lost; the case states no measurement.",
            Mark::none,    ""};
  if (const auto& lab = run.manifest.measurement.wear_volume_mm3) {
    card.note = fmt::format("Laboratory: {} ± {} mm³{}", readable(lab->mean, 3), readable(lab->sd, 2),
                            after_laboratory_revolutions(run.manifest.measurement));
    compare(card, row.volume_mm3, lab->mean - lab->sd, lab->mean + lab->sd);
  }
  return card;
}

Card groove_card(const char* name, const char* unit, double value, double sd, const std::optional<Band>& lab,
                 double scale, const Measurement& measurement) {
  Card card{name, readable(value, 3), unit, "", Mark::none, ""};
  if (std::isfinite(sd))
    card.note = fmt::format("Standard deviation {} {} over the contours", readable(sd, 2), unit);
  if (lab) {
    card.note += fmt::format("{}Laboratory: {} to {} {}{}", card.note.empty() ? "" : ". ",
                             readable(scale * lab->low, 2), readable(scale * lab->high, 2), unit,
                             after_laboratory_revolutions(measurement));
    compare(card, value, scale * lab->low, scale * lab->high);
  }
  return card;
}

Card status_card(const RunFolder& run, const LastRow& row) {
  const Manifest& m = run.manifest;
  Card card{"Status", m.status, "", "", m.status == "completed" ? Mark::good : Mark::bad, ""};
  card.mark_text = m.status == "running" ? "not ended" : fmt::format("exit code {}", m.exit_code);
  card.value.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(card.value.front())));
  card.note =
      fmt::format("{}{} steps in {} s", std::isfinite(row.revolution) ? duration(run, row) + ", " : "",
                  readable_count(m.steps), readable(m.wall_seconds, 3));
  return card;
}

std::string ledger_cards(const LedgerSummary& ledger) {
  return html({"κ, mesh over law", readable(ledger.kappa, 6), "[-]",
               "Volume the mesh lost over the volume of the wear law. 1: the shape obeys the law.",
               Mark::none, ""}) +
         html(
             {"Ledger residual", readable(ledger.residual_relative, 2), "[-]",
              "Swept against deposited volume. Round-off (below 10⁻⁹) when the deformation conserves volume.",
              Mark::none, ""});
}

/// Of the wall that wore most: of its nodes where it changed its shape, else of its elements.
Card depth_card(const RunFolder& run) {
  Card card{"Greatest wear depth", "–", "µm", "Of the wall that wore most.", Mark::none, ""};
  if (run.surface) {
    card.value = readable(run.surface->max_depth_um, 3);
  } else if (run.wear && run.wear->rows() > 0) {
    card.value = readable(std::ranges::max((*run.wear)["wear_depth_um"]), 3);
    card.note = "Volume over area of the element that wore most.";
  }
  return card;
}

/// What has left, and how fast since the first did.
Card left_card(const Table& particles, const Outflow& outflow) {
  return {"Mass that left",
          readable(particles["removed_mass_kg"].back()),
          "kg",
          fmt::format("{} particles; {} kg/s on average since {} s",
                      readable_count(static_cast<long long>(particles["removed"].back())),
                      readable(outflow.rate), readable(outflow.since)),
          Mark::none,
          ""};
}

/// Of a run with particles in numbers.
std::string bulk_cards(const RunFolder& run, const LastRow& row) {
  const LedgerSummary& ledger = run.manifest.ledger;
  std::string out;
  if (ledger.law_volume_mm3 > 0.0) {
    Card volume = volume_card(run, row);
    if (ledger.kappa == 0.0) {
      volume.value = readable(ledger.law_volume_mm3);
      volume.note = "By the wear laws; the walls keep their shape.";
    }
    out += html(volume) + html(depth_card(run));
    if (ledger.kappa > 0.0) out += ledger_cards(ledger);
  }
  if (run.particles && run.particles->rows() > 0) {
    const Table& p = *run.particles;
    out += html({"Particles in the run", readable_count(static_cast<long long>(p["particles"].back())), "",
                 fmt::format("{} kg; {} were put in", readable(p["mass_kg"].back()),
                             readable_count(static_cast<long long>(p["inserted"].back()))),
                 Mark::none, ""});
    if (const auto outflow = mean_outflow(p)) out += html(left_card(p, *outflow));
  }
  return out + html(status_card(run, row));
}

std::string row_html(const std::string& name, const std::string& value, const std::string& meaning) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td class=\"number\">{}</td><td>{}</td></tr>\n",
                     escape_html(name), escape_html(value), escape_html(meaning));
}

std::string pair_html(const std::string& name, const std::string& value) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escape_html(name),
                     escape_html(value));
}

}  // namespace

std::string page_title(const RunFolder& run) {
  if (!run.manifest.case_title.empty()) return run.manifest.case_title;
  const std::filesystem::path folder = run.folder.lexically_normal();
  return "Run in " + (folder.has_filename() ? folder.filename() : folder.parent_path().filename()).string();
}

std::string verdict(const RunFolder& run) {
  const LastRow row = last_row(run);
  const LedgerSummary& ledger = run.manifest.ledger;
  std::string out;
  if (run.manifest.status != "completed") {
    out = fmt::format("The run {}; what follows is the last good state. ",
                      run.manifest.status == "failed"    ? "was stopped because it failed"
                      : run.manifest.status == "running" ? "is going on, or was killed"
                                                         : "was interrupted");
    if (!run.manifest.error.empty())
      out = fmt::format("The run failed: {}. What follows is the last good state. ", run.manifest.error);
  }
  if (!run.has_groove() && ledger.law_volume_mm3 == 0.0)
    return out +
           (std::isfinite(row.revolution) ? fmt::format("After {} no wall", duration(run, row))
                                          : std::string("No wall")) +
           " has worn.";
  if (!run.has_groove() && ledger.kappa == 0.0)
    return out + fmt::format("{} the wear laws have taken {} mm³ from walls that keep their shape.",
                             std::isfinite(row.revolution) ? "After " + duration(run, row) : "So far",
                             readable(ledger.law_volume_mm3));
  if (std::isfinite(row.revolution)) {
    out += fmt::format("After {} the {} lost {} mm³", duration(run, row),
                       run.has_groove() ? "wall has" : "walls have", readable(row.volume_mm3));
  } else {
    out += fmt::format("The wall has lost {} mm³", readable(row.volume_mm3));
  }
  if (run.has_groove() && std::isfinite(row.depth_um) && std::isfinite(row.width_mm)) {
    out += fmt::format(" from a groove {} µm deep and {} mm wide", readable(row.depth_um, 3),
                       readable(row.width_mm, 3));
  }
  return out + fmt::format(", {} times what the wear law removes (κ).", readable(ledger.kappa, 4));
}

std::string verdict_cards(const RunFolder& run) {
  const LastRow row = last_row(run);
  const Measurement& lab = run.manifest.measurement;
  const LedgerSummary& ledger = run.manifest.ledger;
  if (!run.has_groove()) return bulk_cards(run, row);
  std::string out = html(volume_card(run, row));
  out += html(groove_card("Groove depth", "µm", row.depth_um, row.depth_sd_um, lab.depth_mm, 1e3, lab));
  out += html(groove_card("Groove width", "mm", row.width_mm, row.width_sd_mm, lab.width_mm, 1.0, lab));
  out += ledger_cards(ledger);
  out += html(status_card(run, row));
  return out;
}

std::string ledger_table(const RunFolder& run) {
  const LedgerSummary& ledger = run.manifest.ledger;
  if (!run.has_groove() && ledger.law_volume_mm3 == 0.0)
    return "<p class=\"text\">No wall has worn: there is nothing to account for.</p>\n";
  std::string out =
      "<table class=\"wide\"><thead><tr><th scope=\"col\">Entry</th><th scope=\"col\" "
      "class=\"number\">Value</th>"
      "<th scope=\"col\">What it means</th></tr></thead><tbody>\n";
  out +=
      row_html("Law volume", readable(ledger.law_volume_mm3, 6) + " mm³",
               "What the wear laws remove: of Archard's, the sum of α F v dt over every contact and step.");
  out += row_html(
      "Deposited volume", readable(ledger.deposited_volume_mm3, 6) + " mm³",
      "What the elements of the wall were charged with. Equals the law volume unless something was lost "
      "on the way from contact to element.");
  out +=
      row_html("Swept volume", readable(ledger.swept_volume_mm3, 6) + " mm³",
               "What the mesh lost, from its geometry alone. This is the volume a profilometer would find.");
  out += row_html(
      "Relative residual", readable(ledger.residual_relative, 3) + " [-]",
      "Swept minus deposited, over deposited. Round-off means that every cubic micrometre is accounted for.");
  out += row_html("κ", readable(ledger.kappa, 8) + " [-]",
                  "Swept over law volume, of the walls that change their shape. 1 in the conserving rule; "
                  "about 6.05 in the paper's rule on a regular mesh, "
                  "which moves all three nodes of an element by its full depth.");
  return out + "</tbody></table>\n";
}

std::string limits_and_warnings(const RunFolder& run) {
  const Manifest& m = run.manifest;
  std::string out;
  if (!m.limits.empty()) {
    out +=
        "<table class=\"wide\"><thead><tr><th scope=\"col\">Limit</th><th scope=\"col\" "
        "class=\"number\">This run</th>"
        "<th scope=\"col\" class=\"number\">Allowed</th><th scope=\"col\">Verdict</th></tr></thead><tbody>\n";
    for (const LimitCheck& limit : m.limits) {
      out += fmt::format(
          "<tr><th scope=\"row\">{}</th><td class=\"number\">{}</td><td class=\"number\">{}</td>"
          "<td><span class=\"mark {}\">{}</span></td></tr>\n",
          escape_html(limit.name), escape_html(limit.value), escape_html(limit.limit),
          limit.ok ? "good" : "bad", limit.ok ? "within" : "exceeded");
    }
    out += "</tbody></table>\n";
  }
  if (m.warnings.empty()) return out + "<p>The run gave no warning.</p>\n";
  out += "<ul class=\"warnings\">\n";
  for (const std::string& warning : m.warnings) out += fmt::format("<li>{}</li>\n", escape_html(warning));
  return out + "</ul>\n";
}

std::string inputs(const RunFolder& run) {
  std::string out;
  if (!run.manifest.setup.empty()) {
    out += "<table class=\"pairs\"><tbody>\n";
    for (const auto& [name, value] : run.manifest.setup) out += pair_html(name, value);
    out += "</tbody></table>\n";
  }
  return out + fmt::format(
                   "<details><summary>The resolved case, every default written out</summary>"
                   "<pre tabindex=\"0\">{}</pre></details>\n",
                   escape_html(run.resolved_case));
}

std::string record_table(const RunFolder& run) {
  const Manifest& m = run.manifest;
  std::string out = "<table class=\"pairs\"><tbody>\n";
  out += pair_html("Abradem", fmt::format("{} (commit {})", m.version, m.commit));
  out += pair_html("Compiler", m.compiler);
  out += pair_html("Threads", fmt::format("{}", m.threads));
  out += pair_html("Seed", fmt::format("{}", m.seed));
  out += pair_html("Steps", readable_count(m.steps));
  out += pair_html("Wall time", readable(m.wall_seconds, 3) + " s");
  out += pair_html(
      "Speed",
      readable_count(std::isfinite(m.steps_per_second) ? std::llround(m.steps_per_second) : 0) + " steps/s");
  out += pair_html("State hash", m.state_hash);
  out += pair_html(
      "Status", m.status == "running" ? m.status : fmt::format("{} (exit code {})", m.status, m.exit_code));
  return out + "</tbody></table>\n";
}

}  // namespace abradem::report
