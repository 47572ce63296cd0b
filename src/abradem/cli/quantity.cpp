// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/cli/quantity.h"

#include <fmt/core.h>

#include "abradem/core/error.h"

namespace abradem::cli {

core::Quantity quantity_of(std::string_view text, const char* option) {
  try {
    return core::parse_quantity(text);
  } catch (const core::UnitError& error) {
    throw InputError(fmt::format("{} {}: {}", option, text, error.what()));
  }
}

}  // namespace abradem::cli
