// profile_slope() against central differences of the profiles, for every number that it knows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/light/sheet_profile.h"
#include "sim/scene/rows/spline_rates.h"
#include "sim/scene/table/parameter_id.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::profile_slope_test {
namespace {

const std::vector<double> kLinesNm = {630.0, 557.7, 427.8};

TEST(ProfileSlope, OfAFormsCurveIsThatOfTheRate) {
  for (const double brightness : {0.0, 10.0}) {
    Sheet sheet;
    sheet.profile = ProfileKind::form;
    sheet.brightness_kilorayleigh = brightness;
    sheet.peak_km = 112.1;  // between two altitudes: the curve's bend is not at one
    sheet.lower_km = 9.0;
    Scene scene = tests::with_sheet(sheet);
    for (const ParameterRole role :
         {ParameterRole::form_peak, ParameterRole::form_lower, ParameterRole::form_upper}) {
      const ParameterId id = parameter_with(role, 0);
      const std::vector<float> slope = profile_slope(kLinesNm, scene, 0, id);
      const HeightProfile here = sheet_profile(kLinesNm, scene, 0);
      ASSERT_EQ(slope.size(), here.rate.size());
      constexpr double kStep = 0.01;
      const double value = *number_at(scene, id);
      *number_at(scene, id) = value + kStep;
      const HeightProfile more = sheet_profile(kLinesNm, scene, 0);
      *number_at(scene, id) = value - kStep;
      const HeightProfile less = sheet_profile(kLinesNm, scene, 0);
      *number_at(scene, id) = value;
      double largest = 0.0;
      for (const float s : slope) largest = std::max<double>(largest, std::abs(s));
      ASSERT_GT(largest, 0.0);
      for (std::size_t i = 0; i < slope.size(); ++i)
        EXPECT_NEAR(slope[i], (more.rate[i] - less.rate[i]) / (2.0 * kStep),
                    2e-4 * largest + 1.2e-7 / kStep * here.rate[i])
            << HeightProfile::altitude_km(static_cast<double>(i / here.stride)) << " km";
    }
  }
}

Scene spline_scene() {
  Sheet sheet;
  sheet.profile = ProfileKind::spline;
  Scene scene = tests::with_sheet(sheet);
  scene.emission.lines = kLinesNm;
  fill_spline_rates(scene);
  return scene;
}

TEST(ProfileSlope, OfACoefficientIsItsBasisInItsLine) {
  Scene scene = spline_scene();
  Sheet& sheet = scene.sheets[0];
  const int index = spline_rate_index(sheet, 1, 9);
  const std::vector<float> slope = profile_slope(
      kLinesNm, scene, 0,
      parameter_at(scene, "sheet.spline_rate." + spline_rate_component(scene, 0, index)).value());
  const HeightProfile before = sheet_profile(kLinesNm, scene, 0);
  sheet.spline_rate[index] += 64.0;
  const HeightProfile after = sheet_profile(kLinesNm, scene, 0);
  for (std::size_t i = 0; i < slope.size(); ++i)
    EXPECT_NEAR(after.rate[i] - before.rate[i], 64.0 * slope[i], 1e-5 * after.rate[i]);
  EXPECT_GT(*std::max_element(slope.begin(), slope.end()), 0.6f);
  for (const float d : before.d_rate_d_ln_energy) EXPECT_EQ(d, 0.0f) << "electrons have no part in it";
}

TEST(SplineProfile, HasTheColumnsOfItsCoefficients) {
  const Scene scene = spline_scene();
  const Sheet& sheet = scene.sheets[0];
  const AltitudeSpline spline = altitude_spline(sheet);
  const HeightProfile profile = sheet_profile(kLinesNm, scene, 0);
  for (int l = 0; l < 3; ++l) {
    double rayleigh = 0.0;
    for (int k = 0; k < spline.count(); ++k)
      rayleigh += 0.1 * spline.integral_km(k) * sheet.spline_rate[spline_rate_index(sheet, l, k)];
    // A straight line every quarter of a kilometre against curves 6 km wide.
    EXPECT_NEAR(column_below(profile, l, 640.0).rayleigh, rayleigh, 1e-3 * rayleigh);
  }
}

TEST(SplineProfile, OfALineThatTheSceneDoesNotHaveIsDark) {
  const HeightProfile profile = sheet_profile({777.4, 557.7}, spline_scene(), 0);
  EXPECT_EQ(column_below(profile, 0, 640.0).rayleigh, 0.0);
  EXPECT_GT(column_below(profile, 1, 640.0).rayleigh, 0.0);
}

TEST(ProfileSlope, OfAnythingElseIsNone) {
  Scene scene = spline_scene();
  EXPECT_TRUE(profile_slope(kLinesNm, scene, 0, parameter_with(ParameterRole::form_peak, 0)).empty());
  EXPECT_TRUE(profile_slope(kLinesNm, scene, 0, parameter_with(ParameterRole::centre, 0)).empty());
}

}  // namespace
}  // namespace vegard::sim::profile_slope_test
