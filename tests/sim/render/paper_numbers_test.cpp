// Numbers that Baranoski et al. 2000 state, measured on the simulator; docs/physics.md has the rows. Those
// not here stand beside what they test: deflections and spread (rows B12, B14) in emit/aurora/fall_test.cpp,
// the distance of the boundaries (B2) in emit/aurora/sheet_test.cpp, an electron's collisions (B12)
// in light/electron_test.cpp, brightness (B21) in render/sheet_light_test.cpp, a form's light against
// altitude (B19) and the forms' heights and brightness (B20) in render/forms_on_film_test.cpp, the forms'
// other ranges (B20) in scene/forms_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/motion.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/light/sheet_profile.h"
#include "sim/render/beams/kernel_scene.h"
#include "sim/render/film.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/film/blur.h"
#include "tests/support/exposed.h"
#include "tests/support/kind_named.h"
#include "tests/support/small_scene.h"

namespace vegard::sim::paper_numbers_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

using tests::exposed;

// Section 3.1.1, equation (2): d_r = (D / n)(2 pi / lambda), so n increments are 2 pi D / lambda whatever n.
TEST(PaperNumbers, PhaseAfterAllPointsIsTwoPiDOverLambda) {
  for (const char* rule : {"literal", "tied"}) {
    for (int n : {7, 300}) {
      Sheet sheet;
      sheet.spacing_rule = tests::kind_named<SpacingRule>(rule);
      sheet.spacing_jitter = 0.0;
      sheet.beams = n;
      std::vector<BeamPlace> places(n);
      const LayerPlaces layer(sheet, 0, 1, 0.0);
      for (int first = 0; first < n; first += LayerPlaces::kSumEvery)
        layer.fill(first, std::min(LayerPlaces::kSumEvery, n - first), &places[first]);
      const double turns = sheet.length_km / sheet.wavelength_km;
      const double per_point = turns * (places[1].s_of_phase - places[0].s_of_phase);
      EXPECT_NEAR(per_point * n, turns, 1e-12) << rule;
      EXPECT_NEAR(turns * (places[n - 1].s_of_phase - places[0].s_of_phase), turns * (n - 1) / n, 1e-12)
          << rule;
    }
  }
}

// Section 3.2: "on average an electron with 10 keV ... can collide 300 times".
TEST(PaperNumbers, MeanCollisionsAreThoseOfTheFallingBeams) {
  Scene scene = parse_scene(
      "[[sheet]]\nmean_collisions = 300\npath_rule = 'random'\ncenter_km = [0, 200]\nlength_km = 10\nbeams = 200\nlayers = 1\n",
      "x.toml");
  // 200 beams of 299.67 +- 10 points each.
  EXPECT_NEAR(static_cast<double>(exposed(scene).deflection_points) / 200.0, 299.67,
              4 * 10.0 / std::sqrt(200.0));
}

/// The shape of the only sheet at a frame of an animation at 60 frames per second.
SheetShape<double> at_frame(Scene scene, int frame) {
  scene.time.start_s = frame / scene.time.frames_per_second;
  return shape_of(scene, 0, 0, instants_s(scene.time).front(), NoSeeds());
}

// Section 5, figure 18: 60 frames per second, an arc drifting at 2.5 km/s, curls moving at 8.5 km/s.
TEST(PaperNumbers, AnArcDriftsFortyTwoMetresAFrame) {
  Scene scene = tests::small_scene();
  ASSERT_EQ(scene.time.frames_per_second, 60.0);
  scene.sheets[0].drift_km_s = {0.0, -2.5};
  const double start = at_frame(scene, 0).center_north_km;
  EXPECT_NEAR(1000.0 * (start - at_frame(scene, 1).center_north_km), 41.7, 0.05);
  EXPECT_NEAR(start - at_frame(scene, 1200).center_north_km, 50.0, 1e-9);
  EXPECT_EQ(at_frame(scene, 1200).center_east_km, scene.sheets[0].center_km.east);
}

TEST(PaperNumbers, ASineTravelsAHundredAndFortyTwoMetresAFrame) {
  Scene scene = tests::small_scene();
  Sheet& sheet = scene.sheets[0];
  sheet.sine_speed_km_s = 8.5;
  sheet.bearing_deg = 90.0;
  const StretchOfSheet stretch = stretch_of(sheet, 0.0);
  // What stood at a place then stands that much further from the start now.
  const auto north_at = [&](int frame, double from_start_km) {
    BeamPlace place;
    place.s = place.s_of_phase = from_start_km / sheet.length_km;
    return beam_foot(at_frame(scene, frame), stretch, place, 0, sheet.layers, false).north_km;
  };
  for (double x : {0.0, 13.0, 40.0, 101.0}) {
    EXPECT_NEAR(north_at(1, x + 0.1417), north_at(0, x), 2e-5);
    EXPECT_NEAR(north_at(1200, x + 170.0), north_at(0, x), 1e-9);
  }
  EXPECT_GT(std::abs(north_at(1, 13.0) - north_at(0, 13.0)), 0.005);
}

