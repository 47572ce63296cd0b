// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

/// What the pages of this room have in common.
namespace abradem::report {

/// The places of a template: name and what stands there.
using Places = std::map<std::string, std::string, std::less<>>;

/// Fills the {{name}} places in one pass, so that text of a case is never taken for a place.
/// @throws Error (internal) when the template names a place that is not given
[[nodiscard]] std::string fill(std::string_view page, const Places& places);

/// Bytes for the page's script, packed (zlib, base64) in an element with the id data-<name>.
[[nodiscard]] std::string data_block(std::string_view name, std::string_view bytes);

/// The whole page: the shell with its style, the chart library and the tools, around what a page has of its
/// own.
struct PageContent {
  std::string kicker;  ///< what kind of page this is
  std::string title;   ///< plain text
  std::string lead;    ///< plain text: the answer in a sentence
  std::string body;    ///< HTML
  std::string data;    ///< data blocks
  std::string_view script;
};
[[nodiscard]] std::string shell(const PageContent& content);

}  // namespace abradem::report
