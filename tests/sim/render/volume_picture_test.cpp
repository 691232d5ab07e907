// Volumes in whole pictures, by a dusty sphere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/base/picture/image_io.h"
#include "sim/render/beam_exposer.h"
#include "sim/render/render.h"
#include "sim/scene/table/parameter_id.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::volume_picture_test {
namespace {

constexpr int kWidth = 60, kHeight = 40;

/// A sphere of radius 1 seen as 5.7 degrees' radius, 11 pixels, in the middle of the picture.
Scene dusty_sphere(double dust_depth = 0.8) {
  Scene scene;
  scene.camera.width = kWidth;
  scene.camera.height = kHeight;
  scene.camera.hfov_deg = 30.0;
  scene.camera.elevation_deg = 45.0;
  scene.blur.width_deg = {0.0, 0.0, 0.0};
  scene.sky.level = {0.1, 0.2, 0.3};
  Node sphere;
  sphere.name = "ball";
  scene.nodes.push_back(sphere);
  Nebula nebula;
  nebula.gas = nebula.dust = "ball";
  nebula.unit_pc = 100.0;
  nebula.step = 0.1;
  nebula.dust_depth = dust_depth;
  nebula.inner_rayleigh = {400.0, 900.0, 200.0};
  nebula.outer_rayleigh = {500.0, 100.0, 300.0};
  scene.nebulae.push_back(nebula);
  return scene;
}

double total(const std::vector<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST(VolumePicture, HidesTheSkyByItsDust) {
  const Rendering r = render(dusty_sphere());
  const float sky[3] = {0.1f, 0.2f, 0.3f};
  ASSERT_FALSE(r.hidden.empty());
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(r.hidden.at(30, 20, c), 0.5f) << "an optical depth of 1.6 at 550 nm";
    EXPECT_EQ(r.hidden.at(2, 2, c), 0.0f);
    EXPECT_NEAR(r.rgb.at(30, 20, c), r.aurora.at(30, 20, c) + (1.0f - r.hidden.at(30, 20, c)) * sky[c], 1e-6);
    EXPECT_FLOAT_EQ(r.rgb.at(2, 2, c), sky[c]);
    EXPECT_FLOAT_EQ(r.volume.at(30, 20, c), r.aurora.at(30, 20, c)) << "nothing else shines by lines";
  }
  EXPECT_GT(r.hidden.at(30, 20, 2), r.hidden.at(30, 20, 0)) << "dust reddens";
  EXPECT_GT(r.volume.at(30, 20, 3), r.hidden.at(30, 20, 0));
  EXPECT_LT(r.volume.at(30, 20, 3), r.hidden.at(30, 20, 2));
}

TEST(VolumePicture, IsOnlyAddedIfToldSo) {
  Scene scene = dusty_sphere();
  const Rendering alpha = render(scene);
  scene.march.blend = BlendRule::add;
  const Rendering added = render(scene);
  EXPECT_EQ(added.rayleigh.data, alpha.rayleigh.data) << "dust takes the nebula's own light all the same";
  EXPECT_TRUE(added.hidden.empty());
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(added.rgb.at(30, 20, c), added.aurora.at(30, 20, c) + scene.sky.level[c], 1e-6);
  EXPECT_EQ(added.volume.at(30, 20, 3), 0.0f);
}

TEST(VolumePicture, OfWhatAbsorbsNothingIsTheSameByBothWaysOfBlending) {
  Scene scene = dusty_sphere(0.0);
  const Rendering alpha = render(scene);
  scene.march.blend = BlendRule::add;
  EXPECT_EQ(render(scene).rgb.data, alpha.rgb.data);
}

TEST(VolumePicture, EndsAtWhatStandsBeforeIt) {
  const tests::TemporaryFolder folder;
  Scene scene = dusty_sphere();
  scene.file = folder / "scene.toml";
  const Rendering whole = render(scene);
  Image depth(kWidth, kHeight, {"Z"});
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      depth.at(x, y, 0) = x < kWidth / 2 ? 3.0f : std::numeric_limits<float>::infinity();
  write_exr(folder / "z.exr", depth, {});
  scene.march.depth = "z.exr";
  for (const int shrink : {1, 3}) {
    scene.march.shrink = shrink;
    const Rendering stopped = render(scene);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth / 2; ++x) {
        ASSERT_EQ(stopped.rayleigh.at(x, y, 1), 0.0f);
        ASSERT_EQ(stopped.hidden.at(x, y, 1), 0.0f) << "nor is what stands there hidden";
      }
    if (shrink > 1) continue;
    for (int y = 0; y < kHeight; ++y)
      for (int x = kWidth / 2; x < kWidth; ++x)
        ASSERT_EQ(stopped.rayleigh.at(x, y, 1), whole.rayleigh.at(x, y, 1));
  }
}

