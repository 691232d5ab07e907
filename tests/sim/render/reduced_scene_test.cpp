#include "sim/render/reduced_scene.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <numeric>

#include "sim/render/render.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::reduced_scene_test {
namespace {

TEST(ReducedScene, IsAsItWasWhereItIsCheapAlready) {
  const Scene scene = tests::small_scene();
  Reduction none;
  none.step_km = 0.0;
  none.step_cells = 0.0;
  none.shrink = 1;
  const Scene reduced = reduced_scene(scene, none);
  for (const ParameterPath& path : all_paths(scene))
    EXPECT_EQ(value_text(reduced, path), value_text(scene, path)) << path.text;
}

TEST(ReducedScene, IsValidAndNeverDearerThanTheWholeOne) {
  Scene scene = tests::small_scene();
  scene.march.shrink = 5;
  scene.march.step_km = 7.0;
  scene.sheets[0].beams_per_km = 60.0;
  scene.sheets[0].arcs = 3;
  const Scene reduced = reduced_scene(scene, {{80, 80}, 4.0, 2, 1e5});
  validate(reduced);
  EXPECT_EQ(reduced.camera.width, 80);
  EXPECT_EQ(reduced.camera.height, 60);
  EXPECT_EQ(reduced.march.shrink, 5);
  EXPECT_EQ(reduced.march.step_km, 7.0);
  EXPECT_NEAR(expected_deflection_points(reduced), 1e5, 0.01 * 1e5);
}

TEST(ReducedScene, ExpectsThePointsThatARenderingCounts) {
  Scene scene = tests::small_scene();
  scene.camera.hfov_deg = 150.0;  // the whole sheet is in view
  scene.sheets[0].length_km = 200.0;
  const double counted = static_cast<double>(render(scene).deflection_points);
  // A beam's steps are uniform with mean d_t / 2: some 600 to a path, to one part in forty; half a packet of
  // lanes may be counted beyond the last.
  EXPECT_NEAR(expected_deflection_points(scene) / counted, 1.0, 0.05);
}

TEST(ReducedScene, HasTheSameLightInFewerBeamsAndPixels) {
  Scene scene = tests::small_scene();
  scene.sheets[0].beams = 4000;
  const auto mean_of_line = [](const Image& image, int line) {
    double sum = 0.0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) sum += image.at(x, y, line);
    return sum / (image.width * image.height);
  };
  const Rendering whole = render(scene);
  const Rendering small = render(reduced_scene(scene, {{80, 80}, 4.0, 1, 1e6}));
  ASSERT_EQ(small.rayleigh.width, 80);
  // Some 1700 beams of the 8000 are left. Each lights a few hundred points of the picture; the mean's noise
  // is below 1 %, and what the fewer pixels leave out at the edges of the blur is less.
  for (int l = 0; l < 3; ++l)
    EXPECT_NEAR(mean_of_line(small.rayleigh, l) / mean_of_line(whole.rayleigh, l), 1.0, 0.03) << l;
}

}  // namespace
}  // namespace vegard::sim::reduced_scene_test
