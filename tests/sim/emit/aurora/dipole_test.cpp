#include "sim/emit/aurora/beam.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/light/sample.h"

namespace vegard::sim::dipole_test {
namespace {

Site site_at(double latitude_deg, double longitude_deg) {
  Site site;
  site.latitude_deg = latitude_deg;
  site.longitude_deg = longitude_deg;
  return site;
}

/// Below the horizon, of the direction of fall overhead.
double inclination_deg(const Field& field, const Site& site) {
  return std::asin(-dipole_fall_frame(dipole_axis(field, site), 0.0, 0.0).along[2]) / kRadiansPerDegree;
}

double angle_deg(const double a[3], const double b[3]) {
  return std::acos(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / kRadiansPerDegree;
}

TEST(Dipole, InclinationIsThatOfTheMagneticLatitude) {
  Field field;
  field.pole_latitude_deg = 80.0;
  field.pole_longitude_deg = -70.0;
  // On the pole's meridian the magnetic latitude is the latitude plus what the pole is short of 90.
  for (double latitude : {20.0, 50.0, 65.0, 79.0}) {
    const double expected =
        std::atan(2.0 * std::tan((latitude + 10.0) * kRadiansPerDegree)) / kRadiansPerDegree;
    EXPECT_NEAR(inclination_deg(field, site_at(latitude, -70.0)), expected, 1e-9) << latitude;
    const double across =
        std::atan(2.0 * std::tan((latitude - 10.0) * kRadiansPerDegree)) / kRadiansPerDegree;
    EXPECT_NEAR(inclination_deg(field, site_at(latitude, 110.0)), across, 1e-9) << latitude;
  }
  EXPECT_NEAR(inclination_deg(field, site_at(80.0, -70.0)), 90.0, 1e-5) << "an arcsine near 1";
}

TEST(Dipole, ElectronsFallInBothHemispheres) {
  Field field;
  for (double latitude : {-80.0, -65.0, 65.0, 80.0}) {
    EXPECT_GT(inclination_deg(field, site_at(latitude, 20.0)), 70.0) << latitude;
  }
}

// Spherical trigonometry: the triangle of the site, the Earth's pole and the dipole's.
TEST(Dipole, DeclinationFollowsTheSineRule) {
  const Field field;
  const Site alaska = site_at(65.1, -147.4);
  const FallFrame<double> fall = dipole_fall_frame(dipole_axis(field, alaska), 0.0, 0.0);
  const double pole = field.pole_latitude_deg * kRadiansPerDegree, here = 65.1 * kRadiansPerDegree;
  const double between = (field.pole_longitude_deg + 147.4) * kRadiansPerDegree;
  const double magnetic_latitude =
      std::asin(std::sin(pole) * std::sin(here) + std::cos(pole) * std::cos(here) * std::cos(between));
  const double declination = std::asin(std::cos(pole) * std::sin(between) / std::cos(magnetic_latitude));
  EXPECT_NEAR(std::atan2(fall.along[0], fall.along[1]), declination, 1e-12);
  EXPECT_GT(declination, 0.2) << "the pole in Ellesmere Land lies east of Alaska's north";
}

// The figure of the design: some 4.5 degrees over 320 km northward, at auroral latitudes.
TEST(Dipole, TurnsByFourAndAHalfDegreesOver320Km) {
  Field field;
  field.pole_latitude_deg = 90.0;
  const DipoleAxis axis = dipole_axis(field, site_at(65.0, 0.0));
  const auto here = dipole_fall_frame(axis, 0.0, 0.0), there = dipole_fall_frame(axis, 0.0, 320.0);
  EXPECT_NEAR(angle_deg(here.along, there.along), 4.5, 0.1);
}

TEST(Dipole, FramesAreOrthonormal) {
  const DipoleAxis axis = dipole_axis(Field(), site_at(75.0, -60.0));
  for (double east : {-900.0, -3.0, 0.0, 500.0}) {
    const FallFrame<double> f = dipole_fall_frame(axis, east, 400.0);
    const double* axes[3] = {f.along, f.across1, f.across2};
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const double product = axes[a][0] * axes[b][0] + axes[a][1] * axes[b][1] + axes[a][2] * axes[b][2];
        EXPECT_NEAR(product, a == b ? 1.0 : 0.0, 1e-12) << east << ": " << a << ", " << b;
      }
  }
}

TEST(Dipole, DerivativesAgreeWithDifferences) {
  const DipoleAxis axis = dipole_axis(Field(), site_at(69.0, 19.0));
  LocalDual east(130.0), north(-210.0);
  east.d.t[foot_east] = 1.0;
  north.d.t[foot_north] = 1.0;
  const FallFrame<LocalDual> f = dipole_fall_frame(axis, east, north);
  constexpr double h = 1e-3;
  const auto expect_slope = [&](LocalInput input, double de, double dn) {
    const auto more = dipole_fall_frame(axis, 130.0 + de, -210.0 + dn),
               less = dipole_fall_frame(axis, 130.0 - de, -210.0 - dn);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(f.along[i].d.t[input], (more.along[i] - less.along[i]) / (2 * h), 1e-11);
      EXPECT_NEAR(f.across1[i].d.t[input], (more.across1[i] - less.across1[i]) / (2 * h), 1e-10);
      EXPECT_NEAR(f.across2[i].d.t[input], (more.across2[i] - less.across2[i]) / (2 * h), 1e-10);
    }
  };
  expect_slope(foot_east, h, 0.0);
  expect_slope(foot_north, 0.0, h);
}

}  // namespace
}  // namespace vegard::sim::dipole_test
