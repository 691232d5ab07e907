// An exposure is the arithmetic mean of its instants (Baranoski et al. 2000, section 4.3).
#include <gtest/gtest.h>

#include <cmath>

#include "sim/emit/aurora/motion.h"
#include "sim/render/film.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::exposure_test {
namespace {

/// All that moves: the sheet, its sine, and the brightness.
Scene moving_scene() {
  Scene scene = tests::small_scene();
  scene.sheets[0].drift_km_s = {8.5, -2.5};
  scene.sheets[0].sine_speed_km_s = 30.0;
  scene.substorm.quiet = 0.1;
  scene.substorm.onset_s = 10.0;
  scene.substorm.growth_s = 20.0;
  scene.time.start_s = 3.0;
  return scene;
}

Exposure exposed(const Scene& scene) {
  const FilmGeometry film = film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 1.0, 1.0);
  Exposure exposure;
  make_exposer(scene, film, 0)->expose(scene, exposure);
  return exposure;
}

TEST(Exposure, IsTheMeanOfTheStillsAtItsInstants) {
  for (int instants : {2, 4, 8, 16}) {
    SCOPED_TRACE(instants);
    Scene scene = moving_scene();
    scene.time.instants = instants;
    scene.time.exposure_s = instants / 60.0;
    const Exposure exposure = exposed(scene);
    std::vector<double> mean(exposure.rayleigh.size(), 0.0);
    std::uint64_t points = 0;
    Exposure first;
    for (double instant_s : instants_s(scene.time)) {
      Scene still = scene;
      still.time.instants = 1;
      still.time.start_s = instant_s;
      const Exposure one = exposed(still);
      points += one.deflection_points;
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += one.rayleigh[i] / instants;
      if (first.rayleigh.empty()) first = one;
    }
    EXPECT_EQ(points, exposure.deflection_points);
    double moved = 0.0, light = 0.0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
      // The film adds integers: all that is rounded is each still's number to a float, half a unit in 2^24 of
      // it, and the exposure's.
      ASSERT_NEAR(exposure.rayleigh[i], mean[i], mean[i] * (2.0 / 16777216.0));
      moved += std::abs(exposure.rayleigh[i] - first.rayleigh[i]);
      light += mean[i];
    }
    EXPECT_GT(moved, 0.02 * light) << "nothing moves: the test would pass without a mean";
  }
}

TEST(Exposure, OfAStillSheetIsTheStill) {
  Scene scene = tests::small_scene();
  const Exposure still = exposed(scene);
  scene.time.instants = 4;
  scene.time.exposure_s = 1.0;
  EXPECT_EQ(exposed(scene).rayleigh, still.rayleigh) << "sums of integers: not a bit differs";
}

}  // namespace
}  // namespace vegard::sim::exposure_test
