// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "abradem/core/units.h"

namespace abradem::cli {

/// The quantity that an option was given. @throws InputError naming the option when it is none
core::Quantity quantity_of(std::string_view text, const char* option);

}  // namespace abradem::cli
