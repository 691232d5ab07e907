// An ejection on a film, as the scene's clock runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "sim/render/render.h"
#include "sim/render/render_memory.h"
#include "tests/support/kind_named.h"

namespace vegard::sim::ejection_in_time_test {
namespace {

Scene eruption(const std::string& kind) {
  Scene scene;
  scene.sheets.clear();
  scene.emission.lines = {557.7};
  scene.blur.width_deg = {0.0};
  scene.camera.width = 48;
  scene.camera.height = 40;
  scene.camera.hfov_deg = 1.5;
  scene.camera.azimuth_deg = 0.0;
  scene.camera.elevation_deg = 45.0;
  scene.sun.shown = true;
  Ejection ejection;
  ejection.kind = tests::kind_named<EjectionKind>(kind);
  ejection.longitude_deg = 80.0;
  ejection.strands = 10;
  ejection.rayleigh = {5.0};
  scene.ejections = {ejection};
  return scene;
}

TEST(EjectionInTime, MovesInPreviewsAsInRenders) {
  for (const char* kind : {"rope", "shell"}) {
    Scene scene = eruption(kind);
    RenderMemory memory;
    RenderOptions keeping;
    keeping.memory = &memory;
    const Image first = render(scene, keeping).rayleigh;
    scene.time.start_s += 900.0;
    const Image later = render(scene, keeping).rayleigh;
    EXPECT_EQ(later.data, render(scene).rayleigh.data);
    EXPECT_NE(later.data, first.data);
    double most = 0.0;
    for (const float light : later.data) most = std::max(most, static_cast<double>(light));
    EXPECT_GT(most, 0.0);
  }
}

TEST(EjectionInTime, ShowsHowOldItIsAtTheBeginningOfAnExposure) {
  // Age and the clock are one sum; instants of an exposure do not move what is marched.
  Scene scene = eruption("rope");
  scene.time.start_s = 300.0;
  const Image by_clock = render(scene).rayleigh;
  scene.time.start_s = 0.0;
  scene.ejections[0].age_s += 300.0;
  EXPECT_EQ(by_clock.data, render(scene).rayleigh.data);
  scene.time.exposure_s = 600.0;
  scene.time.instants = 4;
  EXPECT_EQ(by_clock.data, render(scene).rayleigh.data);
}

}  // namespace
}  // namespace vegard::sim::ejection_in_time_test
