// What a model says of a scene does not depend on what it was asked before: a fit that was cut off asks less.
#include "fit/model/profile_model.h"

#include <gtest/gtest.h>

#include <vector>

#include "sim/render/render.h"
#include "sim/scene/rows/spline_rates.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::profile_model_history_test {
namespace {

TEST(ProfileModel, OfAFreeFormProfileHasNoMemory) {
  sim::Scene scene = tests::small_scene();
  scene.sheets[0].beams = 300;
  scene.sheets[0].profile = sim::ProfileKind::spline;
  scene.sheets[0].spline_knots = 10;
  sim::fill_spline_rates(scene);
  Photo photo;
  photo.linear = sim::render(scene).rgb;
  photo.usable.assign(photo.linear.data.size(), 1);
  const Region region{20, 10, 120, 100};
  const auto coefficients = [](const sim::Scene& of) {
    std::vector<sim::ParameterId> ids;
    for (const sim::ParameterPath& path : sim::resolve(of, "sheet.spline_rate")) ids.push_back(path.id);
    return ids;
  };
  sim::Scene later = scene;
  for (double& rate : later.sheets[0].spline_rate) rate *= 3.7;

  ProfileModel experienced(scene, photo, region, 4, 1.0, 0.0, 1), fresh(scene, photo, region, 4, 1.0, 0.0, 1);
  ModelProfile first, second, only;
  experienced.evaluate_with_derivatives(scene, coefficients(scene), first);
  experienced.evaluate_with_derivatives(later, coefficients(later), second);
  fresh.evaluate_with_derivatives(later, coefficients(later), only);
  ASSERT_FALSE(only.derivative.empty());
  EXPECT_EQ(second.value, only.value);
  EXPECT_EQ(second.derivative, only.derivative);
}

}  // namespace
}  // namespace vegard::fit::profile_model_history_test
