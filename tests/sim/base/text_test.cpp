#include "sim/base/text.h"

#include <gtest/gtest.h>

namespace vegard::sim::text_test {
namespace {

TEST(Text, TrimsBothEnds) {
  EXPECT_EQ(trimmed(" \t a b\r\n"), "a b");
  EXPECT_EQ(trimmed(" \t\r\n"), "");
  EXPECT_EQ(trimmed(""), "");
  EXPECT_EQ(trimmed("\ta ", " "), "\ta");
}

TEST(Text, LowersLettersAlone) {
  EXPECT_EQ(lowered("AZ[az]09\u00c4"), "az[az]09\u00c4");
  EXPECT_EQ(lowered_extension("a.b/Night.TIFF"), ".tiff");
  EXPECT_EQ(lowered_extension("a.b/night"), "");
}

TEST(Text, ComparesEnds) {
  EXPECT_TRUE(starts_with("camera.width", "camera."));
  EXPECT_FALSE(starts_with("cam", "camera."));
  EXPECT_TRUE(ends_with("a.csv", ".csv"));
  EXPECT_FALSE(ends_with("csv", ".csv"));
  EXPECT_TRUE(starts_with("", "") && ends_with("", ""));
}

TEST(Text, SplitsIntoOnePartMoreThanSeparators) {
  using Parts = std::vector<std::string_view>;
  EXPECT_EQ(split("a,b,,c", ','), (Parts{"a", "b", "", "c"}));
  EXPECT_EQ(split("a,", ','), (Parts{"a", ""}));
  EXPECT_EQ(split("", ','), (Parts{""}));
}

TEST(Text, JoinsLists) {
  EXPECT_EQ(joined({}), "");
  EXPECT_EQ(joined({"a"}, ", ", " and "), "a");
  EXPECT_EQ(joined({"a", "b"}, ", ", " and "), "a and b");
  EXPECT_EQ(joined({"a", "b", "c"}, ", ", " and "), "a, b and c");
  EXPECT_EQ(joined({"", "b"}, ","), ",b");
}

TEST(Text, DropsZerosOfDecimalsAlone) {
  EXPECT_EQ(without_trailing_zeros("62.416200"), "62.4162");
  EXPECT_EQ(without_trailing_zeros("1600.00"), "1600");
  EXPECT_EQ(without_trailing_zeros("1600"), "1600");
  EXPECT_EQ(without_trailing_zeros("-0.00"), "0");
}

}  // namespace
}  // namespace vegard::sim::text_test
