// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>

#include "abradem/core/error.h"
#include "abradem/io/atomic_file.h"
#include "abradem/report/figure_data.h"
#include "abradem/report/page_parts.h"
#include "abradem/report/page_source.h"
#include "abradem/report/text.h"

namespace abradem::report {
namespace {

/// Points of a figure that the page carries, and their digits: more than a screen can show.
constexpr std::size_t kMaxPoints = 20000;
constexpr int kDigits = 7;

/// From so many sections, or figures and tables, on a page has a table of contents.
constexpr std::size_t kManySections = 4, kManyItems = 7;

/// A figure or a table with its number in the page.
template <class Item>
struct Numbered {
  int number = 0;
  const Item* item = nullptr;
};

struct Numbering {
  std::vector<Numbered<Figure>> figures;
  std::vector<Numbered<DataTable>> tables;
};

/// @param figures, tables numbered before
Numbering number(const std::vector<PageSection>& sections, int figures = 0, int tables = 0) {
  Numbering out;
  for (const PageSection& section : sections) {
    for (const auto& item : section.items) {
      if (const auto* figure = std::get_if<Figure>(&item)) out.figures.push_back({++figures, figure});
      if (const auto* table = std::get_if<DataTable>(&item)) out.tables.push_back({++tables, table});
    }
  }
  return out;
}

bool is_id(std::string_view id) {
  return !id.empty() && std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

void check(const DataTable& table) {
  const auto fail = [&](const std::string& what) {
    throw Error(ExitCode::internal, fmt::format("table '{}': {}", table.id, what));
  };
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    if (table.rows[r].size() != table.columns.size())
      fail(fmt::format("row {} has {} cells, the header {}", r + 1, table.rows[r].size(),
                       table.columns.size()));
  }
  if (!table.links.empty() && table.links.size() != table.rows.size())
    fail(fmt::format("{} links for {} rows", table.links.size(), table.rows.size()));
  for (const std::string& link : table.links) {
    if (link.starts_with('/') || link.find(':') != std::string::npos)
      fail(fmt::format("link '{}'; expected a path relative to the page", link));
  }
}

void check(const Numbering& items) {
  std::set<std::string> seen;
  const auto check_id = [&](const std::string& id) {
    if (!is_id(id))
      throw Error(
          ExitCode::internal,
          fmt::format("figure or table id '{}'; expected lower-case letters, digits, '-' and '_'", id));
    if (!seen.insert(id).second)
      throw Error(ExitCode::internal, fmt::format("two figures or tables have the id '{}'", id));
  };
  for (const auto& [number, figure] : items.figures) {
    check_id(figure->id);
    check(*figure);
  }
  for (const auto& [number, table] : items.tables) {
    check_id(table->id);
    check(*table);
  }
}

// ---------------------------------------------------------------- tables

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

/// A column is one of numbers when all its cells begin like one, dashes for missing values aside.
bool is_numeric(const DataTable& table, std::size_t column) {
  bool any = false;
  for (const auto& row : table.rows) {
    std::string_view cell = row[column];
    if (cell.empty() || cell == "–" || cell == "-" || cell == "nan") continue;
    for (const std::string_view sign : {"−", "-", "+", "±", "<", ">", "≤", "≥", "≈", " "}) {
      while (cell.starts_with(sign)) cell.remove_prefix(sign.size());
    }
    if (cell.empty() || cell.front() < '0' || cell.front() > '9') return false;
    // A sentence may begin with a number; a number with its unit and its deviation is short.
    if (cell.size() > 32) return false;
    any = true;
  }
  return any;
}

std::string badge(const std::string& verdict) {
  static constexpr std::array<std::array<const char*, 3>, 3> kBadges = {
      {{"reproduced", "good", "✓"}, {"trend only", "partly", "≈"}, {"not reproduced", "bad", "✗"}}};
  for (const auto& [text, style, sign] : kBadges) {
    if (verdict == text)
      return fmt::format("<span class=\"mark {}\"><span aria-hidden=\"true\">{} </span>{}</span>", style,
                         sign, text);
  }
  if (verdict.empty()) return {};
  return fmt::format("<span class=\"mark none\">{}</span>", escape_html(verdict));
}

std::string table_rows(const DataTable& table) {
  std::vector<std::string> styles;  // per column: class, or empty
  std::vector<bool> verdicts;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const bool words = std::any_of(table.rows.begin(), table.rows.end(),
                                   [&](const auto& row) { return row[c].size() > 60; });
    verdicts.push_back(lower(table.columns[c]).starts_with("verdict"));
    styles.push_back(is_numeric(table, c) ? " class=\"number\"" : words ? " class=\"words\"" : "");
  }
  std::string out = "<thead><tr>";
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    out += fmt::format("<th scope=\"col\"{}>{}</th>", styles[c], escape_html(table.columns[c]));
  out += "</tr></thead>\n<tbody>\n";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    out += "<tr>";
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const std::string& cell = table.rows[r][c];
      std::string content = verdicts[c] ? badge(cell) : escape_html(cell);
      if (c == 0 && !table.links.empty() && !table.links[r].empty())
        content = fmt::format("<a href=\"{}\">{}</a>", escape_html(table.links[r]), content);
      out += fmt::format("<td{}{}>{}</td>", styles[c],
                         verdicts[c] ? fmt::format(" data-value=\"{}\"", escape_html(cell)) : "", content);
    }
    out += "</tr>\n";
  }
  return out + "</tbody>\n";
}