TEST(PaperNumbers, CurlsTravelAHundredAndFortyTwoMetresAFrame) {
  Scene scene = tests::small_scene();
  Sheet& sheet = scene.sheets[0];
  sheet.curl_spacing_km = 8.0;
  sheet.curl_speed_km_s = 8.5;
  sheet.bearing_deg = 90.0;
  sheet.thickness_km = 0.0;  // a straight line but for its curls
  const StretchOfSheet stretch = stretch_of(sheet, 0.0);
  const auto foot = [&](int frame, double from_start_km) {
    Scene then = scene;
    then.time.start_s = frame / scene.time.frames_per_second;
    const double instant = instants_s(then.time).front();
    const LayerStructure structure{Folds(sheet, 0, scene.seed, instant, 0.0),
                                   Curls(sheet, 0, scene.seed, instant, 0.0)};
    BeamPlace place;
    place.s = place.s_of_phase = from_start_km / sheet.length_km;
    return beam_foot(at_frame(scene, frame), stretch, place, 0, sheet.layers, false, &structure);
  };
  double wound = 0.0, moved = 0.0;
  for (double x = 5.0; x < 200.0; x += 0.7) {
    const auto start = foot(0, x);
    for (const auto& [frame, travelled] : {std::pair(1, 0.1417), std::pair(1200, 170.0)}) {
      const auto later = foot(frame, x + travelled);
      // 0.1417 is rounded by 3.4e-5 km, and a curl shears by up to some three radians a radius.
      EXPECT_NEAR(later.east_km - start.east_km, travelled, frame == 1 ? 2e-4 : 1e-9) << x;
      EXPECT_NEAR(later.north_km, start.north_km, frame == 1 ? 2e-4 : 1e-9) << x;
    }
    wound = std::max(wound, std::abs(start.north_km - sheet.center_km.north));
    moved = std::max(moved, std::abs(foot(1, x).north_km - start.north_km));
  }
  EXPECT_GT(wound, 0.2) << "no curl: the test would pass without any";
  EXPECT_GT(moved, 0.05) << "the curls stand still";
}

// Section 4.3: sigma 4.75 and 2.0 px with supports of 21 by 21 and 5 by 5 px at 383 px and 35 degrees, none
// for the blue, normalised; "scaling of the image resolution or of the field-of-view implies proportional
// scaling".
TEST(PaperNumbers, BlurKernelsAreThePapersAndScale) {
  Scene scene;
  scene.blur.kernel = BlurKernelKind::paper;
  scene.camera.hfov_deg = 35.0;
  const auto expect_kernels = [&](int width, double hfov_deg, int red, int green) {
    scene.camera.width = width;
    scene.camera.hfov_deg = hfov_deg;
    const double scale = width / hfov_deg / (383.0 / 35.0);
    EXPECT_NEAR(blur_sigma_px(scene, 0), 4.75 * scale, 0.06 * scale);
    EXPECT_NEAR(blur_sigma_px(scene, 1), 2.0 * scale, 0.06 * scale);
    EXPECT_EQ(blur_sigma_px(scene, 2), 0.0);
    for (int l : {0, 1}) {
      const BlurKernel kernel = gaussian_kernel(blur_sigma_px(scene, l), blur_radius_px(scene, l));
      EXPECT_EQ(2 * kernel.radius() + 1, l == 0 ? red : green) << width << " px";
      const double sum =
          2.0 * std::accumulate(kernel.weights.begin(), kernel.weights.end(), 0.0) - kernel.weights[0];
      EXPECT_NEAR(sum, 1.0, 1e-6);
    }
  };
  expect_kernels(383, 35.0, 21, 5);
  expect_kernels(766, 35.0, 41, 9);
  expect_kernels(766, 70.0, 21, 5);
}

