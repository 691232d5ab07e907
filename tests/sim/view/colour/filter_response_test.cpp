#include "sim/view/colour/sensor_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/render/render.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/colour/radiometry.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::filter_response_test {
namespace {

Scene imager() {
  Scene scene = tests::small_scene();
  scene.sensor.response = "filters";
  scene.sensor.gain_per_kilorayleigh = 0.25;
  return scene;
}

TEST(FilterResponse, EveryChannelSeesItsOwnLineOnly) {
  const Scene scene = imager();
  ASSERT_EQ(scene.emission.lines.size(), 3u);
  const std::vector<Vector3> colours = line_colours(scene);
  for (int l = 0; l < 3; ++l)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(colours[l][c], l == c ? 0.25 : 0.0);
  const Matrix3 raw = rgb_from_raw(scene);
  EXPECT_EQ(raw, kIdentity3);
}

TEST(FilterResponse, APictureIsKilorayleighsTimesTheGain) {
  Scene scene = imager();
  scene.sky.level = {0.0, 0.0, 0.0};
  const Rendering rendering = render(scene);
  float most = 0.0f;
  for (std::size_t i = 0; i < rendering.rgb.data.size(); ++i) {
    most = std::max(most, rendering.rgb.data[i]);
    ASSERT_NEAR(rendering.rgb.data[i], 0.25e-3 * rendering.rayleigh.data[i],
                1e-6 * rendering.rgb.data[i] + 1e-12);
  }
  EXPECT_GT(most, 0.0f);
}

// A spectrum of one rayleigh per nm gives the five nanometres that a filter is wide. The table is straight
// where the energy of photons bends the triangle's sides: of two steps at t and 1 - t of them, t (1 - t) (5
// nm / line)^2 is left.
TEST(FilterResponse, AnEvenSpectrumIsSummedOverFiveNanometres) {
  const Scene scene = imager();
  const Vector3 rgb = colour_of_continuum(scene, [](double nm) { return radiance_w_m2_sr_per_rayleigh(nm); });
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(rgb[c] / (5.0 * 0.25e-3), 1.0, 0.26 * std::pow(5.0 / scene.emission.lines[c], 2));
}

}  // namespace
}  // namespace vegard::sim::filter_response_test
