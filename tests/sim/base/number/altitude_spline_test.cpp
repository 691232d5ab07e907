#include "sim/base/number/altitude_spline.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::altitude_spline_test {
namespace {

TEST(AltitudeSpline, BasisSumsToOneInsideAndVanishesAtTheEnds) {
  const AltitudeSpline spline(80.0, 500.0, 36);
  const auto sum = [&](double altitude) {
    double total = 0.0;
    for (int k = 0; k < spline.count(); ++k) {
      EXPECT_GE(spline.basis(k, altitude), 0.0);
      total += spline.basis(k, altitude);
    }
    return total;
  };
  // Three of 39 intervals from either end: 85.5 km, and 20 (e^(36/39 ln 22) - 1) km above 80 km.
  for (const double altitude : {86.0, 100.0, 123.4, 200.0, 300.0, 405.0})
    EXPECT_NEAR(sum(altitude), 1.0, 1e-12) << altitude;
  for (const double altitude : {70.0, 80.0, 500.0, 640.0}) EXPECT_EQ(sum(altitude), 0.0) << altitude;
}

TEST(AltitudeSpline, LocalValuesAreThoseOfTheBasis) {
  const AltitudeSpline spline(85.0, 420.0, 7);
  for (double altitude = 80.0; altitude < 430.0; altitude += 0.7) {
    const AltitudeSpline::Local local = spline.at(altitude);
    for (int k = 0; k < spline.count(); ++k) {
      const int i = k - local.first;
      EXPECT_NEAR(i >= 0 && i < local.count ? local.value[i] : 0.0, spline.basis(k, altitude), 1e-15);
    }
  }
}

TEST(AltitudeSpline, IntegralIsThatOfTheBasis) {
  const AltitudeSpline spline(80.0, 500.0, 12);
  constexpr double kStep = 0.01;
  for (const int k : {0, 5, 11}) {
    double sum = 0.0;
    for (double altitude = 80.0; altitude < 500.0; altitude += kStep)
      sum += kStep * spline.basis(k, altitude + 0.5 * kStep);
    EXPECT_NEAR(sum, spline.integral_km(k), 1e-5 * sum);
  }
}

TEST(AltitudeSpline, IsLargestAboutItsCentre) {
  const AltitudeSpline spline(80.0, 500.0, 36);
  for (const int k : {0, 10, 35}) {
    const double centre = spline.centre_km(k);
    EXPECT_NEAR(spline.basis(k, centre), 2.0 / 3.0, 1e-12);
    EXPECT_LT(spline.basis(k, centre - 0.5), spline.basis(k, centre));
    EXPECT_LT(spline.basis(k, centre + 0.5), spline.basis(k, centre));
  }
}

}  // namespace
}  // namespace vegard::sim::altitude_spline_test
