#include "fit/measurement/together/pair_height.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "sim/base/number/constants.h"

namespace vegard::fit::pair_height_test {
namespace {

/// A pair whose light along the field lines is clear, of a border and brightest light at these heights.
PairOfPictures clear_pair(double border_km, double peak_km) {
  PairOfPictures pair;
  pair.second = 1;
  pair.apart_s = 0.0;
  pair.borders.is_claimed = true;
  pair.profiles.border_km = border_km;
  pair.profiles.covariance_km2 = Eigen::Vector2d(4.0, 1.0).asDiagonal();
  pair.profiles.correlation = pair.profiles.alike = 0.9;
  pair.profiles.weight = 1.0;
  pair.profiles.profiles.peak_above_km = peak_km - border_km;
  pair.profiles.profiles.peak_above_error_km = 1.0;
  pair.clocks.border_km = border_km;
  pair.clocks.border_error_km = 2.0;
  return pair;
}

TEST(PairHeight, GivesNoPeakOfClippedLight) {
  PairOfPictures pair = clear_pair(103.0, 111.0);
  const std::optional<PairHeight> peak = peak_of(pair);
  ASSERT_TRUE(peak);
  EXPECT_DOUBLE_EQ(peak->km, 111.0);
  EXPECT_TRUE(peak->doubts.empty());
  pair.is_peak_cut = true;
  EXPECT_FALSE(peak_of(pair));
  EXPECT_FALSE(height_of(pair)->doubts.empty());
}

TEST(PairHeight, DoubtsThePeakAsTheBorder) {
  PairOfPictures pair = clear_pair(103.0, 111.0);
  pair.borders.is_claimed = false;
  EXPECT_EQ(peak_of(pair)->doubts, height_of(pair)->doubts);
  EXPECT_EQ(peak_of(pair)->doubts.size(), 1u);
}

TEST(PairHeight, ByAllPicturesLeavesOutDoubtedPairs) {
  std::vector<PairOfPictures> pairs = {clear_pair(103.0, 111.0), clear_pair(104.0, 112.0),
                                       clear_pair(102.0, 110.0)};
  ClockSolution clocks;
  clocks.border_km = 103.0;
  clocks.border_error_km = 1.5;
  const std::optional<PairHeight> border = common_border(pairs, clocks);
  ASSERT_TRUE(border);
  EXPECT_DOUBLE_EQ(border->km, 103.0);
  EXPECT_TRUE(border->doubts.empty());
  // One pair alone is not all of them: unknown times, traces that are not claimed, and clipped light.
  pairs[1].apart_s = sim::kNaN;
  EXPECT_TRUE(common_border(pairs, clocks));
  pairs[2].borders.is_claimed = false;
  EXPECT_FALSE(common_border(pairs, clocks));
  pairs[2].borders.is_claimed = true;
  pairs[2].is_peak_cut = true;
  EXPECT_FALSE(common_border(pairs, clocks));
  EXPECT_TRUE(has_sound_profiles(pairs[0]));
  for (const std::size_t doubted : {1, 2}) EXPECT_FALSE(has_sound_profiles(pairs[doubted]));
}

TEST(PairHeight, ByAllPicturesTellsOfItsWideError) {
  std::vector<PairOfPictures> pairs = {clear_pair(103.0, 111.0), clear_pair(104.0, 112.0)};
  for (PairOfPictures& pair : pairs) pair.clocks.border_error_km = 8.0;
  ClockSolution clocks;
  clocks.border_km = 103.0;
  clocks.border_error_km = 4.0;
  // Each pair is wide, both together are not.
  EXPECT_EQ(height_of(pairs[0])->doubts.size(), 1u);
  EXPECT_TRUE(common_border(pairs, clocks)->doubts.empty());
  clocks.border_error_km = 6.0;
  EXPECT_EQ(common_border(pairs, clocks)->doubts.size(), 1u);
  // Beyond three standard deviations of the difference.
  pairs[1].clocks.border_km = 140.0;
  EXPECT_FALSE(common_border(pairs, clocks));
}

TEST(PairHeight, IsWiderWhereExposuresDiffer) {
  PairOfPictures pair = clear_pair(103.0, 111.0);
  pair.profiles.border_km_per_km = 1.5;
  EXPECT_DOUBLE_EQ(moved_pair(pair).covariance_km2(0, 0), 4.0);
  TogetherRequest request;
  request.drift_km_s = 0.5;
  std::vector<Measurement> alone(2);
  alone[0].middle_after_s = 1.0;
  alone[1].middle_after_s = 5.0;
  pair.smeared_km = pair_of(request, alone, 0, 1).smeared_km;
  EXPECT_DOUBLE_EQ(pair.smeared_km, 0.5 * 4.0);
  EXPECT_DOUBLE_EQ(moved_pair(pair).covariance_km2(0, 0), 4.0 + 9.0);
  EXPECT_DOUBLE_EQ(moved_pair(pair).covariance_km2(1, 1), 1.0 + 4.0);
}

}  // namespace
}  // namespace vegard::fit::pair_height_test
