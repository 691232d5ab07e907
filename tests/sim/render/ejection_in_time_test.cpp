// An ejection on a film, as the scene's clock runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

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

TEST(EjectionInTime, ItsAgeAndTheClockAreOneSum) {
  Scene scene = eruption("rope");
  scene.time.start_s = 300.0;
  const Image by_clock = render(scene).rayleigh;
  scene.time.start_s = 0.0;
  scene.ejections[0].age_s += 300.0;
  EXPECT_EQ(by_clock.data, render(scene).rayleigh.data);
}

// It moves during an exposure, whose picture is the mean of those of its instants.
TEST(EjectionInTime, IsTheMeanOfItsInstantsInAnExposure) {
  for (const char* kind : {"rope", "shell"}) {
    Scene scene = eruption(kind);
    scene.ejections[0].acceleration_m_s2 = 150.0;
    scene.time.start_s = 100.0;
    const Image first = render(scene).rayleigh;
    scene.time.exposure_s = 1200.0;
    scene.time.instants = 6;
    const Image exposed = render(scene).rayleigh;
    std::vector<double> mean(exposed.data.size(), 0.0);
    Scene one = scene;
    one.time.exposure_s = 0.0;
    one.time.instants = 1;
    for (int k = 0; k < 6; ++k) {
      one.time.start_s = 100.0 + 200.0 * k;
      const Image at = render(one).rayleigh;
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += at.data[i] / 6.0;
    }
    const double peak = *std::max_element(mean.begin(), mean.end());
    ASSERT_GT(peak, 0.0);
    double moved = 0.0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
      EXPECT_NEAR(exposed.data[i], mean[i], 1e-5 * peak) << kind;
      moved = std::max(moved, std::abs(static_cast<double>(exposed.data[i]) - first.data[i]));
    }
    EXPECT_GT(moved, 0.1 * peak);
  }
}

}  // namespace
}  // namespace vegard::sim::ejection_in_time_test
