// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/page_parts.h"

#include <fmt/core.h>

#include "abradem/core/error.h"
#include "abradem/report/page_source.h"
#include "abradem/report/text.h"

namespace abradem::report {

std::string fill(std::string_view page, const Places& places) {
  std::string out;
  while (true) {
    const std::size_t open = page.find("{{");
    const std::size_t close = open == std::string_view::npos ? open : page.find("}}", open);
    if (close == std::string_view::npos) return out.append(page);
    out.append(page.substr(0, open));
    const std::string_view name = page.substr(open + 2, close - open - 2);
    const auto place = places.find(name);
    if (place == places.end())
      throw Error(ExitCode::internal, fmt::format("report template names '{}', which nothing fills", name));
    out += place->second;
    page.remove_prefix(close + 2);
  }
}

std::string data_block(std::string_view name, std::string_view bytes) {
  return fmt::format("<script type=\"application/octet-stream\" id=\"data-{}\">{}</script>\n", name,
                     base64(deflate(bytes)));
}

std::string shell(const PageContent& content) {
  return fill(page_shell(), {{"title", escape_html(content.title)},
                             {"style", std::string(page_style())},
                             {"kicker", escape_html(content.kicker)},
                             {"lead", escape_html(content.lead)},
                             {"body", content.body},
                             {"data", content.data},
                             {"charts", base64(page_charts_gzip())},
                             {"tools", std::string(chart_tools_script())},
                             {"script", std::string(content.script)}});
}

}  // namespace abradem::report
