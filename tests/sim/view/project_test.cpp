// Altitudes and projection over double and over packs, for the instruction set that this file is compiled
// for.
#include "sim/view/project-inl.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/earth.h"
#include "sim/emit/aurora/beam.h"

namespace vegard::sim {
namespace {

using HWY_NAMESPACE::Pack;

float first_lane(Pack pack) { return hwy::HWY_NAMESPACE::GetLane(pack.v); }

TEST(AltitudeKm, IsThatOfTheSphereWithinTwoCentimetres) {
  // Floats are good to some 6e-8 of the altitude more.
  for (double altitude = 0.0; altitude <= 650.0; altitude += 0.7) {
    const double excess = std::pow(kEarthRadiusKm + altitude, 2) - std::pow(kEarthRadiusKm, 2);
    EXPECT_NEAR(HWY_NAMESPACE::altitude_km(excess), altitude, 2e-5);
    EXPECT_NEAR(first_lane(HWY_NAMESPACE::altitude_km(Pack(excess))), altitude, 2e-5 + 3e-7 * altitude);
  }
}

TEST(AltitudeKm, RisesFromTheEarthsCentreToTwoRadii) {
  double before = -1e9;
  for (double distance = 0.0; distance <= 2.0; distance += 0.001) {
    const double altitude =
        HWY_NAMESPACE::altitude_km(kEarthRadiusKm * kEarthRadiusKm * (distance * distance - 1.0));
    EXPECT_GT(altitude, before) << distance;
    before = altitude;
  }
}

TEST(BeamAltitude, IsTheExcessOfThePointOverTheSphere) {
  const FallFrame<double> frame = fall_frame<double>(72.0 * kRadiansPerDegree, 0.3);
  const double observer_km = 0.4, start[3] = {-120.0, 310.0, 480.0};
  double axes[3][3];
  for (int i = 0; i < 3; ++i) {
    axes[0][i] = frame.along[i];
    axes[1][i] = frame.across1[i];
    axes[2][i] = frame.across2[i];
  }
  HWY_NAMESPACE::BeamAltitude<double> beam;
  beam.start(start, observer_km, axes);
  for (double along : {0.0, 3.0, 250.0, 430.0})
    for (double across : {-9.0, 0.0, 4.0}) {
      const double way[3] = {along, across, 0.5 * across};
      double point[3];
      for (int i = 0; i < 3; ++i)
        point[i] = start[i] + way[0] * axes[0][i] + way[1] * axes[1][i] + way[2] * axes[2][i];
      const double distance =
          std::hypot(std::hypot(point[0], point[1]), point[2] + kEarthRadiusKm + observer_km);
      EXPECT_NEAR(beam.excess_km2(way), distance * distance - kEarthRadiusKm * kEarthRadiusKm, 1e-6);
    }
}

TEST(SeePoint, WeighsByTheSquareOfTheDistanceAndTheSolidAngle) {
  // A pixel at the tangents (x, y) subtends (1 + x^2 + y^2)^(-3/2) / f^2.
  HWY_NAMESPACE::FilmView<double> film{700.0, 320.0, 350.0, 200.0, 700.0 * 350.0};
  const double point[3] = {40.0, -90.0, 210.0};
  bool in_front = false;
  const auto seen = HWY_NAMESPACE::see_point<double>(film, point, in_front);
  EXPECT_TRUE(in_front);
  const double x = point[0] / point[2], y = point[1] / point[2];
  EXPECT_NEAR(seen.column, 700.0 * x + 320.0, 1e-10);
  EXPECT_NEAR(seen.row, 350.0 * y + 200.0, 1e-10);
  const double r2 = 40.0 * 40.0 + 90.0 * 90.0 + 210.0 * 210.0;
  const double solid_angle = std::pow(1.0 + x * x + y * y, -1.5) / (700.0 * 350.0);
  EXPECT_NEAR(seen.per_steradian_cell * r2 * solid_angle, 1.0, 1e-12);
  const double behind[3] = {1.0, 1.0, -5.0};
  HWY_NAMESPACE::see_point<double>(film, behind, in_front);
  EXPECT_FALSE(in_front);
}

}  // namespace
}  // namespace vegard::sim
