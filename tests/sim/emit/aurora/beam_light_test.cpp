// Means are taken over 20000 ray widths: see gaussian_process_test. The light of contrast c has the variance
// exp(c²) - 1. Seed 7.
#include "sim/emit/aurora/beam_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>

namespace vegard::sim::beam_light_test {
namespace {

constexpr double kContrast = 0.6;

Sheet rayed_sheet() {
  Sheet sheet;
  sheet.ray_contrast = kContrast;
  sheet.ray_width_km = 0.8;
  return sheet;
}

double mean_along(const std::function<double(double)>& f) {
  constexpr int n = 60000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) sum += f((i - 0.5 * n) * 0.8 / 3.0);
  return sum / n;
}

TEST(ArcLight, WithoutStructuresIsEven) {
  const Sheet sheet;
  ArcLight light(sheet, 0, 7, 5.0, 3.0);
  EXPECT_FALSE(light.any());
  EXPECT_FALSE(light.reads_elsewhere());
}

TEST(ArcLight, OfRaysHasTheMeanOneAndALogNormalsVarianceAndAutocorrelation) {
  const Sheet sheet = rayed_sheet();
  ArcLight light(sheet, 0, 7, 0.0, 0.0);
  light.remember(-8500.0, 8500.0);
  const auto at = [&](double x) { return light.at(x, 0.0).factor; };
  const double variance = std::exp(kContrast * kContrast) - 1.0;  // 0.433
  // Standard errors: 0.66/sqrt(20000) = 0.005 of the mean; of the variance, whose fourth moment is large,
  // 0.013.
  EXPECT_NEAR(mean_along(at), 1.0, 0.02);
  EXPECT_NEAR(mean_along([&](double x) { return std::pow(at(x) - 1.0, 2); }), variance, 0.05);
  EXPECT_NEAR(mean_along([&](double x) { return (at(x) - 1.0) * (at(x + 0.8) - 1.0); }),
              std::exp(kContrast * kContrast / 16.0) - 1.0, 0.03);
  EXPECT_FALSE(light.reads_elsewhere());
}

/// Of sixteen arcs the standard error of the mean is 0.005 / 4.
TEST(ArcLight, RaysTakeNoLightAwayAndAddNone) {
  const Sheet sheet = rayed_sheet();
  double mean = 0.0;
  for (std::uint32_t arc = 0; arc < 16; ++arc) {
    ArcLight light(sheet, arc, 7, 0.0, 0.0);
    light.remember(-8500.0, 8500.0);
    mean += mean_along([&](double x) { return light.at(x, 0.0).factor; }) / 16.0;
  }
  EXPECT_NEAR(mean, 1.0, 0.005);
}

TEST(ArcLight, RaysStandThroughTheSheetAndTravel) {
  Sheet sheet = rayed_sheet();
  sheet.ray_speed_km_s = 4.0;
  sheet.ray_length_contrast = 0.4;
  ArcLight before(sheet, 0, 7, 0.0, 0.0), after(sheet, 0, 7, 2.5, 1.5);
  for (double x = 0.0; x < 20.0; x += 0.3) {
    const BeamLight old_light = before.at(x, 0.0), new_light = after.at(x + 11.5, 9.0);
    EXPECT_NEAR(new_light.factor, old_light.factor, 1e-9);
    EXPECT_NEAR(new_light.stretch_above, old_light.stretch_above, 1e-9);
  }
}

TEST(ArcLight, LengthsOfRaysHaveTheMeanOneAndDoNotGoByTheirLight) {
  Sheet sheet = rayed_sheet();
  sheet.ray_length_contrast = 0.5;
  ArcLight light(sheet, 0, 7, 0.0, 0.0);
  light.remember(-8500.0, 8500.0);
  EXPECT_TRUE(light.reads_elsewhere());
  EXPECT_NEAR(mean_along([&](double x) { return light.at(x, 0.0).stretch_above; }), 1.0, 0.02);
  EXPECT_NEAR(mean_along([&](double x) {
                const BeamLight here = light.at(x, 0.0);
                return (here.factor - 1.0) * (here.stretch_above - 1.0);
              }),
              0.0, 0.02);
}

TEST(ArcLight, PatchesVaryAlongAndAcross) {
  Sheet sheet;
  sheet.patch_size_km = 10.0;
  sheet.patch_contrast = 0.5;
  ArcLight light(sheet, 0, 7, 0.0, 0.0);
  double sum = 0.0, along = 0.0, across = 0.0;
  constexpr int n = 80;  // 6400 patches: a standard error of 0.007 of the mean
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double here = light.at(i * 10.0, j * 10.0).factor;
      sum += here / (n * n);
      along += std::pow(light.at(i * 10.0 + 20.0, j * 10.0).factor - here, 2) / (n * n);
      across += std::pow(light.at(i * 10.0, j * 10.0 + 20.0).factor - here, 2) / (n * n);
    }
  EXPECT_NEAR(sum, 1.0, 0.03);
  // Two patches apart they are strangers: twice the variance, 2 (exp(c²) - 1).
  EXPECT_NEAR(along, 2.0 * (std::exp(0.25) - 1.0), 0.08);
  EXPECT_NEAR(across, 2.0 * (std::exp(0.25) - 1.0), 0.08);
}

