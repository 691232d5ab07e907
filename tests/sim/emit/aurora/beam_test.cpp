#include "sim/emit/aurora/beam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vegard::sim::beam_test {
namespace {

double altitude_km(const double enu[3], double observer_altitude_km) {
  const double up = enu[2] + observer_altitude_km + kEarthRadiusKm;
  return std::sqrt(enu[0] * enu[0] + enu[1] * enu[1] + up * up) - kEarthRadiusKm;
}

double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

TEST(FallFrame, IsOrthonormalAndFallsInBothHemispheres) {
  for (double inclination : {78.0, 90.0, 25.0, -70.0}) {
    for (double declination : {0.0, 17.0, -120.0}) {
      const FallFrame<double> f =
          fall_frame<double>(inclination * kRadiansPerDegree, declination * kRadiansPerDegree);
      const double* axes[3] = {f.along, f.across1, f.across2};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(dot(axes[i], axes[j]), i == j ? 1.0 : 0.0, 1e-14);
      EXPECT_NEAR(f.along[2], -std::sin(std::abs(inclination) * kRadiansPerDegree), 1e-14);
    }
  }
}

TEST(FallFrame, LeansToMagneticNorthInTheNorthAndToTheSouthInTheSouth) {
  const FallFrame<double> north = fall_frame<double>(70.0 * kRadiansPerDegree, 0.0);
  EXPECT_NEAR(north.along[1], std::cos(70.0 * kRadiansPerDegree), 1e-14);
  const FallFrame<double> south = fall_frame<double>(-70.0 * kRadiansPerDegree, 0.0);
  EXPECT_NEAR(south.along[1], -std::cos(70.0 * kRadiansPerDegree), 1e-14);
  const FallFrame<double> east = fall_frame<double>(70.0 * kRadiansPerDegree, 90.0 * kRadiansPerDegree);
  EXPECT_NEAR(east.along[0], std::cos(70.0 * kRadiansPerDegree), 1e-14);
}

TEST(StartBeam, RunsThroughItsFootFromTheTopToEightyKilometres) {
  const FallFrame<double> fall = fall_frame<double>(75.0 * kRadiansPerDegree, 12.0 * kRadiansPerDegree);
  for (double observer_altitude : {0.0, 2.3}) {
    for (double north : {-800.0, 0.0, 250.0, 1500.0}) {
      const Beam<double> beam = start_beam(130.0, north, fall, observer_altitude, 500.0, 80.0);
      double end[3], to_foot = 0.0;
      for (int i = 0; i < 3; ++i) end[i] = beam.start_in_enu_km[i] + beam.length_km * fall.along[i];
      EXPECT_NEAR(altitude_km(beam.start_in_enu_km, observer_altitude), 500.0, 1e-8);
      EXPECT_NEAR(altitude_km(end, observer_altitude), 80.0, 1e-8);
      // The foot lies on the beam, at 110 km.
      to_foot = (130.0 - beam.start_in_enu_km[0]) / fall.along[0];
      double foot[3];
      for (int i = 0; i < 3; ++i) foot[i] = beam.start_in_enu_km[i] + to_foot * fall.along[i];
      EXPECT_NEAR(foot[1], north, 1e-7);
      EXPECT_NEAR(altitude_km(foot, observer_altitude), 110.0, 1e-7);
      const double up[3] = {foot[0], foot[1], foot[2] + observer_altitude + kEarthRadiusKm};
      EXPECT_NEAR(beam.vertical, -dot(up, fall.along) / std::sqrt(dot(up, up)), 1e-12);
    }
  }
}

TEST(StartBeam, StandsLowerFarAwayOnARoundEarth) {
  // A foot 600 km away stands 28 km lower than on flat ground.
  const FallFrame<double> fall = fall_frame<double>(90.0 * kRadiansPerDegree, 0.0);
  const Beam<double> beam = start_beam(0.0, 600.0, fall, 0.0, 110.0, 80.0);
  EXPECT_NEAR(110.0 - beam.start_in_enu_km[2], 28.0, 0.5);
  EXPECT_NEAR(start_beam(0.0, 0.0, fall, 0.0, 110.0, 80.0).start_in_enu_km[2], 110.0, 1e-9);
}

TEST(StartBeam, IsNotDescendingBeyondWhereTheHorizonTiltsMoreThanTheField) {
  // The vertical at a foot d km to the north leans asin(d / 6481 km) from the observer's: 1000 km are 8.9
  // degrees, and a field that dips 5 degrees to the south rises there. To the south it descends more steeply.
  const FallFrame<double> fall = fall_frame<double>(5.0 * kRadiansPerDegree, 180.0 * kRadiansPerDegree);
  const double lean = std::asin(1000.0 / (kEarthRadiusKm + kFootAltitudeKm));
  const Beam<double> south = start_beam(0.0, -1000.0, fall, 0.0, 500.0, 80.0);
  const Beam<double> north = start_beam(0.0, 1000.0, fall, 0.0, 500.0, 80.0);
  EXPECT_NEAR(std::max(south.vertical, north.vertical), std::sin(5.0 * kRadiansPerDegree + lean), 1e-12);
  EXPECT_NEAR(std::min(south.vertical, north.vertical), std::sin(5.0 * kRadiansPerDegree - lean), 1e-12);
  EXPECT_LT(std::min(south.vertical, north.vertical), 0.0);
}

TEST(StartBeam, DerivativesAreThoseOfItsPlace) {
  const double incl = 75.0 * kRadiansPerDegree, decl = 0.2;
  const auto at = [](double e, double n, double i, double d) {
    return start_beam(e, n, fall_frame<double>(i, d), 0.1, 450.0, 80.0);
  };
  LocalDual e(130.0), n(240.0), i(incl), d(decl);
  e.d.t[foot_east] = n.d.t[foot_north] = i.d.t[inclination] = d.d.t[declination] = 1.0;
  const Beam<LocalDual> beam = start_beam(e, n, fall_frame(i, d), 0.1, 450.0, 80.0);
  const double h[4] = {1e-3, 1e-3, 1e-6, 1e-6};
  for (int k = 0; k < 4; ++k) {
    double step[4] = {0, 0, 0, 0};
    step[k] = h[k];
    const Beam<double> more = at(130.0 + step[0], 240.0 + step[1], incl + step[2], decl + step[3]);
    const Beam<double> less = at(130.0 - step[0], 240.0 - step[1], incl - step[2], decl - step[3]);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(beam.start_in_enu_km[c].d.t[k],
                  (more.start_in_enu_km[c] - less.start_in_enu_km[c]) / (2 * h[k]), 1e-5);
    EXPECT_NEAR(beam.length_km.d.t[k], (more.length_km - less.length_km) / (2 * h[k]), 1e-5);
    EXPECT_NEAR(beam.vertical.d.t[k], (more.vertical - less.vertical) / (2 * h[k]), 1e-8);
  }
}

}  // namespace
}  // namespace vegard::sim::beam_test
