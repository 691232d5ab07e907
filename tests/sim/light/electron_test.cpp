#include "sim/light/electron.h"

#include <gtest/gtest.h>

namespace vegard::sim::electron_test {
namespace {

TEST(Electron, OfTenKiloelectronvoltsHasTheCollisionsOfTheSource) {
  // Source paper, section 3.2: "an electron with 10 keV (60000 km/s) can collide 300 times"; d_t = 1/300.
  EXPECT_DOUBLE_EQ(mean_collisions(10.0), 300.0);
  EXPECT_DOUBLE_EQ(path_step_of(10.0), 1.0 / 300.0);
}

TEST(Electron, LosesThirtyThreeElectronvoltsToACollision) {
  for (double energy_kev : {0.2, 6.0, 40.0})
    EXPECT_NEAR(1000.0 * energy_kev / mean_collisions(energy_kev), 33.3, 0.05);
}

}  // namespace
}  // namespace vegard::sim::electron_test
