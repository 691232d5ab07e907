#include "fit/parameters/prior_rows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/free_paths.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::prior_rows_test {
namespace {

TEST(PriorRows, AreOfTheLawThatIsGiven) {
  sim::Scene scene = tests::small_scene();
  for (const char* path :
       {"sheet.main.energy_kev", "sheet.main.width_km", "camera.hfov_deg", "camera.roll_deg"})
    scene.fit.free.push_back(tests::free_entry(path));
  scene.fit.free[0].prior = sim::Prior{4.0, 0.5, sim::PriorLaw::normal};
  scene.fit.free[1].prior = sim::Prior{2.0, 0.25, sim::PriorLaw::log_normal};
  scene.fit.free[2].prior = sim::Prior{0.0, 0.0, sim::PriorLaw::uniform};
  scene.fit.free[2].min = 40.0;
  scene.fit.free[2].max = 80.0;
  sim::validate(scene);
  const PriorRows rows(free_numbers(scene));
  ASSERT_EQ(rows.count(), 2u) << "a uniform prior says nothing between its limits";
  std::vector<double> residuals, jacobian;
  rows.evaluate({3.0, 3.0, 50.0, 0.0}, residuals, &jacobian);
  EXPECT_NEAR(residuals[0], -2.0, 1e-14);
  EXPECT_NEAR(residuals[1], std::log(1.5) / 0.25, 1e-14);
  const std::vector<double> expected = {2.0, 0.0, 0.0, 0.0, 0.0, 4.0 / 3.0, 0.0, 0.0};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(jacobian[i], expected[i], 1e-14) << i;
}

}  // namespace
}  // namespace vegard::fit::prior_rows_test
