#include "sim/light/form_profile.h"
#include "tests/support/glow.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::form_profile_test {
namespace {

const std::vector<double> kTriad = {630.0, 557.7, 427.8};

double total(const HeightProfile& p, int a) {
  double sum = 0.0;
  for (int l = 0; l < p.lines; ++l) sum += p.rate[a * p.stride + l];
  return sum;
}

double all_light(const HeightProfile& p) {
  double sum = 0.0;
  for (int l = 0; l < p.lines; ++l) sum += column_below(p, l, HeightProfile::kTopKm).rayleigh;
  return sum;
}

TEST(FormIntensity, FallsToATenthWhereItSaysAndToAHundredthAKilometreOrTwoBelow) {
  // Source paper, section 3.4: "falls to 10% within a few kilometers below the maximum, and to 1% a kilometer
  // or two below that". sqrt(2) - 1 of 2.4 to 4.8 km is 1 to 2 km.
  for (double lower_km : {2.4, 4.0, 4.8}) {
    const FormCurve curve{112.0, lower_km, 25.0};
    EXPECT_DOUBLE_EQ(form_intensity(curve, 112.0), 1.0);
    EXPECT_NEAR(form_intensity(curve, 112.0 - lower_km), 0.1, 1e-12);
    EXPECT_NEAR(form_intensity(curve, 112.0 + 25.0), 0.1, 1e-12);
    EXPECT_GT(form_intensity(curve, 112.0 - lower_km - 0.99), 0.01);
    EXPECT_LT(form_intensity(curve, 112.0 - lower_km - 2.0), 0.01);
  }
}

TEST(FormIntensity, IsLevelAtThePeak) {
  const FormCurve curve{};
  for (double side : {-1.0, 1.0}) EXPECT_NEAR(form_intensity(curve, curve.peak_km + side * 0.001), 1.0, 2e-6);
}

TEST(FormProfile, HasTheCurveAsItsTotalAndTheTablesRatiosAndLight) {
  // Floats of up to three lines: 2e-7 each.
  for (double energy : {0.5, 3.0, 12.0}) {
    for (const FormCurve& curve : {FormCurve{110.0, 4.0, 20.0}, FormCurve{180.0, 30.0, 250.0}}) {
      const HeightProfile form = form_profile(tests::glow(), kTriad, energy, curve);
      const HeightProfile tables = maxwellian_profile(tests::glow(), kTriad, energy);
      const int peak = static_cast<int>((curve.peak_km - HeightProfile::kBottomKm) / HeightProfile::kStepKm);
      for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
        const double wanted = form_intensity(curve, HeightProfile::altitude_km(a));
        EXPECT_NEAR(total(form, a) / total(form, peak), wanted, 1e-6 * wanted + 1e-30);
        for (int l = 0; l < 3; ++l)
          EXPECT_NEAR(form.rate[a * 4 + l] * total(tables, a), tables.rate[a * 4 + l] * total(form, a),
                      1e-6 * total(tables, a) * total(form, a));
      }
      EXPECT_NEAR(all_light(form) / all_light(tables), 1.0, 1e-6);
    }
  }
}

TEST(FormProfile, AnotherLineLeavesTheOthersAsTheyAre) {
  const FormCurve curve{};
  const HeightProfile three = form_profile(tests::glow(), kTriad, 3.0, curve);
  const HeightProfile five = form_profile(tests::glow(), {337.1, 630.0, 557.7, 427.8, 777.4}, 3.0, curve);
  const HeightProfile one = form_profile(tests::glow(), {557.7}, 3.0, curve);
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    for (int l = 0; l < 3; ++l) EXPECT_EQ(five.rate[a * 8 + 1 + l], three.rate[a * 4 + l]);
    EXPECT_EQ(one.rate[a * 4], three.rate[a * 4 + 1]);
  }
}

TEST(FormProfile, IsFiniteWhereTheTablesAreAtTheirFloor) {
  // 12 keV leaves nothing above some 250 km, 0.1 keV nothing below 110: there the form's light is all theirs.
  for (double energy : {0.1, 12.0, 20.0}) {
    for (double peak_km : {90.0, 350.0}) {
      const HeightProfile form = form_profile(tests::glow(), kTriad, energy, {peak_km, 5.0, 20.0});
      for (std::size_t i = 0; i < form.rate.size(); ++i) {
        ASSERT_TRUE(std::isfinite(form.rate[i])) << i;
        ASSERT_TRUE(std::isfinite(form.d_rate_d_ln_energy[i])) << i;
      }
      EXPECT_GT(all_light(form), 1.0);
    }
  }
}

TEST(FormProfile, DerivativeByTheEnergyIsThatOfTheRate) {
  // As for the Maxwellian profile: differences of floats over 1 % of E0. At 9 keV and 150 km the tables come
  // near their floor, and their third derivative is larger.
  const FormCurve curve{115.0, 5.0, 60.0};
  for (double energy : {0.7, 3.0, 9.0}) {
    constexpr double h = 0.01;
    const HeightProfile here = form_profile(tests::glow(), kTriad, energy, curve);
    const HeightProfile more = form_profile(tests::glow(), kTriad, energy * std::exp(h), curve);
    const HeightProfile less = form_profile(tests::glow(), kTriad, energy * std::exp(-h), curve);
    for (int l = 0; l < 3; ++l) {
      double peak = 0.0;
      for (int a = 0; a < HeightProfile::kAltitudes; ++a)
        peak = std::max<double>(peak, std::abs(here.d_rate_d_ln_energy[a * 4 + l]));
      for (int a = 0; a < HeightProfile::kAltitudes; a += 3)
        EXPECT_NEAR(here.d_rate_d_ln_energy[a * 4 + l],
                    (more.rate[a * 4 + l] - less.rate[a * 4 + l]) / (2 * h),
                    1e-3 * peak + 1.2e-7 / h * here.rate[a * 4 + l])
            << energy << " keV, line " << l << ", altitude " << HeightProfile::altitude_km(a);
    }
  }
}

TEST(ColumnBelow, IsTheIntegralUpToAnyAltitude) {
  HeightProfile ramp;
  ramp.lines = 1;
  ramp.rate.assign(4 * HeightProfile::kAltitudes, 0.0f);
  ramp.d_rate_d_ln_energy.assign(4 * HeightProfile::kAltitudes, 0.0f);
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) ramp.rate[4 * a] = static_cast<float>(a);
  // The rate is 4 (h - 80): 0.1 * 2 (h - 80)^2 rayleighs.
  for (double top_km : {80.0, 80.1, 101.37, 500.0, 640.0})
    EXPECT_NEAR(column_below(ramp, 0, top_km).rayleigh, 0.2 * std::pow(top_km - 80.0, 2), 1e-8) << top_km;
}

}  // namespace
}  // namespace vegard::sim::form_profile_test
