// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/text.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <limits>

namespace abradem::report {
namespace {

TEST(EscapeHtml, MarkupOfTheCaseIsText) {
  EXPECT_EQ(escape_html("<script>alert('1 & \"2\"')</script>"),
            "&lt;script&gt;alert(&#39;1 &amp; &quot;2&quot;&#39;)&lt;/script&gt;");
}

TEST(EscapeHtml, KeepsLettersOfAllLanguagesAndReplacesControls) {
  EXPECT_EQ(escape_html("α µm\n"), "α µm\n");
  EXPECT_EQ(escape_html(std::string("a\0b\x1b", 4)), "a\uFFFDb\uFFFD");
}

TEST(JsonString, CannotEndAScriptElement) {
  EXPECT_EQ(json_string("</script>\"\\\n"), "\"\\u003c/script>\\\"\\\\\\u000a\"");
}

TEST(JsonNumber, HasNoNaN) {
  EXPECT_EQ(json_number(0.25), "0.25");
  EXPECT_EQ(json_number(std::numeric_limits<double>::quiet_NaN()), "null");
  EXPECT_EQ(json_number(std::numeric_limits<double>::infinity()), "null");
}

TEST(Readable, StatesTheDigitsAskedFor) {
  EXPECT_EQ(readable(1.0, 4), "1.000");
  EXPECT_EQ(readable(0.0532149, 3), "0.0532");
  EXPECT_EQ(readable(142857.4, 4), "142857");
  EXPECT_EQ(readable(-8.1234, 3), "-8.12");
  EXPECT_EQ(readable(3.14e-13, 2), "3.1 × 10⁻¹³");
  EXPECT_EQ(readable(2.5e9, 2), "2.5 × 10⁹");
  EXPECT_EQ(readable(0.0), "0");
  EXPECT_EQ(readable(std::numeric_limits<double>::quiet_NaN()), "–");
}

TEST(ReadableCount, GroupsThousands) {
  EXPECT_EQ(readable_count(999), "999");
  EXPECT_EQ(readable_count(1714284), "1\u202F714\u202F284");
  EXPECT_EQ(readable_count(-123456), "-123\u202F456");
}

TEST(Base64, MatchesTheVectorsOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(Deflate, InflatesToTheSameBytes) {
  const std::string text(100000, 'w');
  const std::string packed = deflate(text);
  EXPECT_LT(packed.size(), 1000u);
  std::string back(text.size(), '\0');
  uLongf size = back.size();
  ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(back.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  EXPECT_EQ(back, text);
}

TEST(Typeset, SetsWholeWordsAlone) {
  EXPECT_EQ(typeset("alpha n = 8e-10 1/Pa (0.565 -+ 0.1 mm^3), volume 10 um; R2."),
            "α n = 8e-10 1/Pa (0.565 ± 0.1 mm³), volume 10 µm; R².");
  EXPECT_EQ(typeset(""), "");
  EXPECT_EQ(typeset("alphabet, maximum. "), "alphabet, maximum. ");
}

}  // namespace
}  // namespace abradem::report
