// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "abradem/simulation/setup.h"
#include "abradem/wear/laws.h"

namespace abradem::simulation {

/// The laws of a pair, all coefficients times `acceleration`.
/// @throws InputError where Oka's law lacks the hardness of what is worn, or as expression_of
[[nodiscard]] wear::Laws laws_of(const Setup& setup, const WearSetup& wear, double acceleration);

/// The expression of a pair.   @throws wear::ExpressionError
[[nodiscard]] std::shared_ptr<const wear::Expression> expression_of(const Setup& setup,
                                                                    const WearSetup& wear);

}  // namespace abradem::simulation
