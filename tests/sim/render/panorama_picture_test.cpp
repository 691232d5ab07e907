// Pictures all around: every emitter's light is where a pinhole has it, across the seams and at the poles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/render/film.h"
#include "sim/render/render.h"
#include "sim/render/render_memory.h"
#include "sim/view/camera/camera.h"
#include "sim/view/camera/cube_map.h"
#include "tests/support/all_points.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::panorama_picture_test {
namespace {

/// A band to the north that stands up to the zenith, and a footprint beside it.
Scene scene_around(int height) {
  Scene scene = tests::small_scene();
  scene.camera.model = LensModel::equirectangular;
  scene.camera.width = 2 * height;
  scene.camera.height = height;
  scene.camera.azimuth_deg = 0.0;
  scene.camera.elevation_deg = 0.0;
  scene.camera.roll_deg = 0.0;
  scene.sheets[0].center_km = {10.0, 30.0};
  scene.blur.width_deg = {0.0, 0.0, 0.0};
  return scene;
}

Scene with_footprint(Scene scene) {
  Footprint footprint;
  footprint.east_km = {-250.0, -20.0, 40.0, 300.0};
  footprint.north_km = {40.0, 60.0, 90.0, -80.0};
  footprint.center_km = {0.0, 0.0};
  footprint.size_km = {700.0, 300.0};
  footprint.width_km = 6.0;
  scene.footprints.push_back(footprint);
  scene.sheets.clear();
  return scene;
}

/// Light within a Gaussian of some degrees about a direction, R sr: the sum over the pixels.
double light_about(const Scene& scene, const Image& rayleigh, const Direction& about, double sigma_deg,
                   int line) {
  const CameraView<double> view = camera_view(scene.camera);
  double middle[3], sum = 0.0;
  enu_of_direction(about, middle);
  for (int y = 0; y < rayleigh.height; ++y)
    for (int x = 0; x < rayleigh.width; ++x) {
      double enu[3];
      if (rayleigh.at(x, y, line) == 0.0f || !enu_of_pixel(view, x + 0.5, y + 0.5, enu)) continue;
      double distance2 = 0.0;
      for (int k = 0; k < 3; ++k) distance2 += (enu[k] - middle[k]) * (enu[k] - middle[k]);
      const double sigma = sigma_deg * kRadiansPerDegree;
      if (distance2 > 30.0 * sigma * sigma) continue;
      sum += rayleigh.at(x, y, line) * pixel_steradians(view.lens, x + 0.5, y + 0.5) *
             std::exp(-0.5 * distance2 / (sigma * sigma));
    }
  return sum;
}

TEST(PanoramaPicture, TheFilmHasTheLightOfAllPoints) {
  const Scene scene = scene_around(90);
  const EmissionPoints points = tests::all_points(scene);
  std::vector<double> sum(points.lines, 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto* enu = points.position_in_enu_km.data() + 3 * i;
    if (enu[2] < 0.0) continue;  // hidden by the Earth
    const double range2 = enu[0] * enu[0] + enu[1] * enu[1] + enu[2] * enu[2];
    for (int l = 0; l < points.lines; ++l)
      sum[l] += 1e-16 * points.photons_per_s[i * points.lines + l] / range2;
  }
  const Image rayleigh = render(scene).rayleigh;
  for (int l = 0; l < points.lines; ++l) {
    double light = 0.0;
    for (int y = 0; y < rayleigh.height; ++y) {
      const double top = kPi * (0.5 - static_cast<double>(y) / rayleigh.height),
                   bottom = kPi * (0.5 - (y + 1.0) / rayleigh.height);
      const double steradians = (std::sin(top) - std::sin(bottom)) * kTwoPi / rayleigh.width;
      for (int x = 0; x < rayleigh.width; ++x) light += rayleigh.at(x, y, l) * steradians;
    }
    EXPECT_GT(light, 1.0);
    // As tests/sim/render/lens_on_film_test.cpp: positions are floats.
    EXPECT_NEAR(sum[l] / light, 1.0, 3e-5) << l;
  }
}

// A bilinear splat spreads a sample over its four cells: a variance of at most 1/4 px^2 each way, of which a
// Gaussian of standard deviation s px about anything sees 1/8 s^-2 of its light, times its own curvature of
// at most 2; with s = 8 px (of the pinhole, which is the finer one: its pixels are smaller off its axis) less
// than 0.5 %.
TEST(PanoramaPicture, APinholeSeesTheSame) {
  for (const bool volume : {false, true}) {
    Scene around = volume ? with_footprint(scene_around(360)) : scene_around(360);
    if (!volume) around.sheets[0].center_km = {10.0, 90.0};
    Scene ahead = around;
    ahead.camera.model = LensModel::pinhole;
    ahead.camera.width = 240;
    ahead.camera.height = 200;
    ahead.camera.hfov_deg = 100.0;
    ahead.camera.azimuth_deg = 20.0;
    ahead.camera.elevation_deg = 50.0;
    const Image all = render(around).rayleigh, some = render(ahead).rayleigh;
    for (const Direction about : {Direction{0.0, 52.0}, Direction{20.0, 60.0}, Direction{10.0, 68.0}})
      for (int line = 0; line < 3; ++line) {
        const double by_pinhole = light_about(ahead, some, about, 4.0, line);
        EXPECT_GT(by_pinhole, 0.0);
        EXPECT_NEAR(light_about(around, all, about, 4.0, line) / by_pinhole, 1.0, 5e-3)
            << volume << ' ' << about.azimuth_deg << ' ' << line;
      }
  }
}

// Turned by a quarter the picture is the same, shifted by a quarter: what crosses an edge shows on both
// sides. The places are floats, so that some of a sample goes to its neighbour.
TEST(PanoramaPicture, HasNoSeam) {
  for (const bool volume : {false, true}) {
    Scene scene = volume ? with_footprint(scene_around(96)) : scene_around(96);
    scene.blur.width_deg = {2.0, 0.0, 0.0};
    const Image ahead = render(scene).rayleigh;
    for (const double turn_deg : {90.0, 180.0, 270.0}) {
      scene.camera.azimuth_deg = turn_deg;
      const Image turned = render(scene).rayleigh;
      const int shift = static_cast<int>(std::lround(turn_deg / 360.0 * ahead.width));
      float most = 0.0f;
      double worst = 0.0;
      for (int y = 0; y < ahead.height; ++y)
        for (int x = 0; x < ahead.width; ++x)
          for (int l = 0; l < 3; ++l) {
            const float here = ahead.at((x + shift) % ahead.width, y, l);
            most = std::max(most, here);
            worst = std::max(worst, std::abs(static_cast<double>(here) - turned.at(x, y, l)));
          }
      EXPECT_GT(most, 0.0f);
      EXPECT_LT(worst, 2e-3 * most) << volume << ' ' << turn_deg;
    }
  }
}

// With the zenith in the picture's middle it is a place like any other; with the zenith at the pole it has
// the same light. Within the splat's error, as above.
TEST(PanoramaPicture, ThePoleIsAPlaceLikeAnyOther) {
  Scene scene = scene_around(360);
  scene.sheets[0].center_km = {0.0, -20.0};  // its beams stand around the zenith
  const Image at_pole = render(scene).rayleigh;
  Scene in_middle = scene;
  in_middle.camera.elevation_deg = 90.0;
  const Image of_middle = render(in_middle).rayleigh;
  for (const Direction about : {Direction{0.0, 90.0}, Direction{100.0, 86.0}})
    for (int line = 0; line < 3; ++line) {
      const double expected = light_about(in_middle, of_middle, about, 4.0, line);
      EXPECT_GT(expected, 0.0);
      EXPECT_NEAR(light_about(scene, at_pole, about, 4.0, line) / expected, 1.0, 5e-3) << line;
    }
}

TEST(PanoramaPicture, ACubeIsSixPinholes) {
  Scene scene = scene_around(96);
  scene.blur = Blur();
  scene.camera.model = LensModel::cube;
  scene.camera.cube_layout = CubeLayout::grid;
  scene.camera.width = 120;
  scene.camera.height = 80;
  scene.camera.elevation_deg = 20.0;
  scene.airglow.green_rayleigh = 200.0;
  scene.stars.shown = true;
  RenderMemory memory;
  RenderOptions options;
  options.memory = &memory;
  const Rendering whole = render(scene, options);
  for (const CubeFace& face : cube_faces(scene.camera.cube_layout)) {
    Scene one = scene;
    one.camera = camera_of_face(scene.camera, face);
    const Rendering part = render(one);
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) {
        const int at_x = 40 * face.column + x, at_y = 40 * face.row + y;
        for (int l = 0; l < 3; ++l) ASSERT_EQ(whole.rayleigh.at(at_x, at_y, l), part.rayleigh.at(x, y, l));
        // The night sky's rays differ in their last bits.
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(whole.rgb.at(at_x, at_y, c), part.rgb.at(x, y, c),
                      1e-6f + 1e-5f * part.rgb.at(x, y, c));
      }
  }
}

}  // namespace
}  // namespace vegard::sim::panorama_picture_test
