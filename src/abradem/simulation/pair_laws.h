// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/simulation/setup.h"
#include "abradem/wear/laws.h"

namespace abradem::simulation {

/// The laws of a pair, all coefficients times `acceleration`.
/// @throws InputError where Oka's law lacks the hardness of what is worn
[[nodiscard]] wear::Laws laws_of(const Setup& setup, const WearSetup& wear, double acceleration);

}  // namespace abradem::simulation
