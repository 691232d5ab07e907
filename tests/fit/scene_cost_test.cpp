// The cost by itself is the cost of the fit's own parts, by values where theirs is by coordinates.
#include "fit/scene_cost.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_error.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::scene_cost_test {
namespace {

sim::Scene scene_with_two_free() {
  sim::Scene scene = tests::small_scene();
  scene.sky.level = {0.02, 0.03, 0.05};
  scene.fit.bands = 3;
  for (const char* path : {"sheet.main.center_km.north", "sheet.main.energy_kev"}) {
    sim::FreeParameter free;
    free.path = path;
    scene.fit.free.push_back(free);
  }
  return scene;
}

struct Evaluated {
  std::vector<double> residuals, jacobian;
};
Evaluated evaluated(const SceneCost& cost, const std::vector<double>& values) {
  Evaluated all{std::vector<double>(cost.residuals()),
                std::vector<double>(cost.residuals() * cost.free().size())};
  EXPECT_TRUE(cost.evaluate(values, all.residuals.data(), all.jacobian.data()));
  return all;
}

TEST(SceneCost, IsThatOfTheCoordinates) {
  const sim::Scene scene = scene_with_two_free();
  const Photo photo = tests::rendered_photo(tests::small_scene());
  const SceneCost cost(scene, {&photo}, 1);
  const std::vector<double> values = {193.0, 3.3};
  const Evaluated found = evaluated(cost, values);

  const std::vector<double> at = cost.cost().coordinates(values);
  Evaluated expected = found;
  const double* parameters[] = {at.data()};
  double* jacobians[] = {expected.jacobian.data()};
  ASSERT_TRUE(cost.cost().Evaluate(parameters, expected.residuals.data(), jacobians));
  EXPECT_EQ(found.residuals, expected.residuals);
  for (std::size_t i = 0; i < found.jacobian.size(); ++i) {
    const FreeNumber& number = cost.free()[i % 2];
    // A division and a multiplication apart.
    EXPECT_NEAR(found.jacobian[i] * number.slope(at[i % 2]), expected.jacobian[i],
                1e-14 * std::abs(expected.jacobian[i]));
  }
  EXPECT_EQ(cost.start(), (std::vector<double>{190.0, scene.sheets[0].energy_kev}));
  EXPECT_LE(cost.data_residuals(), cost.residuals());
  // Nothing is left of an evaluation that the next could see.
  EXPECT_EQ(evaluated(cost, values).jacobian, found.jacobian);
}

TEST(SceneCost, AValueAtItsLimitCountsAsOneJustInside) {
  sim::Scene scene = scene_with_two_free();
  scene.fit.free[1].min = 2.0;
  scene.fit.free[1].max = 6.0;
  const Photo photo = tests::rendered_photo(tests::small_scene());
  const SceneCost cost(scene, {&photo}, 1);
  EXPECT_EQ(cost.beyond_limits({190.0, 6.0}), "");
  const double just_inside = cost.free()[1].value(cost.free()[1].coordinate(6.0));
  EXPECT_LT(just_inside, 6.0);
  EXPECT_GT(just_inside, 5.9999);
  const Evaluated at = evaluated(cost, {190.0, 6.0}), inside = evaluated(cost, {190.0, just_inside});
  for (std::size_t i = 0; i < at.residuals.size(); ++i)
    EXPECT_NEAR(at.residuals[i], inside.residuals[i], 1e-6);
  for (const double slope : at.jacobian) EXPECT_TRUE(std::isfinite(slope));
}

TEST(SceneCost, SaysWhichValueLiesBeyondWhichLimits) {
  sim::Scene scene = scene_with_two_free();
  scene.fit.free[1].min = 2.0;
  scene.fit.free[1].max = 6.0;
  const Photo photo = tests::rendered_photo(tests::small_scene());
  const SceneCost cost(scene, {&photo}, 1);
  EXPECT_EQ(cost.beyond_limits({190.0, 3.0}), "");
  EXPECT_TRUE(tests::has_facts(cost.beyond_limits({190.0, 9.0}), "sheet.main.energy_kev = 9 | 2 to 6"));
  EXPECT_TRUE(tests::has_facts(cost.beyond_limits({190.0, -1.0}), "sheet.main.energy_kev = -1 | 2 to 6"));
}

TEST(SceneCost, RefusesWhatAFitRefuses) {
  const Photo photo = tests::rendered_photo(tests::small_scene());
  tests::expect_error(sim::ErrorKind::scene, [&] { SceneCost(tests::small_scene(), {&photo}, 1); });
  sim::Scene larger = scene_with_two_free();
  larger.camera.width += 1;
  tests::expect_error(sim::ErrorKind::scene, [&] { SceneCost(larger, {&photo}, 1); });
}

}  // namespace
}  // namespace vegard::fit::scene_cost_test
