// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "abradem/io/case_problems.h"
#include "abradem/io/case_value.h"
#include "abradem/simulation/setup.h"

namespace abradem::io {

/// A key of the case and what a variation gives it.
struct KeyedValue {
  std::string key;  ///< dotted
  Place place;      ///< of the key
  const Value* value = nullptr;
};

/// The keys of a table `set`, `together` or `vary`: dotted keys in quotes as they stand, others joined.
[[nodiscard]] std::vector<KeyedValue> keyed_values(const Value& table);

/// Adds what is wrong with a study that has been read: names of its variations, lists of unequal length, and
/// every problem of every run.
/// @param tree the whole file with the user's overrides   @param base the file without them
/// @param user the user's overrides, parsed: they go over what a variation sets, not over what it varies
/// @param check_run checks the tree of one run, with the problems going where these go
void check_study(const Value& tree, const Value& base, const std::vector<Value>& user,
                 const simulation::StudySetup& study, Problems& problems,
                 const std::function<void(const Value& run)>& check_run);

}  // namespace abradem::io
