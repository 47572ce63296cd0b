// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "abradem/simulation/setup.h"

namespace abradem::cli {

/// The case in a few lines for a person: walls with their size, particles, length and method of the run.
[[nodiscard]] std::string summarize(const simulation::Setup& setup);

}  // namespace abradem::cli
