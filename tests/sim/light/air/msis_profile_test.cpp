#include "sim/light/air/msis_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::msis_profile_test {
namespace {

constexpr double kBoundaryKm = 120.0, kJoinKm = 123.0;

MsisTemperatures temperatures() {
  MsisTemperatures all;
  all.t_inf_k = 1000.0;
  all.t_lb_k = 370.0;
  all.gradient_k_km = 16.0;
  all.node_k = {250.0, 195.0, 185.0, 210.0};
  all.node_slope_k_km = -1.8;
  return all;
}

MsisProfile profile() { return {MsisGravity(65.0), temperatures(), kBoundaryKm, kJoinKm}; }

double slope(const MsisProfile& p, double altitude_km, double step_km) {
  return (p.temperature_k(altitude_km + step_km) - p.temperature_k(altitude_km)) / step_km;
}

TEST(MsisProfile, GoesThroughItsNodesWithItsSlopes) {
  const MsisProfile p = profile();
  EXPECT_NEAR(p.temperature_k(120.0 + 1e-9), p.temperature_k(120.0 - 1e-9), 1e-6);
  EXPECT_NEAR(p.temperature_k(110.0), 250.0, 1e-9);
  EXPECT_NEAR(p.temperature_k(100.0), 195.0, 1e-9);
  EXPECT_NEAR(p.temperature_k(90.0), 185.0, 1e-9);
  EXPECT_NEAR(p.temperature_k(72.5), 210.0, 1e-9);
  EXPECT_NEAR(slope(p, 72.5, 1e-5), -1.8, 1e-4);
  EXPECT_NEAR(slope(p, kJoinKm, 1e-5), slope(p, kJoinKm, -1e-5), 1e-3);
  EXPECT_NEAR(p.temperature_k(2000.0), 1000.0, 1e-3);
}

TEST(MsisProfile, WithTheJoinAtTheBoundaryHasItsTemperatureAndSlope) {
  const MsisProfile p(MsisGravity(65.0), temperatures(), kBoundaryKm, kBoundaryKm);
  EXPECT_NEAR(p.temperature_k(kBoundaryKm), 370.0, 1e-9);
  EXPECT_NEAR(slope(p, kBoundaryKm, 1e-5), 16.0, 1e-3);
  EXPECT_NEAR(p.falloff(kBoundaryKm, 28.0, 0.3), 1.0, 1e-12);
}

TEST(MsisProfile, FallsOffByWeightAndThermalDiffusion) {
  const MsisProfile p = profile();
  const MsisGravity gravity(65.0);
  constexpr double kStepKm = 0.01, kMass = 16.0, kDiffusion = -0.38;
  for (double z = 73.0; z < 900.0; z += 8.9) {
    const double fall =
        std::log(p.falloff(z - kStepKm, kMass, kDiffusion) / p.falloff(z + kStepKm, kMass, kDiffusion)) /
        (2.0 * kStepKm);
    const double warming =
        std::log(p.temperature_k(z + kStepKm) / p.temperature_k(z - kStepKm)) / (2.0 * kStepKm);
    const double weight = kMass * gravity.at(z) / (831.4 * p.temperature_k(z));
    EXPECT_NEAR(fall, weight + (1.0 + kDiffusion) * warming, 1e-5 * weight) << z;
  }
}

TEST(MsisGravity, IsTheEarths) {
  // WGS 84's formula of gravity at sea level, 983.22 at the pole and 978.03 at the equator.
  EXPECT_NEAR(MsisGravity(90.0).surface_cm_s2, 983.22, 0.05);
  EXPECT_NEAR(MsisGravity(0.0).surface_cm_s2, 978.03, 0.05);
  const MsisGravity gravity(45.0);
  EXPECT_NEAR(gravity.radius_km, 6356.77,
              1.0);  // that of geopotential height in the U.S. Standard Atmosphere
  EXPECT_NEAR(gravity.geopotential_km(120.001, 120.0), 0.001, 1e-9);
}

}  // namespace
}  // namespace vegard::sim::msis_profile_test
