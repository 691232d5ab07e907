#include "fit/measurement/together/joint_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace vegard::fit::joint_map_test {
namespace {

/// A pair whose light along the field lines is clear, of a border at this height; meanwhile the light has
/// moved by so much.
PairOfPictures pair_of_height(std::size_t first, std::size_t second, double height_km,
                              double moved_km = 0.0) {
  PairOfPictures pair;
  pair.first = first;
  pair.second = second;
  pair.apart_s = 0.0;
  pair.borders.is_claimed = true;
  pair.profiles.border_km = height_km;
  pair.profiles.across_km = moved_km;
  pair.profiles.covariance_km2 = Eigen::Vector2d(4.0, 1.0).asDiagonal();
  pair.profiles.correlation = pair.profiles.alike = 0.9;
  pair.profiles.weight = 1.0;
  pair.clocks.border_km = height_km;
  pair.clocks.border_error_km = 2.0;
  return pair;
}

std::vector<Measurement> measured(std::size_t count) {
  std::vector<Measurement> alone(count);
  for (std::size_t i = 0; i < count; ++i) {
    alone[i].photo = std::string(1, static_cast<char>('a' + i)) + ".jpg";
    alone[i].main_border = MainBorder();
  }
  return alone;
}

JointMap plan(const std::vector<PairOfPictures>& pairs, const std::vector<Measurement>& alone) {
  return planned_map(pairs, alone, std::vector<std::string>(alone.size()));
}

TEST(JointMap, HasThePicturesThatMayBeTogether) {
  std::vector<PairOfPictures> pairs = {pair_of_height(0, 1, 105.0), pair_of_height(0, 2, 105.0),
                                       pair_of_height(1, 2, 106.0)};
  const std::vector<Measurement> alone = measured(3);
  EXPECT_EQ(plan(pairs, alone).pictures, (std::vector<std::size_t>{0, 1, 2}));
  pairs[0].refusal = "the pictures are 90 s apart";
  const JointMap two = plan(pairs, alone);
  EXPECT_EQ(two.pictures, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(two.pair, 1u);
  EXPECT_EQ(two.home, 0u);
  EXPECT_TRUE(two.missing.empty());
}

TEST(JointMap, HasTheMostPicturesThatMayBeTogether) {
  // Each of the last three may also be with one of the first three, which is with nobody else.
  std::vector<PairOfPictures> pairs;
  for (const auto& [first, second] :
       std::vector<std::pair<std::size_t, std::size_t>>{{0, 3}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}})
    pairs.push_back(pair_of_height(first, second, 105.0));
  EXPECT_EQ(plan(pairs, measured(6)).pictures, (std::vector<std::size_t>{3, 4, 5}));
  pairs.pop_back();  // of as many the earlier ones
  EXPECT_EQ(plan(pairs, measured(6)).pictures, (std::vector<std::size_t>{0, 3}));
}

TEST(JointMap, SaysWhyThereIsNone) {
  std::vector<PairOfPictures> pairs = {pair_of_height(0, 1, 105.0)};
  pairs[0].refusal = "both were taken at the same place";
  EXPECT_EQ(plan(pairs, measured(2)).missing, pairs[0].refusal);
  EXPECT_TRUE(plan(pairs, measured(2)).pictures.empty());
  pairs[0].refusal.clear();
  std::vector<Measurement> alone = measured(2);
  alone[1].main_border.reset();
  EXPECT_NE(plan(pairs, alone).missing.find("b.jpg"), std::string::npos);
}

TEST(JointMap, IsMadeWithoutAPictureThatCannotBePrepared) {
  const std::vector<PairOfPictures> pairs = {pair_of_height(0, 1, 105.0), pair_of_height(0, 2, 105.0),
                                             pair_of_height(1, 2, 105.0)};
  const JointMap two = planned_map(pairs, measured(3), {"its mask leaves nothing", "", ""});
  EXPECT_EQ(two.pictures, (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(two.pair, 2u);
  EXPECT_EQ(two.home, 1u);
  EXPECT_TRUE(two.missing.empty());
  const JointMap none = planned_map({pairs[0]}, measured(2), {"its mask leaves nothing", ""});
  EXPECT_TRUE(none.pictures.empty());
  EXPECT_NE(none.missing.find("its mask"), std::string::npos) << none.missing;
}

TEST(JointMap, IsNotMadeOfLightThatHasMoved) {
  EXPECT_TRUE(plan({pair_of_height(0, 1, 105.0, -2.9)}, measured(2)).missing.empty());
  EXPECT_NE(plan({pair_of_height(0, 1, 105.0, -3.1)}, measured(2)).missing.find("moved by 3.1"),
            std::string::npos);
}

TEST(JointMap, IsNotMadeOfPicturesWhoseHeightsContradictEachOther) {
  const std::vector<PairOfPictures> pairs = {pair_of_height(0, 1, 105.0), pair_of_height(0, 2, 130.0),
                                             pair_of_height(1, 2, 105.0)};
  const JointMap map = plan(pairs, measured(3));
  EXPECT_TRUE(map.pictures.empty());
  EXPECT_NE(map.missing.find("contradict"), std::string::npos);
}

TEST(JointMap, ContradictsTheGeometryBeyondTwoErrors) {
  JointMap map;
  const PairHeight height{100.0, 3.0, true, 20, {}, false};
  const BorderDistance distance{130.0, 3.0};
  EXPECT_TRUE(contradictions(map, height, distance).empty());
  map.curtain.emplace();
  map.curtain->is_along_border = true;
  map.curtain->lower_border_km = {109.9, 4.0};  // two errors of the difference are 10 km
  map.nearest_km = {141.5, 4.0};                // and 11.7 km, as the feet are not the border
  EXPECT_TRUE(contradictions(map, height, distance).empty());
  map.curtain->lower_border_km.value = 110.1;
  ASSERT_EQ(contradictions(map, height, distance).size(), 1u);
  EXPECT_NE(contradictions(map, height, distance)[0].quantity.find("height"), std::string::npos);
  map.nearest_km.value = 118.2;
  EXPECT_EQ(contradictions(map, height, distance).size(), 2u);
  // A map without error bars contradicts nothing.
  map.curtain->lower_border_km.error = map.nearest_km.error = std::nan("");
  EXPECT_TRUE(contradictions(map, height, distance).empty());
  map.curtain->lower_border_km.error = map.nearest_km.error = 4.0;
  // A distance that one of both does not have contradicts nothing.
  EXPECT_EQ(contradictions(map, height, {std::nan(""), std::nan("")}).size(), 1u);
}

TEST(JointMap, GivesTheNearestPartOfABorder) {
  MainCurtain curtain;
  curtain.is_along_border = true;
  curtain.distance_km = {150.0, 3.0};
  curtain.border_distance_km = {160.0, 5.0};  // of the border, at the curtain's azimuths
  MainBorder border;
  border.distance_km = 120.0;
  EXPECT_NEAR(nearest_by(curtain, border).value, 112.5, 1e-9);
  EXPECT_NEAR(nearest_by(curtain, border).error, 2.25, 1e-9);
  curtain.is_along_border = false;
  EXPECT_TRUE(std::isnan(nearest_by(curtain, border).value));
}

}  // namespace
}  // namespace vegard::fit::joint_map_test
