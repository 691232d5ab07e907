// A Sun that turns, in whole pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/render/render.h"
#include "sim/render/render_memory.h"
#include "sim/scene/file/scene_toml.h"

namespace vegard::sim::sun_rotation_test {
namespace {

constexpr double kDay_s = 86400.0;

/// A disc of 40 pixels' diameter with one of each of what turns with it.
Scene a_sun(const std::string& more_of_sun = "") {
  return parse_scene(
      "[emission]\nlines = [17.1]\n[blur]\nwidth_deg = [0]\n"
      "[camera]\nwidth = 64\nheight = 64\nhfov_deg = 0.85\nazimuth_deg = 0\nelevation_deg = 45\n"
      "[sun]\nshown = true\nlatitude_deg = 5\nphotosphere_rayleigh = [200]\n" +
          more_of_sun +
          "[[chromosphere]]\nouterradius = 750\nscale = 150\noctaves = 2\nrayleigh = [5]\nextinction = 0.02\n"
          "step = 5\n"
          "[[loop]]\nlatitude_deg = 20\nlongitude_deg = 20\nheight = 250\nwidth = 300\nstrands = 20\n"
          "spread = 60\nstrand_radius = 20\nrayleigh = [10]\n"
          "[[loop]]\nname = \"grid\"\nlatitude_deg = -30\nlongitude_deg = -40\nheight = 200\nwidth = 250\n"
          "strands = 10\nspread = 60\nstrand_radius = 25\nvoxel = 8\nrayleigh = [10]\n"
          "[[bundle]]\ncount = 30\nlength = 500\nfoot_radius = 10\ntop_radius = 40\nrayleigh = [4]\n"
          "[[ejection]]\nlatitude_deg = 10\nlongitude_deg = 70\nspeed_km_s = 0\nstart_height = 300\n"
          "strands = 20\nrayleigh = [8]\n",
      "a.toml");
}

Image light(const Scene& scene) { return render(scene).rayleigh; }

double largest(const Image& image) {
  double most = 0.0;
  for (const float one : image.data) most = std::max(most, static_cast<double>(one));
  return most;
}

double off(const Image& a, const Image& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.data.size(); ++i)
    most = std::max(most, std::abs(static_cast<double>(a.data[i]) - b.data[i]));
  return most;
}

// A rigid Sun that has turned by an angle is the one that stands, seen from a longitude farther east by it.
TEST(SunRotation, IsTheViewFromAnotherLongitude) {
  Scene turned = a_sun("rotation = \"rigid\"\nrotation_frame = \"sidereal\"\n");
  turned.time.start_s = 25.38 * kDay_s * 25.0 / 360.0;
  Scene seen = a_sun();
  seen.sun.longitude_deg -= 25.0;
  const Image a = light(turned), b = light(seen);
  const double peak = largest(b);
  ASSERT_GT(peak, 100.0);
  // The grid's voxels are laid through the turned loop otherwise than through the other: a per cent or two of
  // its own light, which is a part of the peak.
  EXPECT_LT(off(a, b), 0.02 * peak);
  EXPECT_GT(off(light(a_sun()), b), 0.2 * peak) << "or nothing has turned";
  // Without it floats' rounding is left.
  turned.loops.pop_back();
  seen.loops.pop_back();
  EXPECT_LT(off(light(turned), light(seen)), 1e-4 * peak);
}

TEST(SunRotation, DoesNothingUnasked) {
  Scene scene = a_sun();
  const Image first = light(scene);
  scene.time.start_s = 3.0 * kDay_s;
  EXPECT_EQ(light(scene).data, first.data);
  scene = a_sun("rotation = \"differential\"\n");
  EXPECT_EQ(light(scene).data, first.data) << "longitudes are those of time 0";
}

TEST(SunRotation, GoesOnInPreviewsAsInRenders) {
  Scene scene = a_sun("rotation = \"differential\"\n");
  RenderMemory memory;
  RenderOptions keeping;
  keeping.memory = &memory;
  const Image first = render(scene, keeping).rayleigh;
  scene.time.start_s = 2.0 * kDay_s;
  const Image later = render(scene, keeping).rayleigh;
  EXPECT_EQ(later.data, light(scene).data);
  EXPECT_NE(later.data, first.data);
}

// An exposure of two days is the mean of its instants, also of clouds that hide the disc.
TEST(SunRotation, IsTheMeanOfInstantsInAnExposure) {
  Scene scene = a_sun("rotation = \"rigid\"\n");
  // Of two that move and hide each other the mean is not that of the pictures: clouds alone here.
  scene.loops.clear();
  scene.bundles.clear();
  scene.ejections.clear();
  scene.time.start_s = 1000.0;
  scene.time.exposure_s = 2.0 * kDay_s;
  scene.time.instants = 4;
  const Image exposed = light(scene);
  Image mean = exposed;
  std::fill(mean.data.begin(), mean.data.end(), 0.0f);
  Scene one = scene;
  one.time.exposure_s = 0.0;
  one.time.instants = 1;
  for (int k = 0; k < 4; ++k) {
    one.time.start_s = 1000.0 + 0.5 * k * kDay_s;
    const Image at = light(one);
    for (std::size_t i = 0; i < mean.data.size(); ++i) mean.data[i] += at.data[i] / 4.0f;
  }
  EXPECT_LT(off(exposed, mean), 1e-5 * largest(mean));
  one.time.start_s = 1000.0;
  EXPECT_GT(off(exposed, light(one)), 0.01 * largest(mean));
}

// What only shines adds up however it moves.
TEST(SunRotation, IsTheMeanOfInstantsForLoopsThatFlaresHeat) {
  for (const char* rotation : {"none", "differential"}) {
    Scene scene = a_sun("rotation = \"" + std::string(rotation) + "\"\n");
    scene.chromospheres.clear();
    scene.loops[0].heating_interval_s = 20000.0;
    scene.time.exposure_s = 40000.0;
    scene.time.instants = 4;
    const Image exposed = light(scene);
    Image mean = exposed;
    std::fill(mean.data.begin(), mean.data.end(), 0.0f);
    Scene one = scene;
    one.time.exposure_s = 0.0;
    one.time.instants = 1;
    for (int k = 0; k < 4; ++k) {
      one.time.start_s = 10000.0 * k;
      const Image at = light(one);
      for (std::size_t i = 0; i < mean.data.size(); ++i) mean.data[i] += at.data[i] / 4.0f;
    }
    EXPECT_LT(off(exposed, mean), 1e-5 * largest(mean)) << rotation;
    one.time.start_s = 0.0;
    EXPECT_GT(off(exposed, light(one)), 0.01 * largest(mean)) << rotation;
  }
}

}  // namespace
}  // namespace vegard::sim::sun_rotation_test
