// Which numbers are followed, by the words that they are named by.
#include "fit/survey/survey_motion.h"

#include <gtest/gtest.h>

namespace vegard::fit::followed_quantity_test {
namespace {

SurveyQuantity named(const std::string& name, int item = 0) {
  SurveyQuantity quantity;
  quantity.name = name;
  quantity.item = item;
  return quantity;
}

TEST(FollowedQuantity, GoesByTheWorkAndTheName) {
  EXPECT_EQ(followed_kind(SurveyWork::fit, named("mean electron energy of the main sheet")),
            FollowedKind::energy);
  EXPECT_EQ(followed_kind(SurveyWork::fit, named("distance of the main sheet")), FollowedKind::distance);
  EXPECT_EQ(followed_kind(SurveyWork::border, named("distance if 105 km high", 1)), FollowedKind::distance);
  EXPECT_EQ(followed_kind(SurveyWork::map, named("energy flux", 1)), FollowedKind::flux);
  EXPECT_FALSE(followed_kind(SurveyWork::border, named("distance if 105 km high", 2)));  // a fainter trace
  EXPECT_FALSE(followed_kind(SurveyWork::border, named("distance if 95 km high", 1)));
  EXPECT_FALSE(followed_kind(SurveyWork::border, named("distance of the main sheet")));
  EXPECT_FALSE(followed_kind(SurveyWork::fit, named("sheet.main.energy_kev")));
}

TEST(FollowedQuantity, KnowsWhoseItIs) {
  EXPECT_EQ(owner_of_quantity("mean electron energy of the main sheet"), "main");
  EXPECT_EQ(owner_of_quantity("energy flux Q of the main sheet"), "main");
  EXPECT_EQ(owner_of_quantity("lower border of 557.7 nm (a tenth of the peak) of the far sheet"), "far");
  EXPECT_EQ(owner_of_quantity("energy flux"), "");
}

}  // namespace
}  // namespace vegard::fit::followed_quantity_test