std::string csv_link(const std::string& id) {
  return fmt::format("<a class=\"csv\" href=\"tables/{0}.csv\" download=\"{0}.csv\">CSV</a>", id);
}

std::string caption(const char* kind, int number, const std::string& title, const std::string& text) {
  return fmt::format("<b>{} {}.</b>{}{}{}", kind, number,
                     title.empty() ? "" : " <b>" + escape_html(title) + ".</b>", text.empty() ? "" : " ",
                     escape_html(text));
}

std::string table_html(const Numbered<DataTable>& numbered) {
  const DataTable& table = *numbered.item;
  std::string out = fmt::format(
      "<div class=\"datatable\" id=\"table-{0}\">\n<p class=\"caption\" id=\"caption-{0}\">{1} "
      "<span class=\"links\">{2}</span></p>\n",
      table.id, caption("Table", numbered.number, table.title, table.caption), csv_link(table.id));
  if (table.rows.empty()) return out + "<p class=\"empty\">No rows.</p>\n</div>\n";
  return out + fmt::format(
                   "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-labelledby=\"caption-{}\">\n"
                   "<table class=\"wide\">{}</table></div>\n</div>\n",
                   table.id, table_rows(table));
}

std::string table_csv(const DataTable& table) {
  std::string out;
  const auto add = [&](const std::vector<std::string>& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (c > 0) out += ',';
      out += csv_field(cells[c]);
    }
    out += '\n';
  };
  add(table.columns);
  for (const auto& row : table.rows) add(row);
  return out;
}

// ---------------------------------------------------------------- figures

std::string figure_html(const Numbered<Figure>& numbered) {
  const Figure& figure = *numbered.item;
  const std::size_t all = row_count(figure), carried = row_count(thinned(figure, kMaxPoints));
  std::string text = figure.caption;
  if (carried < all) {
    text += fmt::format("{}Drawn from {} of {} points; tables/{}.csv has all.", text.empty() ? "" : " ",
                        readable_count(static_cast<long long>(carried)),
                        readable_count(static_cast<long long>(all)), figure.id);
  }
  return fmt::format(
      "<figure id=\"fig-{}\" class=\"study\">\n<div class=\"plot\" role=\"img\" aria-label=\"{}\"></div>\n"
      "<figcaption>{} <span class=\"words\"></span> <span "
      "class=\"links\">{}</span></figcaption>\n</figure>\n",
      figure.id, escape_html(figure.title), caption("Figure", numbered.number, figure.title, text),
      csv_link(figure.id));
}

std::string figure_blocks(const Numbering& items) {
  std::string specifications;
  std::string out;
  for (const auto& [number, figure] : items.figures) {
    const Figure drawn = thinned(*figure, kMaxPoints);
    specifications += (specifications.empty() ? "" : ",\n") + figure_json(drawn, *figure, number);
    out += data_block("fig-" + figure->id, figure_csv(drawn, kDigits));
  }
  return data_block("figures", "[" + specifications + "]") + out;
}

// ---------------------------------------------------------------- the page

std::string cards_html(const Page& page) {
  if (page.cards.empty()) return {};
  std::string out = "<section aria-label=\"Results\">\n<ul class=\"cards\">\n";
  for (const auto& [label, value] : page.cards) {
    out += fmt::format("<li class=\"card\"><h3>{}</h3><p class=\"value{}\">{}</p></li>\n", escape_html(label),
                       value.size() > 22 ? " long" : "", escape_html(value));
  }
  return out + "</ul>\n</section>\n";
}

