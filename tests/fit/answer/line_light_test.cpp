#include "sim/light/line_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/answer/derived.h"
#include "sim/light/sheet_profile.h"
#include "tests/support/free_paths.h"
#include "tests/support/kind_named.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::line_light_test {
namespace {

constexpr double kGreenNm = 557.7, kRedNm = 630.0, kBlueNm = 427.8;

sim::Scene scene_of(const std::string& profile, double energy_kev) {
  sim::Sheet sheet;
  sheet.profile = tests::kind_named<sim::ProfileKind>(profile);
  sheet.energy_kev = energy_kev;
  return tests::with_sheet(sheet);
}

double rate_at(const sim::HeightProfile& profile, double altitude_km) {
  const double row = (altitude_km - sim::HeightProfile::kBottomKm) / sim::HeightProfile::kStepKm;
  const auto below = static_cast<std::size_t>(row);
  const double share = row - static_cast<double>(below);
  return (1.0 - share) * profile.rate[below * profile.stride] +
         share * profile.rate[(below + 1) * profile.stride];
}

TEST(LineLight, BorderAndHalfWidthsLieWhereTheProfileHasFallen) {
  for (const char* profile : {"maxwellian", "mono", "gaussian"}) {
    SCOPED_TRACE(profile);
    const sim::Scene scene = scene_of(profile, 5.0);
    const sim::LineLight light = sim::line_light(kBlueNm, scene, 0);
    const sim::HeightProfile rates = sim::sheet_profile({kBlueNm}, scene, 0);
    double most = 0.0;
    for (int i = 0; i < sim::HeightProfile::kAltitudes; ++i)
      most = std::max(most, static_cast<double>(rates.rate[static_cast<std::size_t>(i) * rates.stride]));
    EXPECT_FALSE(light.peak_at_an_end);
    EXPECT_NEAR(rate_at(rates, light.peak_km), most, 1e-3 * most);
    EXPECT_NEAR(rate_at(rates, light.lower_border_km), 0.1 * most, 1e-5 * most);
    EXPECT_NEAR(rate_at(rates, light.peak_km - light.half_below_km), 0.5 * most, 1e-5 * most);
    EXPECT_NEAR(rate_at(rates, light.peak_km + light.half_above_km), 0.5 * most, 1e-5 * most);
    EXPECT_LT(light.lower_border_km, light.peak_km - light.half_below_km);
  }
}

TEST(LineLight, AMonoEnergeticBeamsBorderIsSharperAndSinksWithEnergy) {
  // Electrons of one energy stop within a few kilometres; a Maxwellian's tail of fast ones goes deeper.
  const sim::LineLight mono = sim::line_light(kBlueNm, scene_of("mono", 6.0), 0),
                       maxwellian = sim::line_light(kBlueNm, scene_of("maxwellian", 3.0), 0);
  EXPECT_LT(mono.peak_km - mono.lower_border_km, maxwellian.peak_km - maxwellian.lower_border_km);
  EXPECT_LT(sim::line_light(kBlueNm, scene_of("mono", 12.0), 0).lower_border_km, mono.lower_border_km);
}

TEST(LineLight, WithoutATenthAboveTheBottomThereIsNoBorder) {
  sim::Scene scene = scene_of("form", 3.0);
  scene.sheets[0].peak_km = 84.0;
  scene.sheets[0].lower_km = 9.0;
  EXPECT_TRUE(std::isnan(sim::line_light(kGreenNm, scene, 0).lower_border_km));
  bool found = false;
  scene.fit.free = {tests::free_entry("sheet.main.energy_kev")};
  for (const DerivedNumber& d : derived_numbers(scene, free_numbers(scene), {3.0}, {{{0.04}}, {}})) {
    if (d.name.find("lower border") != 0) continue;
    found = true;
    EXPECT_TRUE(std::isnan(d.value));
    EXPECT_FALSE(d.sigma);
    EXPECT_NE(d.why_none.find("80 km"), std::string::npos);
  }
  EXPECT_TRUE(found);
}

TEST(LineLight, TheLineOfTheBorderIsGreenOrTheBrightestThereIs) {
  sim::Scene scene = scene_of("maxwellian", 3.0);
  scene.emission.lines = {kRedNm, kBlueNm};
  EXPECT_EQ(sim::border_line_nm(scene, 0), kGreenNm) << "tables have it though the scene does not show it";
  scene.sheets[0].profile = sim::ProfileKind::spline;
  scene.sheets[0].spline_rate.assign(2 * scene.sheets[0].spline_knots, 1.0);
  for (int k = 0; k < scene.sheets[0].spline_knots; ++k) scene.sheets[0].spline_rate[k] = 3.0;
  EXPECT_FALSE(sim::has_line(kGreenNm, scene, 0));
  EXPECT_EQ(sim::border_line_nm(scene, 0), kRedNm);
}

const DerivedNumber* find(const std::vector<DerivedNumber>& numbers, const std::string& name) {
  for (const DerivedNumber& d : numbers)
    if (d.name == name) return &d;
  return nullptr;
}

TEST(DerivedRatios, HaveTheErrorThatTheExactDerivativeGives) {
  // Columns carry exact derivatives by ln(E0): d(r/g)/d ln E0 = (r' - r/g g') / g. The fit's own is a
  // difference.
  sim::Scene scene = scene_of("maxwellian", 3.0);
  scene.fit.free = {tests::free_entry("sheet.main.energy_kev")};
  constexpr double kSigmaKev = 0.03;
  const auto numbers = derived_numbers(scene, free_numbers(scene), {3.0}, {{{kSigmaKev * kSigmaKev}}, {}});
  const double top_km = scene.sheets[0].top_km;
  const auto column = [&](double nm) {
    return sim::column_below(sim::sheet_profile({nm}, scene, 0), 0, top_km);
  };
  const sim::Column green = column(kGreenNm);
  for (const auto& [nm, name] : {std::pair{kRedNm, "I(630.0)/I(557.7) along the field of the main sheet"},
                                 std::pair{kBlueNm, "I(427.8)/I(557.7) along the field of the main sheet"}}) {
    const sim::Column line = column(nm);
    const DerivedNumber* d = find(numbers, name);
    ASSERT_TRUE(d != nullptr && d->sigma) << name;
    const double ratio = line.rayleigh / green.rayleigh;
    EXPECT_NEAR(d->value, ratio, 1e-9 * ratio);
    const double exact =
        std::abs(line.d_rayleigh_d_ln_energy - ratio * green.d_rayleigh_d_ln_energy) / green.rayleigh;
    EXPECT_NEAR(*d->sigma, exact * kSigmaKev / 3.0, 2e-3 * *d->sigma) << name;
  }
}

TEST(DerivedEnergies, MeanIsTwiceE0AndSoIsItsError) {
  sim::Scene scene = scene_of("maxwellian", 3.0);
  scene.fit.free = {tests::free_entry("sheet.main.energy_kev")};
  const auto numbers = derived_numbers(scene, free_numbers(scene), {3.0}, {{{0.04}}, {}});
  const DerivedNumber* e0 = find(numbers, "characteristic energy E0 of the main sheet");
  const DerivedNumber* mean = find(numbers, "mean electron energy of the main sheet");
  ASSERT_TRUE(e0 != nullptr && mean != nullptr && e0->sigma && mean->sigma);
  EXPECT_NEAR(mean->value, 2.0 * e0->value, 1e-12);
  EXPECT_NEAR(*mean->sigma, 2.0 * *e0->sigma, 1e-9);
  scene.sheets[0].profile = sim::ProfileKind::mono;
  EXPECT_EQ(find(derived_numbers(scene, free_numbers(scene), {3.0}, {{{0.04}}, {}}),
                 "characteristic energy E0 of the main sheet"),
            nullptr);
}

}  // namespace
}  // namespace vegard::fit::line_light_test
