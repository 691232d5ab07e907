#include "sim/light/excited_atom.h"
#include "sim/base/number/distributions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "sim/base/number/random.h"
#include "sim/light/height_profile.h"
#include "sim/scene/lines/emission_lines.h"
#include "tests/support/source_folder.h"

namespace vegard::sim::excited_atom_test {
namespace {

const EmissionLine& line(double wavelength_nm) { return *find_emission_line(wavelength_nm); }

double lifetime_s(double wavelength_nm, double altitude_km) {
  return effective_lifetime_s(line(wavelength_nm), standard_air(altitude_km));
}

double sigma_km(double wavelength_nm, double altitude_km) {
  const Air air = standard_air(altitude_km);
  const EmissionLine& of = line(wavelength_nm);
  return 1e-3 *
         std::sqrt(displacement_variance(thermal_variance_m2_s2(of, air), collision_frequency_s(of, air),
                                         effective_lifetime_s(of, air)));
}

TEST(ExcitedAtom, OnlyThreeStatesAreSlow) {
  for (const EmissionLine& of : emission_lines())
    EXPECT_EQ(is_prompt(of), of.wavelength_nm != 520.0 && of.wavelength_nm != 557.7 &&
                                 of.wavelength_nm != 630.0 && of.wavelength_nm != 636.4)
        << of.wavelength_nm;
}

TEST(ExcitedAtom, LivesItsFullLifeAtTheTopAndHardlyAnyAtTheBottom) {
  EXPECT_NEAR(lifetime_s(630.0, 640.0), 1.0 / (6.48e-3 + 2.10e-3), 0.5);
  EXPECT_LT(lifetime_s(630.0, 100.0), 0.01) << "quenched by N2: 9.2e12 cm-3 times 3.5e-11 cm3/s";
  EXPECT_NEAR(lifetime_s(557.7, 300.0), 1.0 / (1.26 + 0.134), 0.001);
  EXPECT_NEAR(lifetime_s(557.7, 100.0), 0.65, 0.02) << "hardly quenched";
  EXPECT_LT(lifetime_s(520.0, 200.0), 3600.0) << "of the 26 hours little is left";
  for (double h = 80.0; h < 640.0; h += 1.0) ASSERT_LT(lifetime_s(630.0, h), lifetime_s(630.0, h + 1.0)) << h;
}

TEST(ExcitedAtom, IsQuenchedByWhatThereIs) {
  // 1/tau - 1/T against the coefficients at 300 K, gas by gas: 2.0e-11 exp(107.8/300) = 2.865e-11 and
  // 2.9e-11 exp(67.5/300) = 3.632e-11 for O(1D), 4.0e-12 exp(-865/300) = 2.238e-13 for O(1S),
  // 9.7e-12 exp(-185/300) = 5.236e-12 for N(2D).
  const auto rate = [](double nm, const Air& air) {
    const Air none{300.0, 0.0, 0.0, 0.0};
    return 1.0 / effective_lifetime_s(line(nm), air) - 1.0 / effective_lifetime_s(line(nm), none);
  };
  const Air n2{300.0, 1e12, 0.0, 0.0}, o2{300.0, 0.0, 1e12, 0.0}, o{300.0, 0.0, 0.0, 1e12};
  EXPECT_NEAR(rate(630.0, n2), 28.65, 0.01);
  EXPECT_NEAR(rate(630.0, o2), 36.32, 0.01);
  EXPECT_NEAR(rate(630.0, o), 8.0, 1e-9);
  EXPECT_NEAR(rate(557.7, n2), 0.0, 1e-12);
  EXPECT_NEAR(rate(557.7, o2), 0.2238, 1e-4);
  EXPECT_NEAR(rate(557.7, o), 0.02, 1e-9);
  EXPECT_NEAR(rate(520.0, o2), 5.236, 1e-3);
  EXPECT_NEAR(rate(520.0, o), 0.69, 1e-9);
  EXPECT_NEAR(rate(427.8, n2), 0.0, 1e-6);
}

TEST(Displacement, IsThermalFlightWithoutCollisionsAndDiffusionWithMany) {
  constexpr double kThermal = 5e5, kLifetime = 30.0;
  EXPECT_DOUBLE_EQ(displacement_variance(kThermal, 0.0, kLifetime), 2.0 * kThermal * kLifetime * kLifetime);
  constexpr double kOften = 1e6;
  EXPECT_NEAR(displacement_variance(kThermal, kOften, kLifetime) / (2.0 * kThermal / kOften * kLifetime), 1.0,
              1e-7);
  EXPECT_EQ(displacement_variance(kThermal, 3.0, 0.0), 0.0);
}

TEST(Displacement, IsThatOfTheLangevinProcess) {
  // Walks with an exponential lifetime, in steps of a tenth of 1/nu: the velocity's step is exact, the
  // trapezium rule on the place is off by (1/10)^2/12. The displacement's kurtosis is below 12 (without
  // collisions it is that of v t, 3 * 24 / 4 = 18), so over 60000 atoms the variance is uncertain by
  // sqrt(17/60000) = 1.7 % at most; four times that is allowed.
  constexpr std::uint64_t kSeed = 4711;
  constexpr std::uint32_t kAtoms = 60000;
  for (const double nu_tau : {0.1, 2.0}) {
    constexpr double kThermal = 1.0, kTau = 1.0;
    const double nu = nu_tau / kTau, step = 0.1 / std::max(nu, 1.0);
    double sum = 0.0;
    for (std::uint32_t atom = 0; atom < kAtoms; ++atom) {
      const Words first = random_words(kSeed, Stream::search, atom, 0);
      double left = -kTau * std::log(uniform(first[0])), x = 0.0;
      double v = std::sqrt(kThermal) * normal_quantile(uniform(first[1]));
      for (std::uint32_t i = 1; left > 0.0; ++i) {
        const double dt = std::min(step, left), keep = std::exp(-nu * dt);
        const double kick = normal_quantile(uniform(random_words(kSeed, Stream::search, atom, i)[0]));
        const double next = keep * v + std::sqrt(kThermal * (1.0 - keep * keep)) * kick;
        x += 0.5 * (v + next) * dt;
        v = next;
        left -= dt;
      }
      sum += x * x / kAtoms;
    }
    EXPECT_NEAR(sum / displacement_variance(kThermal, nu, kTau), 1.0, 0.07) << "nu tau = " << nu_tau;
  }
}

TEST(Displacement, IsKilometresHighUpAndMetresLowDown) {
  EXPECT_GT(sigma_km(630.0, 250.0), 3.0);
  EXPECT_LT(sigma_km(630.0, 250.0), 12.0);
  EXPECT_LT(sigma_km(630.0, 110.0), 0.02);
  EXPECT_GT(sigma_km(557.7, 110.0), 0.005);
  EXPECT_LT(sigma_km(557.7, 110.0), 0.05);
  // At the top nearly free: sqrt(2 kT/m) tau = sqrt(2 * 5.2e5) m/s * 116.6 s = 119 km.
  EXPECT_NEAR(sigma_km(630.0, 640.0), 119.0, 10.0);
  for (double h = 80.0; h < 640.0; h += 1.0) ASSERT_LT(sigma_km(630.0, h), sigma_km(630.0, h + 1.0)) << h;
}

TEST(Collisions, GiveTheDiffusionCoefficientTheyComeFrom) {
  // Of O in N2 at 273.15 K and 1e19 cm-3: 6.986e18 / 1e19 cm2/s (U.S. Standard Atmosphere 1976, table 6).
  const Air air{273.15, 1e19, 0.0, 0.0};
  const double d_cm2_s =
      1e4 * thermal_variance_m2_s2(line(630.0), air) / collision_frequency_s(line(630.0), air);
  EXPECT_NEAR(d_cm2_s, 0.6986, 1e-6);
  // Light partners leave more room: mu(O, O) = 8.00 and mu(O, N2) = 10.18.
  const Air oxygen{273.15, 0.0, 0.0, 1e19};
  EXPECT_NEAR(collision_frequency_s(line(630.0), air) / collision_frequency_s(line(630.0), oxygen),
              std::sqrt(10.18 / 8.00), 1e-6);
}

TEST(SpreadProfile, HoldsTheFormulaeAndAThirdOfTheWind) {
  const SpreadProfile calm = spread_profile(line(630.0), 0.0), windy = spread_profile(line(630.0), 300.0);
  for (const double h : {90.0, 150.0, 250.0, 400.0}) {
    const auto a = static_cast<std::size_t>((h - HeightProfile::kBottomKm) / HeightProfile::kStepKm);
    EXPECT_NEAR(calm.lifetime_s[a] / lifetime_s(630.0, h), 1.0, 1e-6);
    EXPECT_NEAR(std::sqrt(calm.variance_km2[a]) / sigma_km(630.0, h), 1.0, 1e-6);
    const double carried_km = 0.3 * lifetime_s(630.0, h);
    EXPECT_NEAR(windy.variance_km2[a] - calm.variance_km2[a], carried_km * carried_km / 3.0,
                1e-6 * windy.variance_km2[a]);
  }
}

TEST(SpreadProfile, IsWhatTheDocumentationPrints) {
  // The rows "| altitude | tau 630.0 | sigma 630.0 | tau 557.7 | sigma 557.7 |" of docs/physics.md, to 3 %.
  std::ifstream page(tests::source_folder() + "/docs/physics.md");
  ASSERT_TRUE(page);
  std::string text;
  while (std::getline(page, text) && text.rfind("| altitude, km |", 0) != 0) continue;
  std::getline(page, text);
  int rows = 0;
  for (; std::getline(page, text) && text.rfind('|', 0) == 0; ++rows) {
    for (char& c : text) c = c == '|' ? ' ' : c;
    std::istringstream cells(text);
    double h = 0.0, number[4] = {};
    ASSERT_TRUE(cells >> h >> number[0] >> number[1] >> number[2] >> number[3]) << text;
    EXPECT_NEAR(number[0] / lifetime_s(630.0, h), 1.0, 0.03) << text;
    EXPECT_NEAR(number[1] / sigma_km(630.0, h), 1.0, 0.03) << text;
    EXPECT_NEAR(number[2] / lifetime_s(557.7, h), 1.0, 0.03) << text;
    EXPECT_NEAR(number[3] / sigma_km(557.7, h), 1.0, 0.03) << text;
  }
  EXPECT_GE(rows, 6);
}

}  // namespace
}  // namespace vegard::sim::excited_atom_test