std::string contents_html(const Page& page, const Numbering& items) {
  if (page.sections.size() < kManySections && items.figures.size() + items.tables.size() < kManyItems)
    return {};
  std::string out = "<nav class=\"contents\" aria-label=\"Contents\">\n<h2>Contents</h2>\n<ol>\n";
  std::size_t figures = 0, tables = 0;
  for (std::size_t s = 0; s < page.sections.size(); ++s) {
    out += fmt::format("<li><a href=\"#section-{}\">{}</a>", s + 1, escape_html(page.sections[s].title));
    std::string inner;
    const auto add = [&](const char* kind, const char* prefix, int number, const auto& item) {
      inner += fmt::format("<li><a href=\"#{}-{}\">{} {}</a> {}</li>\n", prefix, item.id, kind, number,
                           escape_html(item.title));
    };
    for (const auto& item : page.sections[s].items) {
      if (const auto* figure = std::get_if<Figure>(&item))
        add("Figure", "fig", items.figures[figures++].number, *figure);
      if (const auto* table = std::get_if<DataTable>(&item))
        add("Table", "table", items.tables[tables++].number, *table);
    }
    out += inner.empty() ? "</li>\n" : fmt::format("\n<ul>\n{}</ul></li>\n", inner);
  }
  return out + "</ol>\n</nav>\n";
}

std::string sections_html(const std::vector<PageSection>& sections, const Numbering& items) {
  std::string out;
  std::size_t figures = 0, tables = 0;
  for (std::size_t s = 0; s < sections.size(); ++s) {
    const PageSection& section = sections[s];
    out += fmt::format("<section aria-labelledby=\"section-{0}\">\n<h2 id=\"section-{0}\">{1}</h2>\n", s + 1,
                       escape_html(section.title));
    for (const auto& item : section.items) {
      if (const auto* paragraph = std::get_if<Paragraph>(&item)) {
        out += fmt::format("<p class=\"text\">{}</p>\n", escape_html(paragraph->text));
      } else if (std::holds_alternative<DataTable>(item)) {
        out += table_html(items.tables[tables++]);
      } else {
        out += figure_html(items.figures[figures++]);
      }
    }
    out += "</section>\n";
  }
  return out;
}

/// The tables of figures and tables, and the description of the figures.
std::string write_tables(const std::filesystem::path& folder, const Numbering& items) {
  const std::filesystem::path tables = folder / "tables";
  std::error_code code;
  std::filesystem::create_directories(tables, code);
  if (code) throw IoError(fmt::format("cannot make the folder '{}': {}", tables.string(), code.message()));
  std::string specifications;
  for (const auto& [number, figure] : items.figures) {
    io::write_file_atomically(tables / (figure->id + ".csv"), figure_csv(*figure, 0));
    specifications += (specifications.empty() ? "" : ",\n") + figure_json(*figure, *figure, number);
  }
  for (const auto& [number, table] : items.tables)
    io::write_file_atomically(tables / (table->id + ".csv"), table_csv(*table));
  return specifications;
}

}  // namespace

std::string page_html(const Page& page) {
  const Numbering items = number(page.sections);
  check(items);
  return shell({.kicker = "Abradem",
                .title = page.title,
                .lead = page.summary,
                .body = cards_html(page) + contents_html(page, items) + sections_html(page.sections, items),
                .data = figure_blocks(items),
                .script = figures_script()});
}

SectionParts section_parts(const std::vector<PageSection>& sections, int figures, int tables) {
  const Numbering items = number(sections, figures, tables);
  check(items);
  return {sections_html(sections, items), figure_blocks(items)};
}

void write_section_tables(const std::filesystem::path& folder, const std::vector<PageSection>& sections) {
  write_tables(folder, number(sections));
}

std::filesystem::path write_page(const std::filesystem::path& folder, const Page& page) {
  const std::string html = page_html(page);
  const Numbering items = number(page.sections);
  const std::string specifications = write_tables(folder, items);
  io::write_file_atomically(folder / "tables" / "figures.json", "[" + specifications + "]\n");
  std::filesystem::path file = folder / "report.html";
  io::write_file_atomically(file, html);
  return file;
}

}  // namespace abradem::report
