#include "sim/light/ionosphere/recombination.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/light/transport/field_air.h"

namespace vegard::sim::recombination_test {
namespace {

constexpr double kPairs = 4e4, kCoefficient = 3e-7, kBefore = 2e5;

double end_at(double seconds) { return grown_density(kPairs, kCoefficient, kBefore, seconds).end.value; }

TEST(GrownDensity, SolvesItsEquation) {
  constexpr double kStep = 1e-3;
  for (const double seconds : {0.1, 3.0, 20.0}) {
    const double slope = (end_at(seconds + kStep) - end_at(seconds - kStep)) / (2.0 * kStep),
                 n = end_at(seconds);
    EXPECT_NEAR(slope, kPairs - kCoefficient * n * n, 1e-5 * kPairs) << seconds;
  }
}

TEST(GrownDensity, HasTheLimitsOfNoTimeOfAllTimeAndOfNoPairs) {
  EXPECT_NEAR(end_at(1e-9), kBefore, 1e-6 * kBefore);
  EXPECT_NEAR(end_at(1e5), std::sqrt(kPairs / kCoefficient), 1e-3);
  // Without pairs the density decays as N/(1 + alpha N t).
  const double decayed = grown_density(1e-6, kCoefficient, kBefore, 100.0).end.value;
  EXPECT_NEAR(decayed, kBefore / (1.0 + kCoefficient * kBefore * 100.0), 1.0);
}

// Simpson's rule; on both sides of the change of formula at tau = 1, which is at 9 s.
TEST(GrownDensity, MeanIsThatOfTheDensitiesOnTheWay) {
  for (const double seconds : {0.5, 8.9, 9.3, 60.0}) {
    constexpr int kParts = 2000;
    double sum = 0.0;
    for (int i = 0; i <= kParts; ++i)
      sum += (i == 0 || i == kParts ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * end_at(seconds * i / kParts + 1e-12);
    const double mean = grown_density(kPairs, kCoefficient, kBefore, seconds).mean.value;
    EXPECT_NEAR(mean, sum / (3.0 * kParts), 1e-7 * mean) << seconds;
  }
}

TEST(GrownDensity, SlopesAreThoseOfDifferences) {
  constexpr double kStep = 1e-5;
  for (const double seconds : {0.5, 7.0, 40.0}) {
    const GrownDensity at = grown_density(kPairs, kCoefficient, kBefore, seconds);
    const auto differs = [&](double q, double a, double n, double DensityWithSlopes::*slope) {
      const auto shifted = [&](double by) {
        return grown_density(kPairs * std::exp(by * q), kCoefficient * std::exp(by * a),
                             kBefore * std::exp(by * n), seconds);
      };
      const GrownDensity more = shifted(kStep), less = shifted(-kStep);
      EXPECT_NEAR(at.end.*slope, (more.end.value - less.end.value) / (2.0 * kStep), 1e-6 * at.end.value);
      EXPECT_NEAR(at.mean.*slope, (more.mean.value - less.mean.value) / (2.0 * kStep), 1e-6 * at.mean.value);
    };
    differs(1.0, 0.0, 0.0, &DensityWithSlopes::by_pairs);
    differs(0.0, 1.0, 0.0, &DensityWithSlopes::by_recombination);
    differs(0.0, 0.0, 1.0, &DensityWithSlopes::by_before);
  }
}

// What ion_balance() makes of the pairs that the coefficient asks for is the density again.
TEST(Recombination, IsThatOfTheBalance) {
  const IonospherePhysics physics;
  for (const double altitude : {90.0, 110.0, 150.0}) {
    const ReactingAir air = ionosphere_air(standard_air_table(), {altitude}, {}).places.front();
    const Recombination found = balance_recombination(air, physics, 2e5);
    const IonProduction made = ion_production(found.coefficient_cm3_s * 4e10, air, physics);
    EXPECT_NEAR(ion_balance(air, made, physics.reactions).electrons, 2e5, 1e-3);
    // More electrons, less O+, which recombines slowly: between those of one kind of ion and of O+ alone.
    EXPECT_GT(found.slope, -1.0);
    EXPECT_LT(found.slope, 1e-6);
  }
}

// Where NO+ and O2+ are all ions it is between theirs, 4.2e-7 and 1.95e-7 cm^3 s^-1 at 300 K with powers of
// -0.85 and -0.7 (Schunk and Nagy 2009, table 8.5), and near the law of Vickrey et al. for the E region.
TEST(Recombination, IsNearPublishedOnes) {
  const ReactingAir air = ionosphere_air(standard_air_table(), {110.0}, {}).places.front();
  const double found = balance_recombination(air, {}, 2e5).coefficient_cm3_s,
               warm = 300.0 / air.electron_temperature_k;
  EXPECT_GT(found, 1.9e-7 * std::pow(warm, 0.7));
  EXPECT_LT(found, 4.3e-7 * std::pow(warm, 0.85));
  EXPECT_NEAR(vickrey_recombination_cm3_s(0.0), 2.5e-6, 1e-12);
  EXPECT_NEAR(vickrey_recombination_cm3_s(110.0) / vickrey_recombination_cm3_s(161.2), std::exp(1.0), 1e-9);
  EXPECT_NEAR(std::log(vickrey_recombination_cm3_s(110.0) / found), 0.0, std::log(1.5));
}

}  // namespace
}  // namespace vegard::sim::recombination_test
