#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <limits>

#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

TEST(Text, NumbersOfFilesAreShortExactToNineDigitsAndNeverNaN) {
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(-0.0), "0");
  EXPECT_EQ(number_text(120), "120");
  EXPECT_EQ(number_text(1.0 / 3), "0.333333333");
  EXPECT_EQ(number_text(-1234.5678912345), "-1234.56789");
  EXPECT_EQ(number_text(std::nan("")), "");
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity()), "");
  EXPECT_EQ(rounded_for_files(1.0 / 3), 0.333333333);
}

TEST(Text, NumbersDoNotFollowTheLocale) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8"}) std::setlocale(LC_NUMERIC, name);
  EXPECT_EQ(number_text(1.5), "1.5");
  EXPECT_EQ(display_text(1.25, 2), "1.25");
  std::setlocale(LC_NUMERIC, before.c_str());
}

TEST(Text, NumbersForPeopleHaveAMinusSignAndNoNegativeZero) {
  EXPECT_EQ(display_text(-18.42, 1), "−18.4");
  EXPECT_EQ(display_text(-0.04, 1), "0.0");
  EXPECT_EQ(display_text(7, 0), "7");
  EXPECT_EQ(display_text(std::nan(""), 1), "–");
}

TEST(Text, MarkupIsEscaped) {
  EXPECT_EQ(escape_markup("<script>\"a\" & 'b'</script>"),
            "&lt;script&gt;&quot;a&quot; &amp; &#39;b&#39;&lt;/script&gt;");
  EXPECT_EQ(escape_markup("Δ µJ −"), "Δ µJ −");
  EXPECT_EQ(escape_markup(std::string("a\0b\x1b", 4)), "a b ");
  EXPECT_EQ(escape_markup("broken \xc3 utf \xff"), "broken \uFFFD utf \uFFFD");
  EXPECT_EQ(escape_markup("\xc0\xbc"), "\uFFFD\uFFFD");  // an overlong '<'
}

}  // namespace
}  // namespace cardiac
