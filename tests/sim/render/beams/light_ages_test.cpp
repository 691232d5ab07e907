#include "sim/render/beams/light_ages.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/light/atmosphere.h"
#include "sim/light/excited_atom.h"
#include "sim/render/beams/kernel_scene.h"
#include "sim/scene/lines/emission_lines.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::light_ages_test {
namespace {

Scene drifting_scene() {
  Scene scene = tests::small_scene();
  scene.sheets[0].drift_km_s = {0.0, 0.5};
  return scene;
}

TEST(LightAges, AreOneForASteadySheetAndForPromptLight) {
  EXPECT_FALSE(LightAges(tests::small_scene()).any());
  Scene scene = drifting_scene();
  EXPECT_TRUE(LightAges(scene).any());
  scene.emission.lines = {427.8, 391.4};
  EXPECT_FALSE(LightAges(scene).any());
  scene = drifting_scene();
  scene.emission.lag = EmissionLag::none;
  EXPECT_FALSE(LightAges(scene).any());
  scene = drifting_scene();
  scene.film.weight = PointWeight::unit;
  EXPECT_FALSE(LightAges(scene).any());
}

TEST(LightAges, OnlySheetsThatChangeHaveThem) {
  Scene scene = drifting_scene();
  scene.sheets.push_back(tests::small_scene().sheets[0]);
  const LightAges ages(scene);
  EXPECT_TRUE(ages.lags(0));
  EXPECT_FALSE(ages.lags(1));
}

TEST(LightAges, ReachBackUntilNextToNothingIsLeftAndNoFartherThanTwoHours) {
  Scene scene = drifting_scene();
  const LightAges ages(scene);
  const int last = ages.count(0) - 1;
  EXPECT_LT(std::exp(-2.0 * ages.from_s(0, last) / 110.0), 0.002);
  EXPECT_TRUE(std::isinf(ages.to_s(0, last)));
  scene.emission.lines = {520.0};
  scene.blur.width_deg = {0.0};
  const LightAges of_nitrogen(scene);
  const int longest = of_nitrogen.count(0) - 1;
  EXPECT_GT(of_nitrogen.from_s(0, longest), 1000.0);
  EXPECT_LE(of_nitrogen.age_s(0, longest, 1.0), 7200.0);
}

TEST(LightAges, SharesAreThoseOfExponentialDecayAndAddUpToTheWhole) {
  const Scene scene = drifting_scene();
  const std::vector<HeightProfile> whole = height_profiles(scene);
  std::vector<HeightProfile> parts = whole;
  const LightAges ages(scene);
  ages.split(scene, parts);
  ASSERT_EQ(parts.size(), static_cast<std::size_t>(ages.count(0)));
  const EmissionLine& red = *find_emission_line(630.0);
  for (int a = 0; a < HeightProfile::kAltitudes; a += 100) {
    const double tau = effective_lifetime_s(red, standard_air(HeightProfile::altitude_km(a)));
    for (int l = 0; l < 3; ++l) {
      const std::size_t at = static_cast<std::size_t>(a) * whole[0].stride + l;
      double rate = 0.0, slope = 0.0;
      for (const HeightProfile& part : parts) {
        rate += part.rate[at];
        slope += part.d_rate_d_ln_energy[at];
      }
      // Each share and each product is rounded to a float once.
      EXPECT_NEAR(rate, whole[0].rate[at], 3e-7 * whole[0].rate[at]);
      EXPECT_NEAR(slope, whole[0].d_rate_d_ln_energy[at], 3e-7 * std::abs(whole[0].d_rate_d_ln_energy[at]));
    }
    for (int age = 0; age < ages.count(0); ++age) {
      const std::size_t at = static_cast<std::size_t>(a) * whole[0].stride;
      const double share = std::exp(-ages.from_s(0, age) / tau) - std::exp(-ages.to_s(0, age) / tau);
      EXPECT_NEAR(parts[ages.first_profile(scene, 0, age)].rate[at], whole[0].rate[at] * share,
                  2e-7 * whole[0].rate[at]);
      const std::size_t prompt = at + 2;
      EXPECT_EQ(parts[ages.first_profile(scene, 0, age)].rate[prompt],
                age == 0 ? whole[0].rate[prompt] : 0.0f);
    }
  }
}

}  // namespace
}  // namespace vegard::sim::light_ages_test
