// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

/// Case files of the tests, as text.
namespace abradem::test {

/// The text with the first place of `what` replaced, which must be in it.
inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

/// Head of a case of soft glass alone.
inline constexpr const char* kGlass = R"(schema = 1
[material.glass]
density = 2500
shear_modulus = "10 MPa"
poisson_ratio = 0.25
[contact."glass/glass"]
restitution = 0.5
static_friction = 0.5
)";

/// The transfer chute, from any folder, with these lines for the wear of its steel by ore.
inline std::string transfer_chute(const std::string& wear) {
  const std::string cases = ABRADEM_SOURCE_DIR "/cases/";
  std::ifstream file(cases + "transfer-chute.toml");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  text = replaced(text, "wear_coefficient = \"1e-7 1/Pa\"", wear);
  for (const char* mesh : {"meshes/chute-liner.stl", "meshes/chute-sides.stl"})
    text = replaced(text, mesh, cases + mesh);
  return text;
}

}  // namespace abradem::test
