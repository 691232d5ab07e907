#include "sim/view/sky/air.h"
#include "sim/scene/structs/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "sim/base/number/constants.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim::air_test {
namespace {

double sine(double elevation_deg) { return std::sin(elevation_deg * kRadiansPerDegree); }

Scene under_air() {
  Scene scene;
  scene.air.model = AirModel::standard;
  return scene;
}

/// Kasten and Young 1989, equation (3) with its revised constants, elevation in degrees.
double kasten_young(double elevation_deg) {
  return 1.0 / (sine(elevation_deg) + 0.50572 * std::pow(elevation_deg + 6.07995, -1.6364));
}

TEST(Air, MoleculesHaveTheAirmassOfKastenAndYoung) {
  const AirColumn molecules(molecules_shape(), 0.0, molecules_shape().width_km);
  EXPECT_NEAR(molecules.at(sine(90.0)), 1.0, 1e-6);
  EXPECT_NEAR(molecules.at(sine(30.0)), 1.9939, 0.001) << "their table";
  for (double elevation = 30.0; elevation <= 90.0; elevation += 5.0)
    EXPECT_NEAR(molecules.at(sine(elevation)) / kasten_young(elevation), 1.0, 0.001) << elevation;
  for (double elevation = 5.0; elevation <= 30.0; elevation += 1.0)
    EXPECT_NEAR(molecules.at(sine(elevation)) / kasten_young(elevation), 1.0, 0.004) << elevation;
  for (double elevation = 0.0; elevation <= 5.0; elevation += 0.25)
    EXPECT_NEAR(molecules.at(sine(elevation)) / kasten_young(elevation), 1.0, 0.012) << elevation;
  EXPECT_NEAR(molecules.at(0.0), 38.0, 0.5) << "about 38 at the horizon";
  std::cout << "elevation, airmass here, by Kasten and Young, transmission of 427.8, 557.7, 630.0 nm\n";
  for (double elevation : {0.0, 1.0, 2.0, 5.0, 10.0, 20.0, 30.0, 60.0, 90.0}) {
    std::cout << elevation << ", " << molecules.at(sine(elevation)) << ", " << kasten_young(elevation);
    for (double nm : {427.8, 557.7, 630.0}) std::cout << ", " << air_transmission(under_air(), nm, elevation);
    std::cout << "\n";
  }
}

/// The horizontal column of an exponential layer by a series: sqrt(pi x / 2) (1 + 3 / (8 x) - 15 / (128
/// x^2)), x = radius / scale height (Chapman 1931: x e^x K1(x)).
TEST(Air, HorizonOfAnExponentialLayerIsChapmans) {
  for (double height_km : {0.3, 1.2, 2.0, 7.0}) {
    const double x = kEarthRadiusKm / height_km;
    const double chapman = std::sqrt(0.5 * 3.14159265358979 * x) * (1.0 + 0.375 / x - 15.0 / (128.0 * x * x));
    EXPECT_NEAR(AirColumn({0.0, height_km, false}, 0.0, height_km).at(0.0) / chapman, 1.0, 1e-5);
  }
}

/// Between the knots as well: against Simpson's rule with 200 000 steps.
TEST(Air, ColumnIsTheIntegralAlongTheLine) {
  for (const AirShape& shape : {molecules_shape(), AirShape{0.0, 2.0, false}, ozone_shape()})
    for (double observer_km : {0.0, 3.7})
      for (double elevation : {-1.3, 0.07, 0.9, 4.3, 23.7, 77.0}) {
        if (elevation < 0.0 && observer_km == 0.0) continue;
        constexpr int kSteps = 200000;
        const double from = kEarthRadiusKm + observer_km, s = sine(elevation), end = 3000.0;
        double sum = 0.0;
        for (int i = 0; i <= kSteps; ++i) {
          const double way = end * i / kSteps;
          const double above = std::sqrt(from * from + way * way + 2.0 * from * way * s) - from;
          const double away = (above + observer_km - shape.centre_km) / shape.width_km;
          const double density =
              shape.gaussian ? std::exp(-0.5 * away * away) : std::exp(-above / shape.width_km);
          sum += density * (i == 0 || i == kSteps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * end / (3.0 * kSteps);
        }
        EXPECT_NEAR(AirColumn(shape, observer_km, 1.0).at(s) / sum, 1.0, 2e-6) << elevation << observer_km;
      }
}

TEST(Air, OzoneIsNearlyAShellsAt22Km) {
  // Robinson 1966, "Solar Radiation": (1 + z / R) / sqrt(sin^2 e + 2 z / R).
  const AirColumn ozone(ozone_shape(), 0.0, std::sqrt(2.0 * 3.14159265358979) * ozone_shape().width_km);
  for (double elevation : {0.0, 5.0, 10.0, 30.0, 90.0}) {
    const double z = 22.0 / kEarthRadiusKm;
    const double shell = (1.0 + z) / std::sqrt(sine(elevation) * sine(elevation) + 2.0 * z);
    EXPECT_NEAR(ozone.at(sine(elevation)) / shell, 1.0, 0.03) << elevation;
  }
}

TEST(Air, MoleculesHaveBodhainesOpticalDepth) {
  EXPECT_NEAR(rayleigh_optical_depth(550.0), 0.0972, 0.0002);
  // An independent formula: Hansen and Travis 1974, Space Sci. Rev. 16, 527, equation (2.30).
  for (double nm : {391.4, 427.8, 557.7, 630.0, 844.6}) {
    const double um2 = nm * nm * 1e-6;
    const double hansen_travis = 0.008569 / (um2 * um2) * (1.0 + 0.0113 / um2 + 0.00013 / (um2 * um2));
    EXPECT_NEAR(rayleigh_optical_depth(nm) / hansen_travis, 1.0, 0.01) << nm;
  }
}

TEST(Air, OzoneAbsorbsMostIn600) {
  // The Chappuis band's peak, 5.1e-21 cm2 near 602 nm, times 300 DU: 0.041.
  EXPECT_NEAR(ozone_optical_depth(602.0, 300.0), 0.041, 0.002);
  EXPECT_LT(ozone_optical_depth(427.8, 300.0), 0.002);
  EXPECT_DOUBLE_EQ(ozone_optical_depth(557.7, 150.0), 0.5 * ozone_optical_depth(557.7, 300.0));
}

TEST(Air, PressureIsTheStandardAtmospheres) {
  // U.S. Standard Atmosphere 1976: 540.48 hPa at 5 km, 55.293 hPa at 20 km, over 1013.25.
  EXPECT_DOUBLE_EQ(pressure_share(0.0), 1.0);
  EXPECT_NEAR(pressure_share(5.0), 540.48 / 1013.25, 1e-5);
  EXPECT_NEAR(pressure_share(20.0), 55.293 / 1013.25, 1e-5);
}

TEST(Air, MoreArrivesFromHigherUpAndForLongerWavelengths) {
  const Scene scene = under_air();
  double before = 0.0;
  for (double elevation = 0.0; elevation <= 90.0; elevation += 0.25) {
    const double now = air_transmission(scene, 557.7, elevation);
    EXPECT_GT(now, before) << elevation;
    before = now;
  }
  EXPECT_LT(before, 1.0);
  EXPECT_LT(air_transmission(scene, 391.4, 20.0), air_transmission(scene, 427.8, 20.0));
  EXPECT_LT(air_transmission(scene, 427.8, 20.0), air_transmission(scene, 557.7, 20.0));
  Scene higher = scene;
  higher.site.altitude_m = 2640.0;
  EXPECT_GT(air_transmission(higher, 557.7, 20.0), air_transmission(scene, 557.7, 20.0));
}

TEST(Air, AtTheZenithIsTheSumOfVerticalDepths) {
  const Scene scene = under_air();
  const double depth =
      rayleigh_optical_depth(427.8) + ozone_optical_depth(427.8, 300.0) + 0.1 * std::pow(427.8 / 550.0, -1.3);
  EXPECT_NEAR(air_transmission(scene, 427.8, 90.0), std::exp(-depth), 1e-5);
}

// Of molecules there is left what the pressure says, of aerosol what its own scale height says.
TEST(Air, AboveAMountainIsLessOfEachByItsOwnLaw) {
  Scene scene = under_air();
  scene.site.altitude_m = 2640.0;
  for (const double scale_km : {0.8, 1.5, 3.0}) {
    scene.air.aerosol_height_km = scale_km;
    const double depth = rayleigh_optical_depth(427.8) * pressure_share(2.64) +
                         ozone_optical_depth(427.8, 300.0) +
                         0.1 * std::pow(427.8 / 550.0, -1.3) * std::exp(-2.64 / scale_km);
    EXPECT_NEAR(air_transmission(scene, 427.8, 90.0), std::exp(-depth), 1e-5) << scale_km;
  }
}

TEST(Air, IsFiniteBelowTheHorizonAndHighUp) {
  for (double altitude_m : {-500.0, 0.0, 10000.0, 50000.0, 79000.0})
    for (double elevation : {-90.0, -30.0, -7.0, -1.0, 0.0, 90.0}) {
      Scene scene = under_air();
      scene.site.altitude_m = altitude_m;
      scene.air.aerosol_height_km = 0.3;
      const double share = air_transmission(scene, 557.7, elevation);
      EXPECT_GE(share, 0.0);
      EXPECT_LE(share, 1.0);
    }
  Scene orbit = under_air();
  orbit.site.altitude_m = 400000.0;
  EXPECT_EQ(air_transmission(orbit, 557.7, -20.0), 1.0);
  EXPECT_EQ(air_transmission(Scene(), 557.7, 5.0), 1.0) << "no air";
}

}  // namespace
}  // namespace vegard::sim::air_test
