// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/published.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "abradem/core/error.h"

namespace abradem::report {
namespace {

using Json = nlohmann::json;

std::string text_of(const Json& object, const char* key, const std::string& where, bool required) {
  const auto found = object.find(key);
  if (found == object.end()) {
    if (required) throw IoError(fmt::format("{}: key '{}' is missing", where, key));
    return {};
  }
  if (!found->is_string()) throw IoError(fmt::format("{}: '{}' is not a text", where, key));
  return found->get<std::string>();
}

double number_of(const Json& value, const std::string& where) {
  if (!value.is_number()) throw IoError(fmt::format("{}: '{}' is not a number", where, value.dump()));
  return value.get<double>();
}

void read_value(const Json& object, const std::string& where, PublishedClaim& claim) {
  const auto value = object.find("value");
  if (value == object.end()) throw IoError(fmt::format("{}: key 'value' is missing", where));
  if (value->is_string()) {
    claim.words = value->get<std::string>();
  } else if (value->is_object()) {
    for (const char* key : {"const", "lin", "quad", "R2"}) {
      if (!value->contains(key)) throw IoError(fmt::format("{}: a fit needs the key '{}'", where, key));
      claim.numbers.push_back(number_of((*value)[key], where));
    }
  } else if (value->is_array()) {
    for (const Json& item : *value) claim.numbers.push_back(number_of(item, where));
    if (claim.numbers.empty()) throw IoError(fmt::format("{}: 'value' is empty", where));
  } else {
    claim.numbers = {number_of(*value, where)};
  }
}

PublishedClaim claim_of(const Json& object, const std::string& file, std::size_t number) {
  std::string where = fmt::format("{}: claim {}", file, number);
  if (!object.is_object()) throw IoError(where + ": expected an object");
  PublishedClaim claim;
  claim.id = text_of(object, "id", where, true);
  where = fmt::format("{}: claim '{}'", file, claim.id);
  claim.quantity = text_of(object, "quantity", where, true);
  claim.rule = text_of(object, "rule", where, true);
  claim.kind = text_of(object, "kind", where, true);
  claim.conditions = text_of(object, "conditions", where, false);
  claim.unit = text_of(object, "unit", where, false);
  claim.where = text_of(object, "where", where, false);
  claim.shown = text_of(object, "shown", where, false);
  if (object.contains("tolerance")) claim.tolerance = number_of(object["tolerance"], where);
  read_value(object, where, claim);
  return claim;
}

}  // namespace

const PublishedClaim* PublishedValues::find(std::string_view id) const noexcept {
  const auto found = std::ranges::find(claims, id, &PublishedClaim::id);
  return found == claims.end() ? nullptr : &*found;
}

PublishedValues read_published(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw IoError(fmt::format("{}: no such file", file.string()));
  Json json;
  try {
    json = Json::parse(stream);
  } catch (const Json::parse_error& error) {
    throw IoError(fmt::format("{}: not JSON: {}", file.string(), error.what()));
  }
  if (!json.is_object() || !json.contains("claims") || !json["claims"].is_array())
    throw IoError(fmt::format("{}: expected an object with a list 'claims'", file.string()));
  PublishedValues values{text_of(json, "source", file.string(), true), {}};
  for (const Json& object : json["claims"]) {
    PublishedClaim claim = claim_of(object, file.string(), values.claims.size() + 1);
    if (values.find(claim.id) != nullptr)
      throw IoError(fmt::format("{}: two claims have the id '{}'", file.string(), claim.id));
    values.claims.push_back(std::move(claim));
  }
  return values;
}

}  // namespace abradem::report
