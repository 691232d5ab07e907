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

TEST(PriorRows, KeepTheWavelengthOverTheAmplitudeNearThePapersRange) {
  sim::Scene scene = tests::small_scene();
  for (const char* path : {"sheet.main.thickness_km", "sheet.main.wavelength_km"})
    scene.fit.free.push_back(tests::free_entry(path));
  EXPECT_EQ(PriorRows(free_numbers(scene)).count(), 0u) << "only where it is asked for";
  scene.fit.ratio_spread = 0.25;
  const PriorRows both(free_numbers(scene));
  ASSERT_EQ(both.count(), 1u);
  std::vector<double> residuals, jacobian;
  both.evaluate({3.0, 60.0}, residuals, &jacobian);  // lambda / (2 w) = 10, within 5.2 to 31.4
  EXPECT_EQ(residuals[0], 0.0);
  EXPECT_EQ(jacobian, (std::vector<double>{0.0, 0.0}));
  both.evaluate({0.5, 62.8}, residuals, &jacobian);  // twice the most
  EXPECT_NEAR(residuals[0], std::log(2.0) / 0.25, 1e-12);
  EXPECT_NEAR(jacobian[0], -1.0 / (0.25 * 0.5), 1e-12);
  EXPECT_NEAR(jacobian[1], 1.0 / (0.25 * 62.8), 1e-12);
  both.evaluate({10.0, 52.0}, residuals, nullptr);  // half of the least
  EXPECT_NEAR(residuals[0], -std::log(2.0) / 0.25, 1e-12);
  // Of one that is free alone the other is the scene's.
  scene.fit.free.erase(scene.fit.free.begin());
  const PriorRows one(free_numbers(scene));
  ASSERT_EQ(one.count(), 1u);
  one.evaluate({2.0 * scene.sheets[0].thickness_km * 62.8}, residuals, nullptr);
  EXPECT_NEAR(residuals[0], std::log(2.0) / 0.25, 1e-12);
}

}  // namespace
}  // namespace vegard::fit::prior_rows_test
