// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/case_study.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "abradem/io/case_schema.h"
#include "abradem/io/case_toml.h"
#include "abradem/study/variations.h"

namespace abradem::io {
namespace {

constexpr std::size_t kMostRuns = 10000;  // more is a slip of the finger, or a job for `sweep`

void collect(const Value& table, const std::string& prefix, std::vector<KeyedValue>& out) {
  for (const Entry& e : table.entries) {
    const std::string key = prefix.empty() ? e.key : fmt::format("{}.{}", prefix, toml_key(e.key));
    if (is_dotted(e))
      collect(e.value, key, out);
    else
      out.push_back({key, e.place, &e.value});
  }
}

/// The lists of one variation in the order in which its setup has them.
struct Lists {
  Place place;
  std::vector<KeyedValue> set, together, vary;
};

std::vector<KeyedValue> list_of(const Value& variation, std::string_view word) {
  const Entry* entry = variation.find(word);
  return entry == nullptr ? std::vector<KeyedValue>{} : keyed_values(entry->value);
}

bool good_name(const std::string& name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !name.empty() && name.front() != '-' && std::ranges::all_of(name, allowed);
}

/// Names and lengths. @return false when the runs cannot be listed
bool check_lists(const simulation::VariationSetup& variation, const Lists& lists, Problems& problems) {
  bool good = true;
  for (const KeyedValue& k : lists.together) {
    if (k.value->items.size() == study::side_by_side(variation)) continue;
    problems.error(
        k.value->place,
        fmt::format("'{}' has {} values and '{}' has {}; lists that go together are equally long", k.key,
                    k.value->items.size(), lists.together.front().key, study::side_by_side(variation)));
    good = false;
  }
  if (good && study::count_runs(variation, kMostRuns) > kMostRuns) {
    problems.error(lists.place,
                   fmt::format("variation '{}' stands for more than {} runs", variation.name, kMostRuns));
    good = false;
  }
  std::map<std::string, Place> seen;
  for (const auto* list : {&lists.together, &lists.vary})
    for (const KeyedValue& k : *list)
      if (!seen.emplace(k.key, k.place).second) {
        problems.error(k.place, fmt::format("'{}' is varied twice", k.key));
        good = false;
      }
  return good;
}

/// The user's overrides that a variation's own values hide.
void note_hidden(const std::vector<Value>& user, const Lists& lists, Problems& problems) {
  const std::function<const Entry*(const Value&, const Value&)> common = [&](const Value& a, const Value& b) {
    for (const Entry& e : a.entries)
      if (const Entry* other = b.find(e.key)) {
        if (!is_dotted(e) || !is_dotted(*other)) return &e;
        if (const Entry* deeper = common(e.value, other->value)) return deeper;
      }
    return static_cast<const Entry*>(nullptr);
  };
  for (const auto* list : {&lists.together, &lists.vary})
    for (const KeyedValue& k : *list) {
      Problems ignored("", "");
      const Value change = tree_of(k.key, k.place, *k.value, ignored);
      for (const Value& override : user)
        if (const Entry* e = common(override, change))
          problems.note(e->place,
                        fmt::format("the study varies '{}', so this has no effect where it does", k.key));
    }
}

}  // namespace

std::vector<KeyedValue> keyed_values(const Value& table) {
  std::vector<KeyedValue> out;
  collect(table, "", out);
  return out;
}

void check_study(const Value& tree, const Value& base, const std::vector<Value>& user,
                 const simulation::StudySetup& study, Problems& problems,
                 const std::function<void(const Value& run)>& check_run) {
  const Entry* table = tree.find("study");
  const Entry* list = table == nullptr ? nullptr : table->value.find("variation");
  if (list == nullptr || list->value.items.size() != study.variations.size()) return;  // already reported

  std::vector<Lists> lists;
  bool good = true;
  for (std::size_t v = 0; v < study.variations.size(); ++v) {
    const Value& item = list->value.items[v];
    const simulation::VariationSetup& variation = study.variations[v];
    lists.push_back({item.place, list_of(item, "set"), list_of(item, "together"), list_of(item, "vary")});
    if (const Entry* name = item.find("name"); name != nullptr && !good_name(variation.name))
      problems.error(name->value.place,
                     fmt::format("'{}' cannot be the name of a folder of runs: letters, digits, _ and - are "
                                 "allowed",
                                 variation.name));
    for (std::size_t other = 0; other < v; ++other)
      if (study.variations[other].name == variation.name && !variation.name.empty())
        problems.error(item.place, fmt::format("there are two variations of the name '{}'", variation.name));
    // A list that could not be read is reported already.
    good = good && lists[v].set.size() == variation.set.size() &&
           lists[v].together.size() == variation.together.size() &&
           lists[v].vary.size() == variation.vary.size() && check_lists(variation, lists[v], problems);
    if (good) note_hidden(user, lists[v], problems);
  }
  if (!good) return;

  for (const study::PlannedRun& run : study::plan(study)) {
    Value changed = base;
    std::erase_if(changed.entries, [](const Entry& e) { return e.key == "study"; });
    const Lists& of = lists[run.variation];
    const auto lay = [&](const KeyedValue& k, const Value& value) {
      lay_over(changed, tree_of(k.key, k.place, value, problems), problems);
    };
    for (const KeyedValue& k : of.set) lay(k, *k.value);
    for (const Value& override : user) {
      Value plain = override;
      std::erase_if(plain.entries, [](const Entry& e) { return e.key == "study"; });
      lay_over(changed, plain, problems);
    }
    for (const KeyedValue& k : of.together) lay(k, k.value->items[run.together]);
    for (std::size_t k = 0; k < of.vary.size(); ++k) lay(of.vary[k], of.vary[k].value->items[run.vary[k]]);
    check_run(changed);
  }
}

}  // namespace abradem::io