/// An even layer of light over the observer and to the north: arcs so close that their Gaussians add up to a
/// constant to 1 part in 10^12.
Scene plane_layer() {
  Scene scene;
  scene.camera.width = scene.camera.height = 40;
  scene.camera.hfov_deg = 8.0;
  scene.field.inclination_deg = 90.0;
  Sheet sheet;
  sheet.center_km = {0.0, 110.0};
  sheet.length_km = 60.0;
  sheet.arcs = 18;
  sheet.arc_spacing_km = 25.0;
  sheet.width_km = 30.0;
  sheet.thickness_km = 0.01;
  sheet.layers = 1;
  sheet.beams = 30000;
  sheet.path_step = 0.02;
  sheet.loss_cone_deg = 0.0;
  sheet.pitch_law = PitchLaw::constant;
  sheet.energy_flux_mw_m2 = 2.0;
  sheet.profile = ProfileKind::form;
  sheet.upper_km = 10.0;
  scene.sheets = {sheet};
  return scene;
}

// Section 3.4, equation of the unit: 1 R = 10^6 photons cm^-2 s^-1 per column, and "most intense when viewed
// at low elevation angles": by the secant of the angle at the layer.
TEST(PaperNumbers, APlaneLayerHasItsRayleighsAtTheZenithAndFollowsTheSecantAwayFromIt) {
  Scene scene = plane_layer();
  const Sheet& sheet = scene.sheets[0];
  const HeightProfile profile = sheet_profile(scene.emission.lines, scene, 0);
  const double flux = sheet.energy_flux_mw_m2 * sheet.width_km * std::sqrt(2.0 * kPi) / sheet.arc_spacing_km;
  const int top = static_cast<int>((sheet.top_km - HeightProfile::kBottomKm) / HeightProfile::kStepKm);
  const auto along = [&](double elevation_deg) {
    double sum = 0.0;
    for (int a = 0; a < top; ++a) {
      const double radius = kEarthRadiusKm + HeightProfile::altitude_km(a);
      const double sine = kEarthRadiusKm * std::cos(elevation_deg * kRadiansPerDegree) / radius;
      sum += 0.1 * HeightProfile::kStepKm * flux * profile.rate[a * profile.stride + 1] /
             std::sqrt(1.0 - sine * sine);
    }
    return sum;
  };
  EXPECT_NEAR(along(30.0) / along(90.0), 2.0, 0.1) << "the secant of 60 degrees, less the Earth's curvature";
  // Some 3000 beams or more stand in the picture; from seed to seed its mean scatters by half a per cent.
  for (double elevation : {90.0, 45.0, 30.0}) {
    scene.camera.elevation_deg = elevation;
    const Exposure exposure = exposed(scene);
    double seen = 0.0, expected = 0.0;
    for (int r = 4; r < 36; ++r)
      for (int c = 4; c < 36; ++c) {
        seen += exposure.rayleigh[exposure.cells() + r * 40 + c];
        expected += along(direction_of_pixel(scene.camera, c + 0.5, r + 0.5).elevation_deg);
      }
    EXPECT_NEAR(seen / expected, 1.0, 0.02) << elevation;
  }
}

// Section 4.1: the weights of the emitted rays. A point's light is its photons on the lens, which finer
// pixels only divide: the sum of R times a pixel's solid angle stays.
TEST(PaperNumbers, APointsLightDoesNotDependOnTheResolution) {
  const auto light = [](int scale) {
    Scene scene = tests::small_scene();
    scene.camera.width *= scale;
    scene.camera.height *= scale;
    Sheet& sheet = scene.sheets[0];
    sheet.center_km = {15.0, 190.0};
    sheet.length_km = 0.1;
    sheet.width_km = sheet.thickness_km = 0.01;
    sheet.layers = sheet.beams = 1;
    sheet.energy_flux_mw_m2 = 1e6;
    sheet.profile = ProfileKind::form;
    const Exposure exposure = exposed(scene);
    const double focal = 0.5 * scene.camera.width / std::tan(0.5 * scene.camera.hfov_deg * kRadiansPerDegree);
    double sum = 0.0;
    for (int r = 0; r < scene.camera.height; ++r)
      for (int c = 0; c < scene.camera.width; ++c) {
        const double x = c + 0.5 - 0.5 * scene.camera.width, y = r + 0.5 - 0.5 * scene.camera.height;
        const double cosine = focal / std::sqrt(focal * focal + x * x + y * y);
        sum += exposure.rayleigh[exposure.cells() + static_cast<std::size_t>(r) * scene.camera.width + c] *
               cosine * cosine * cosine / (focal * focal);
      }
    return sum;
  };
  const double once = light(1);
  EXPECT_GT(once, 0.0);
  // The bilinear splat puts light into pixels next to its own, whose solid angles differ in the third digit.
  EXPECT_NEAR(light(2) / once, 1.0, 1e-3);
  EXPECT_NEAR(light(4) / once, 1.0, 1e-3);
}

}  // namespace
}  // namespace vegard::sim::paper_numbers_test
