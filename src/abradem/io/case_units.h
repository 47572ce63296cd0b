// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abradem/io/case_checks.h"

namespace abradem::io {

/// Asks about numbers that no material or machine has, but that the same text in another unit would be: a
/// density in g/cm^3, a modulus in GPa, degrees for radians, grams for newtons, millimetres for metres. What
/// cannot be meant is an error, what can is a note. docs/theory/units.md#plausibility
void check_units(const simulation::Setup& setup, const Places& places, Problems& problems);

}  // namespace abradem::io
