#include "fit/map/sequence/frame_check.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"
#include "tests/support/small_scene.h"

namespace vegard::tests::frame_check_test {
namespace {

fit::Photo dark_frame(const sim::Scene& scene, const std::string& name) {
  const sim::Image light(scene.camera.width, scene.camera.height, {"R", "G", "B"});
  return fit::photo_of_light(light, {}, name);
}

sim::PictureMetadata exposed(double seconds, double iso) {
  sim::PictureMetadata metadata;
  metadata.exposure_s = seconds;
  metadata.iso = iso;
  return metadata;
}

TEST(FrameCheck, RefusesAnotherExposure) {
  const sim::Scene scene = small_scene();
  fit::FrameCheck check(scene);
  check.add(dark_frame(scene, "a"), {}, 0.0, {});  // says nothing
  check.add(dark_frame(scene, "b"), exposed(4.0, 1600.0), 10.0, {});
  check.add(dark_frame(scene, "c"), exposed(4.01, 1600.0), 20.0, {});  // as cameras round
  check.add(dark_frame(scene, "d"), {}, 30.0, {});
  const std::string words = expect_error(sim::ErrorKind::unreadable_input, [&] {
    check.add(dark_frame(scene, "e"), exposed(2.0, 1600.0), 40.0, {});
  });
  EXPECT_TRUE(has_facts(words, "e | 2 s, ISO 1600 | than b (4 s, ISO 1600) | one exposure"));
}

TEST(FrameCheck, RefusesAnotherSize) {
  sim::Scene scene = small_scene();
  fit::FrameCheck check(scene);
  sim::Scene other = scene;
  other.camera.width += 1;
  const std::string words = expect_error(sim::ErrorKind::unreadable_input,
                                         [&] { check.add(dark_frame(other, "wide"), {}, 0.0, {}); });
  EXPECT_TRUE(has_facts(words, "wide | pixels"));
}

}  // namespace
}  // namespace vegard::tests::frame_check_test
