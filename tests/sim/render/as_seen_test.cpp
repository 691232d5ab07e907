#include "sim/render/as_seen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/view/colour/radiometry.h"
#include "sim/view/sensor/tone_curve.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::as_seen_test {
namespace {

using tests::small_scene;

TEST(AsSeen, TheAuroraDoesNotDependOnTheSensor) {
  Scene scene = small_scene();
  const Image seen = picture_as_seen(scene, render(scene));
  scene.sensor.gain_per_kilorayleigh *= 7.0;
  scene.sensor.primaries = Primaries::smpte_c;
  EXPECT_EQ(picture_as_seen(scene, render(scene)).data, seen.data);
  EXPECT_GT(*std::max_element(seen.data.begin(), seen.data.end()), 0.1f);
}

TEST(AsSeen, AGreySkyIsAsLuminousAsItsValuesSay) {
  Scene scene = small_scene();
  scene.sheets.clear();
  scene.sky.level = {0.3, 0.3, 0.3};
  scene.sensor.gain_per_kilorayleigh = 0.06;  // so that the sky is as luminous as 5 kR of 557.7 nm
  const Image seen = picture_as_seen(scene, render(scene));
  const double luminance = 5e3 * luminance_cd_m2_per_rayleigh(557.7);
  constexpr Vector3 kD65{0.95046, 1.0, 1.08906};  // x = 0.3127, y = 0.3290
  const EyeLight light = eye_light_of_colour({luminance * kD65[0], luminance * kD65[1], luminance * kD65[2]});
  const Vector3 shown = displayed_as_seen(seen_linear_srgb(light), kSeenHalf_cd_m2);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen.at(3, 3, c), srgb_encode(shown[c]), 1e-4);
}

TEST(AsSeen, WhatTheForegroundHidesIsNotSeen) {
  Scene scene = small_scene();
  scene.sky.level = {0.01, 0.02, 0.03};
  Rendering rendering = render(scene);
  CompositePictures pictures;
  pictures.foreground = Image(scene.camera.width, scene.camera.height, {"R", "G", "B", "A"});
  for (std::size_t i = 3; i < pictures.foreground.data.size(); i += 4) pictures.foreground.data[i] = 1.0f;
  RenderOptions options;
  options.pictures = &pictures;
  // Rounding is all that can be left of it.
  const Image seen = picture_as_seen(scene, render(scene, options));
  for (float value : seen.data) ASSERT_LT(value, 1e-3f);
  const Image open = picture_as_seen(scene, rendering);
  EXPECT_GT(*std::min_element(open.data.begin(), open.data.end()), 0.05f);
}

/// A foreground that is half there, and black.
TEST(AsSeen, HalfAForegroundIsHalfTheLight) {
  Scene scene = small_scene();
  scene.sky.level = {0.01, 0.02, 0.03};
  CompositePictures pictures;
  pictures.foreground = Image(scene.camera.width, scene.camera.height, {"R", "G", "B", "A"});
  for (std::size_t i = 3; i < pictures.foreground.data.size(); i += 4) pictures.foreground.data[i] = 0.5f;
  RenderOptions options;
  options.pictures = &pictures;
  const Image behind = picture_as_seen(scene, render(scene, options));
  scene.sheets[0].energy_flux_mw_m2 *= 0.5;
  for (double& level : scene.sky.level) level *= 0.5;
  const Image half = picture_as_seen(scene, render(scene));
  for (std::size_t i = 0; i < half.data.size(); ++i) ASSERT_NEAR(behind.data[i], half.data[i], 1e-3f) << i;
}

}  // namespace
}  // namespace vegard::sim::as_seen_test
