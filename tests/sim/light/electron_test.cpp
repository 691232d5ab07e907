#include "sim/light/electron.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::electron_test {
namespace {

TEST(Electron, OfTenKiloelectronvoltsHasTheSpeedAndTheCollisionsOfTheSource) {
  // Source paper, section 3.2: "an electron with 10 keV (60000 km/s) can collide 300 times"; d_t = 1/300.
  EXPECT_NEAR(electron_speed_km_s(10.0), 58455.0, 1.0);
  EXPECT_NEAR(electron_speed_km_s(10.0), 60000.0, 0.03 * 60000.0);
  EXPECT_DOUBLE_EQ(mean_collisions(10.0), 300.0);
  EXPECT_DOUBLE_EQ(path_step_of(10.0), 1.0 / 300.0);
}

TEST(Electron, IsClassicalWhenSlowAndNeverFasterThanLight) {
  // sqrt(2 E / m) at 1 eV is 593.1 km/s.
  EXPECT_NEAR(electron_speed_km_s(0.001), 593.1, 0.05);
  EXPECT_LT(electron_speed_km_s(1e7), 299792.458);
  EXPECT_GT(electron_speed_km_s(1e7), 299792.0);
}

TEST(Electron, LosesThirtyThreeElectronvoltsToACollision) {
  for (double energy_kev : {0.2, 6.0, 40.0})
    EXPECT_NEAR(1000.0 * energy_kev / mean_collisions(energy_kev), 33.3, 0.05);
}

TEST(Electron, IsDeflectedMoreOftenPerMetreTheMoreEnergyItHas) {
  // 600 points of d_t = 1/300 on 200 km are 3 per kilometre; five times the energy, five times as many.
  EXPECT_NEAR(deflections_per_metre(path_step_of(10.0), 200.0), 0.003, 1e-12);
  EXPECT_NEAR(deflections_per_metre(path_step_of(2.0), 200.0), 0.0006, 1e-12);
  EXPECT_NEAR(deflections_per_metre(path_step_of(10.0), 400.0), 0.0015, 1e-12);
}

}  // namespace
}  // namespace vegard::sim::electron_test
