#include "sim/scene/rows/complaint.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/expect_error.h"

namespace vegard::sim::complaint_test {
namespace {

TEST(EditDistance, CountsEditsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);  // Levenshtein's textbook pair
  EXPECT_EQ(edit_distance("widht", "width"), 1u);     // one swap, not two substitutions
  EXPECT_EQ(edit_distance("Width", "width"), 0u);
  EXPECT_EQ(edit_distance("abcdef", "azced"), edit_distance("azced", "abcdef"));
}

TEST(NearestName, PrefersFewestEditsThenTheFirst) {
  EXPECT_EQ(nearest_name("heigth", {"width", "height"}), "height");
  EXPECT_EQ(nearest_name("ac", {"ab", "ad"}), "ab");
  EXPECT_EQ(nearest_name("x", {}), "");
}

TEST(NearestName, TakesACutShortNameForItsWhole) {
  // By plain edits "layers" (3) would be nearer to "lat" than "latitude_deg" (9).
  EXPECT_EQ(nearest_name("lat", {"layers", "latitude_deg"}), "latitude_deg");
}

TEST(NearestHint, IsOnlyAsSureAsTheNamesAreNear) {
  EXPECT_EQ(nearest_hint("widht", {"width"}), "did you mean 'width'?");
  EXPECT_TRUE(tests::has_facts(nearest_hint("qqqqqqq", {"width"}), "'width'"));
  EXPECT_EQ(nearest_hint("qqqqqqq", {}), "");
}

// The work grows with the product of the lengths: a megabyte would take the better part of a minute.
TEST(NearestHint, IsGivenToNamesAPersonWouldWrite) {
  const std::string longest(kMaxHintedLetters, 'k'), megabyte(1 << 20, 'k');
  EXPECT_EQ(nearest_hint(longest, {longest.substr(1)}), "did you mean '" + longest.substr(1) + "'?");
  EXPECT_EQ(nearest_hint(longest + "k", {longest}), "");
  EXPECT_EQ(nearest_name(megabyte, {"width", "kk"}), "");
  EXPECT_FALSE(is_near(megabyte, megabyte + "k"));
  // Nor does a long one hide a near one.
  EXPECT_EQ(nearest_hint("widht", {megabyte, "width"}), "did you mean 'width'?");
}

}  // namespace
}  // namespace vegard::sim::complaint_test