TEST(ArcLight, BorderOfNoAmplitudeIsEvenElseNeighboursGoTogether) {
  Sheet sheet;
  sheet.border_amplitude_km = 5.0;
  sheet.border_scale_km = 20.0;
  ArcLight light(sheet, 0, 7, 0.0, 0.0);
  double square = 0.0, near = 0.0, far = 0.0;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) {
    const double x = i * 27.3 + 1.0, here = light.at(x, 2.0).altitude_shift_km;
    EXPECT_LT(std::abs(here), 5.0 * 1.75 * 1.04);
    square += here * here / n;
    near += here * light.at(x + 0.5, 2.0).altitude_shift_km / n;
    far += here * light.at(x + 60.0, 2.0).altitude_shift_km / n;
  }
  EXPECT_GT(std::sqrt(square), 0.5);
  EXPECT_GT(near / square, 0.95);
  EXPECT_NEAR(far / square, 0.0, 0.09);  // 5 standard errors of 4000 pairs that are a wave apart
  // Literally it is where beams start that undulates, and their light is read where it is.
  Sheet literal = sheet;
  literal.border_rule = BorderRule::start;
  ArcLight started(literal, 0, 7, 0.0, 0.0);
  EXPECT_TRUE(light.reads_elsewhere());
  EXPECT_FALSE(started.reads_elsewhere());
  EXPECT_EQ(started.at(30.0, 2.0).start_shift_km, light.at(30.0, 2.0).altitude_shift_km);
  EXPECT_EQ(started.at(30.0, 2.0).altitude_shift_km, 0.0);
  sheet.border_amplitude_km = 0.0;
  ArcLight even(sheet, 0, 7, 0.0, 0.0);
  EXPECT_FALSE(even.any());
  EXPECT_EQ(even.at(3.0, 2.0).altitude_shift_km, 0.0);
}

TEST(ArcLight, ChangesWithoutJumps) {
  Sheet sheet = rayed_sheet();
  sheet.ray_lifetime_s = 0.5;
  sheet.ray_length_contrast = 0.4;
  sheet.patch_size_km = 10.0;
  sheet.patch_lifetime_s = 1.0;
  sheet.border_amplitude_km = 5.0;
  sheet.border_lifetime_s = 1.0;
  const auto at = [&](double t) { return ArcLight(sheet, 0, 7, t, 0.0).at(12.3, 1.0); };
  double changed = 0.0;
  for (double t = 0.0; t < 2.0; t += 1e-3) {
    // Slopes are normal, of 3 a second for the logarithm of the light and 10 km a second for the border.
    const BeamLight now = at(t), next = at(t + 1e-3);
    EXPECT_NEAR(next.factor / now.factor, 1.0, 0.015);
    EXPECT_NEAR(next.stretch_above / now.stretch_above, 1.0, 0.015);
    EXPECT_NEAR(next.altitude_shift_km, now.altitude_shift_km, 0.05);
    changed = std::max(changed, std::abs(now.factor / at(0.0).factor - 1.0));
  }
  EXPECT_GT(changed, 0.3);
}

}  // namespace
}  // namespace vegard::sim::beam_light_test