TEST(VolumePicture, OfFewerRaysIsNearTheWhole) {
  Scene scene = dusty_sphere();
  scene.nebulae[0].edge = 0.6;  // smooth over the coarse cells
  const Rendering whole = render(scene);
  scene.march.shrink = 2;
  const Rendering fewer = render(scene);
  EXPECT_NE(fewer.rayleigh.data, whole.rayleigh.data);
  EXPECT_NEAR(total(fewer.rayleigh.data), total(whole.rayleigh.data), 0.01 * total(whole.rayleigh.data));
}

TEST(VolumePicture, GlowsWithoutLosingLight) {
  Scene scene = dusty_sphere();
  const Rendering plain = render(scene);
  scene.march.glow = 0.5;
  scene.march.glow_deg = 0.5;
  const Rendering glowing = render(scene);
  // One pixel's sigma, so that four of them stay in the picture; sums of floats.
  EXPECT_NEAR(total(glowing.rayleigh.data), total(plain.rayleigh.data), 1e-5 * total(plain.rayleigh.data));
  EXPECT_GT(glowing.rayleigh.at(30, 20 - 13, 1), plain.rayleigh.at(30, 20 - 13, 1));
  EXPECT_EQ(glowing.hidden.data, plain.hidden.data) << "glow hides nothing";
}

TEST(VolumePicture, UnderThePhysicalBlurIsAsMarched) {
  Scene scene = dusty_sphere();
  const Rendering by_angle = render(scene);
  scene.blur.model = BlurModel::physical;
  const Rendering physical = render(scene);
  EXPECT_GT(total(physical.rayleigh.data), 0.0);
  EXPECT_EQ(physical.rayleigh.data, by_angle.rayleigh.data);
  EXPECT_EQ(physical.rgb.data, by_angle.rgb.data);
}

TEST(VolumePicture, HasItsDerivativesSoftenedAndGlowing) {
  Scene scene = dusty_sphere();
  scene.nebulae[0].brightness = 1.7;
  scene.march.smooth_px = 1.5;
  scene.march.glow = 0.4;
  scene.march.glow_deg = 2.0;
  scene.march.shrink = 4;
  BeamExposer exposer(scene, film_for(scene, 0, 0, kWidth, kHeight, 1.0, 1.0), 2);
  Exposure exposure;
  exposer.expose_with_derivatives(scene, {parameter_at(scene, "nebula.brightness").value()}, exposure);
  float largest = 0.0f;
  for (const float light : exposure.rayleigh) largest = std::max(largest, light);
  ASSERT_GT(largest, 100.0f);
  // Light goes as brightness: d light / d brightness = light / brightness, but for floats' rounding.
  for (std::size_t i = 0; i < exposure.rayleigh.size(); ++i)
    ASSERT_NEAR(exposure.derivative[i * exposure.free_stride] * 1.7f, exposure.rayleigh[i], 1e-5 * largest);
}

}  // namespace
}  // namespace vegard::sim::volume_picture_test
