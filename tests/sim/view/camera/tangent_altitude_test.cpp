// Tangent altitudes against the distance of a straight line from the Earth's centre.
#include "sim/view/camera/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/constants.h"

namespace vegard::sim::tangent_altitude_test {
namespace {

TEST(TangentAltitude, IsTheLeastHeightAlongTheLine) {
  const double observer_km = 390.0;
  for (const double elevation_deg : {-5.0, -17.0, -19.0, -21.0, -60.0}) {
    const double e = elevation_deg * kRadiansPerDegree;
    double min_km = 1e9, at_km = 0.0;
    for (double along_km = 0.0; along_km < 7000.0; along_km += 0.25) {
      const double height_km =
          std::hypot(along_km * std::cos(e), kEarthRadiusKm + observer_km + along_km * std::sin(e)) -
          kEarthRadiusKm;
      if (height_km < min_km) min_km = height_km, at_km = along_km;
    }
    // Beside its least point a line rises by the square of the way over twice its distance from the centre
    // (3380 km at -60 degrees).
    EXPECT_NEAR(tangent_altitude_km(observer_km, elevation_deg), min_km, 0.125 * 0.125 / 6000.0);
    EXPECT_NEAR(tangent_distance_km(observer_km, elevation_deg), at_km, 0.125 + 1e-6);
  }
}

TEST(TangentAltitude, IsNothingAtTheEarthsEdgeAndTheObserversAtTheHorizontal) {
  const double observer_km = 390.0;
  const double dip_deg = std::acos(kEarthRadiusKm / (kEarthRadiusKm + observer_km)) / kRadiansPerDegree;
  EXPECT_NEAR(tangent_altitude_km(observer_km, -dip_deg), 0.0, 1e-9);
  EXPECT_NEAR(tangent_altitude_km(observer_km, -1e-6), observer_km, 1e-9);
  EXPECT_TRUE(std::isnan(tangent_altitude_km(observer_km, 0.0)));
  EXPECT_TRUE(std::isnan(tangent_distance_km(observer_km, 3.0)));
}

TEST(TangentAltitude, TurnsBackIntoTheElevation) {
  for (const double tangent_km : {-300.0, 0.0, 96.0, 110.0, 389.0})
    EXPECT_NEAR(tangent_altitude_km(390.0, elevation_of_tangent_deg(390.0, tangent_km)), tangent_km, 1e-9);
  EXPECT_TRUE(std::isnan(elevation_of_tangent_deg(390.0, 391.0)));
}

}  // namespace
}  // namespace vegard::sim::tangent_altitude_test
