#include "sim/emit/sun/corona_emitter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::thomson_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// By van de Hulst's functions, as the literature has them.
double by_van_de_hulst(double sine, double square_sine_chi, double u) {
  const double s2 = sine * sine, c = std::sqrt(1.0 - s2);
  const double depth = c * c / sine * std::log((1.0 + sine) / c);
  const double a = c * s2, b = -0.125 * (1.0 - 3.0 * s2 - depth * (1.0 + 3.0 * s2));
  const double cc = 4.0 / 3.0 - c - c * c * c / 3.0, d = 0.125 * (5.0 + s2 - depth * (5.0 - s2));
  return 2.0 * kPi * ((1.0 - u) * cc + u * d) - square_sine_chi * kPi * ((1.0 - u) * a + u * b);
}

TEST(ScatteredLight, IsThatOfVanDeHulst) {
  for (const double sine : {0.2, 0.5, 0.8, 0.95, 0.999})
    for (const double chi : {0.0, 0.4, 1.0})
      for (const double u : {0.0, 0.6, 1.0})
        EXPECT_NEAR(scattered_light(sine * sine, chi, u, 0.0), by_van_de_hulst(sine, chi, u), 1e-12);
}

TEST(ScatteredLight, OfAnyLawIsTheSumOverTheDisc) {
  // (1 + cos²(angle)) over the disc, by the midpoint rule: 300 by 120 pieces.
  constexpr double kU = 0.4, kV = 0.3, kSine = 0.7;
  for (const double chi : {0.0, 0.7, kPi / 2.0}) {
    const double lowest = std::sqrt(1.0 - kSine * kSine);
    double sum = 0.0;
    constexpr int kRings = 300, kTurns = 120;
    for (int i = 0; i < kRings; ++i) {
      const double c = lowest + (1.0 - lowest) * (i + 0.5) / kRings, s = std::sqrt(1.0 - c * c);
      const double mu = std::sqrt(1.0 - s * s / (kSine * kSine));
      const double light = 1.0 - kU * (1.0 - mu) - kV * (1.0 - mu) * (1.0 - mu);
      for (int k = 0; k < kTurns; ++k) {
        const double cosine =
            std::cos(chi) * c + std::sin(chi) * s * std::cos(2.0 * kPi * (k + 0.5) / kTurns);
        sum += light * (1.0 + cosine * cosine) * (1.0 - lowest) / kRings * 2.0 * kPi / kTurns;
      }
    }
    const double square = std::sin(chi) * std::sin(chi);
    // The rule's error at the limb, where mu has no slope: kRings^-1.5.
    EXPECT_NEAR(scattered_light(kSine * kSine, square, kU, kV) / sum, 1.0, 2e-4);
  }
}

TEST(ScatteredLight, FarOutIsThatOfAPointSource) {
  // pi (R / r)² of the disc's mean light, (1 + cos² chi) of it. Digits are lost as (r / R)².
  const double sine = 1e-3, mean = 1.0 - 0.5 / 3.0 - 0.2 / 6.0;
  for (const double square_sine : {0.0, 0.3, 1.0})
    EXPECT_NEAR(scattered_light(sine * sine, square_sine, 0.5, 0.2) / (kPi * sine * sine * mean),
                2.0 - square_sine, 3e-6);
}

TEST(ScatteredLight, IsFiniteAtThePhotosphere) {
  // Half of the sky is Sun: a = 2 pi, b = 2 pi / 3.
  EXPECT_NEAR(scattered_light(1.0, 1.0, 0.0, 0.0), 2.0 * kPi * (4.0 / 3.0), 1e-10);
  EXPECT_NEAR(scattered_light(1.0, 0.0, 0.0, 0.0), 2.0 * kPi * (4.0 / 3.0), 1e-10);
}

}  // namespace
}  // namespace vegard::sim::thomson_test
