// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

namespace abradem::test {

/// Are all these parts in a message?
inline testing::AssertionResult says(const std::string& text, std::initializer_list<const char*> parts) {
  for (const char* part : parts)
    if (text.find(part) == std::string::npos)
      return testing::AssertionFailure() << "'" << part << "' is not in: " << text;
  return testing::AssertionSuccess();
}

/// Is this part in a text?
inline testing::AssertionResult contains(const std::string& text, const std::string& part) {
  return says(text, {part.c_str()});
}

}  // namespace abradem::test
