#include "sim/emit/aurora/motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/constants.h"

namespace vegard::sim::change_times_test {
namespace {

TEST(ChangeTimes, OfAFrozenSheetAreInfinite) {
  Sheet sheet;
  sheet.ray_contrast = 1.0;
  sheet.fold_spacing_km = 20.0;
  sheet.curl_spacing_km = 5.0;
  sheet.border_amplitude_km = 2.0;
  EXPECT_TRUE(std::isinf(soonest_change_s(sheet, {})));
  Substorm substorm;
  substorm.quiet = 0.1;
  EXPECT_EQ(soonest_change_s(sheet, substorm), substorm.expansion_s);
}

TEST(ChangeTimes, AreALifetimeOrTheTimeToGoOnByTheOwnWidth) {
  Sheet sheet;  // from west to east
  sheet.ray_contrast = 1.0;
  sheet.ray_width_km = 0.5;
  sheet.ray_lifetime_s = 3.0;
  EXPECT_DOUBLE_EQ(change_times(sheet).rays, 3.0);
  sheet.ray_speed_km_s = -2.0;
  EXPECT_DOUBLE_EQ(change_times(sheet).rays, 0.25);
  sheet.drift_km_s = {2.0, 0.0};
  EXPECT_NEAR(change_times(sheet).rays, 3.0, 1e-9) << "at rest above the ground";
  sheet.drift_km_s = {0.0, -0.5};
  EXPECT_NEAR(change_times(sheet).course, sheet.width_km / 0.5, 1e-9);
  sheet.ray_contrast = 0.0;
  EXPECT_TRUE(std::isinf(change_times(sheet).rays)) << "there are none";
}

TEST(ChangeTimes, OfATravellingSineGoByHowFastItMovesAside) {
  Sheet sheet;
  sheet.sine_speed_km_s = 3.0;
  const double aside_km_s = kTwoPi * sheet.thickness_km / sheet.wavelength_km * 3.0;
  EXPECT_NEAR(change_times(sheet).course, sheet.width_km / aside_km_s, 1e-9);
}

TEST(ChangeTimes, OverALongStretchWhatComesAndGoesIsItsMean) {
  Sheet sheet;
  sheet.ray_contrast = sheet.ray_length_contrast = 0.5;
  sheet.ray_lifetime_s = 0.5;
  sheet.fold_spacing_km = 20.0;
  sheet.fold_lifetime_s = 30.0;
  const SheetOverTime shortly = sheet_over(sheet, 1.0);
  EXPECT_EQ(shortly.sheet.ray_contrast, 0.5);
  EXPECT_FALSE(shortly.draws_ray_length);
  const SheetOverTime longer = sheet_over(sheet, 10.0);
  EXPECT_EQ(longer.sheet.ray_contrast, 0.0);
  EXPECT_TRUE(longer.draws_ray_length);
  EXPECT_EQ(longer.sheet.fold_spacing_km, 20.0);
  EXPECT_EQ(sheet_over(sheet, 200.0).sheet.fold_spacing_km, 0.0);
}

}  // namespace
}  // namespace vegard::sim::change_times_test
