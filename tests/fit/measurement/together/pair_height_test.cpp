#include "fit/measurement/together/pair_height.h"

#include <gtest/gtest.h>

#include <optional>

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

}  // namespace
}  // namespace vegard::fit::pair_height_test
