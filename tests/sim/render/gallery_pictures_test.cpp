// Blemishes of the gallery's pictures that a number can see, and that it sees where they are made on purpose.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/render/render.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/camera/camera.h"
#include "tests/support/source_folder.h"

namespace vegard::sim::gallery_pictures_test {
namespace {

/// How much the red light falls over three rows, upwards, over twice what it falls five rows lower or higher:
/// the largest ratio above the row of most light. A straight or an exponential fall gives at most 1.
double worst_step(Scene scene) {
  scene.camera.width = 4;
  scene.camera.height = 160;
  scene.camera.hfov_deg = 0.32;
  scene.camera.elevation_deg = -12.0;
  scene.stars.shown = false;
  for (Footprint& footprint : scene.footprints) footprint.face_cells = 256;
  const Image light = render(scene).rayleigh;
  std::vector<double> rows(light.height);
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x) rows[y] += light.at(x, y, 0) / light.width;
  const auto peak = static_cast<int>(std::max_element(rows.begin(), rows.end()) - rows.begin());
  EXPECT_GT(rows[peak], 100.0);
  constexpr int kRows = 3, kApart = 5;
  constexpr double kUnseen_rayleigh = 5.0;
  const auto fall = [&](int y) { return rows[y] - rows[y - kRows]; };
  double worst = 0.0;
  for (int y = kApart + kRows; y + kApart < peak; ++y) {
    const double beside = std::max(fall(y - kApart), fall(y + kApart));
    worst = std::max(worst, (fall(y) - kUnseen_rayleigh) / (2.0 * std::max(beside, kUnseen_rayleigh)));
  }
  return worst;
}

TEST(GalleryPictures, TheOvalsRedLightFadesUpwards) {
  Scene scene = read_scene(tests::source_folder() + "/data/gallery/footprint_orbit.toml");
  EXPECT_LT(worst_step(scene), 1.0);
  // The edge that this is about is seen: with light up to 300 km alone, it ends within a row.
  for (Footprint& footprint : scene.footprints) footprint.top_km = 300.0;
  EXPECT_GT(worst_step(scene), 1.5);
}

/// How much a row's green light goes up and down from pixel to pixel: the mean of |l - (left + right) / 2|
/// over the mean of l. A homogeneous arc is smooth over so few pixels.
double striation(const Scene& scene) {
  const Image light = render(scene).rayleigh;
  double ripple = 0.0, sum = 0.0;
  for (int y = 0; y < light.height; ++y)
    for (int x = 2; x + 2 < light.width; ++x) {
      ripple += std::abs(light.at(x, y, 1) - 0.5 * (light.at(x - 2, y, 1) + light.at(x + 2, y, 1)));
      sum += light.at(x, y, 1);
    }
  return ripple / sum;
}

TEST(GalleryPictures, TheHomogeneousArcsHaveNoRays) {
  Scene scene = read_scene(tests::source_folder() + "/data/gallery/arc_system.toml");
  // What the picture shows of the nearest arc above its middle, pixel for pixel.
  const double full_px = scene.camera.width;
  scene.camera.width = 160;
  scene.camera.height = 16;
  scene.camera.hfov_deg =
      2.0 * std::atan(160.0 / full_px * std::tan(0.5 * scene.camera.hfov_deg * kRadiansPerDegree)) /
      kRadiansPerDegree;
  scene.camera.elevation_deg = 56.0;
  scene.stars.shown = false;
  scene.sheets[0].arcs = 1;
  scene.sheets[0].length_km = 160.0;
  const double now = striation(scene);
  scene.sheets[0].beams_per_km = 80.0;  // as the form has it
  const double of_form = striation(scene);
  EXPECT_LT(now, 0.4 * of_form) << now << ' ' << of_form;
}

/// How unevenly a curtain shines along itself: the variance over the squared mean of the columns' green
/// light. Where it is folded, light of several walls adds up.
double fold_contrast(const Scene& scene) {
  const Image light = render(scene).rayleigh;
  double sum = 0.0, squares = 0.0;
  for (int x = 0; x < light.width; ++x) {
    double column = 0.0;
    for (int y = 0; y < light.height; ++y) column += light.at(x, y, 1);
    sum += column;
    squares += column * column;
  }
  return squares * light.width / (sum * sum) - 1.0;
}

TEST(GalleryPictures, TheDraperyHasFolds) {
  Scene scene = read_scene(tests::source_folder() + "/data/gallery/drapery.toml");
  scene.camera.width = 320;
  scene.camera.height = 213;
  scene.stars.shown = false;
  Sheet& curtain = scene.sheets[0];
  curtain.ray_contrast = curtain.ray_length_contrast = 0.0;
  const double folded = fold_contrast(scene);
  curtain.fold_spacing_km = 0.0;
  const double plain = fold_contrast(scene);
  curtain.fold_spacing_km = 26.0;  // as the form has them
  curtain.fold_length_km = 20.0;
  curtain.fold_stage = 0.9;
  curtain.fold_stage_spread = 0.5;
  const double of_form = fold_contrast(scene);
  // Without folds a curtain is unevenly bright too, as it is not equally far everywhere.
  EXPECT_GT(folded - plain, 3.0 * (of_form - plain)) << folded << ' ' << of_form << ' ' << plain;
}

Scene small_picture(const char* name, int width, int height) {
  Scene scene = read_scene(tests::source_folder() + "/data/gallery/" + name);
  scene.camera.width = width;
  scene.camera.height = height;
  scene.stars.shown = false;
  for (Sheet& sheet : scene.sheets) sheet.beams_per_km = 4.0, sheet.points_per_px = 0.0;
  return scene;
}

/// The least light of a row of the sky over that of the row above it, from 15 degrees up to the skyline, in
/// the panorama's part without arcs. Where the sky ends in a black strip it is next to nothing.
double darkest_step(const Scene& scene, const Rendering& picture) {
  const int width = scene.camera.width, height = scene.camera.height;
  double least = 1.0, above = 0.0;
  for (int y = height * 75 / 180; y < height / 2; ++y) {
    double sum = 0.0;
    int count = 0;
    for (int x = 0; x < width / 10; ++x) {
      const bool sky = picture.ground.empty() || picture.ground.at(x, y, 3) == 0.0f;
      for (int c = 0; c < 3 && sky; ++c) sum += picture.rgb.at(x, y, c);
      count += sky ? 1 : 0;
    }
    if (count < 5) break;
    if (above > 0.0) least = std::min(least, sum / count / above);
    above = sum / count;
  }
  return least;
}

TEST(GalleryPictures, TheSkyReachesTheHorizon) {
  Scene scene = small_picture("panorama.toml", 480, 240);
  EXPECT_GT(darkest_step(scene, render(scene)), 0.9);
  scene.ground.shown = false;  // and with it the light that the air scatters
  EXPECT_LT(darkest_step(scene, render(scene)), 0.5);
}

/// Snow cannot shine more than a white surface under this sky; it has a texture; and hills are darker than
/// the sky above them. `first`, `last`: rows of the near snow, in shares of the height.
void expect_a_landscape(const Scene& scene, double first, double last) {
  const GroundIllumination light = light_on_ground(scene);
  const Rendering picture = render(scene);
  double mean[3] = {}, near = 0.0, near_squared = 0.0;
  int count = 0, near_count = 0, hills = 0;
  for (int x = 0; x < scene.camera.width; ++x) {
    int skyline = scene.camera.height;
    for (int y = scene.camera.height - 1; y >= 0 && picture.ground.at(x, y, 3) == 1.0f; --y) {
      skyline = y;
      ++count;
      for (int c = 0; c < 3; ++c) mean[c] += picture.rgb.at(x, y, c);
      if (y < first * scene.camera.height || y > last * scene.camera.height) continue;
      ++near_count;
      near += picture.rgb.at(x, y, 1);
      near_squared += std::pow(picture.rgb.at(x, y, 1), 2);
    }
    ASSERT_GE(skyline, 3);
    if (picture.rgb.at(x, skyline, 1) < 0.7 * picture.rgb.at(x, skyline - 3, 1)) ++hills;
  }
  ASSERT_GT(near_count, 100);
  for (int c = 0; c < 3; ++c) {
    EXPECT_LT(mean[c] / count, light.rgb[c] / kPi) << c;
    EXPECT_GT(mean[c] / count, 0.5 * scene.ground.albedo * light.rgb[c] / kPi) << c;
  }
  near /= near_count;
  EXPECT_GT(std::sqrt(near_squared / near_count - near * near), 0.02 * near);
  EXPECT_GT(hills, scene.camera.width / 2);
}

TEST(GalleryPictures, SnowIsLitByTheSkyAboveIt) {
  expect_a_landscape(small_picture("panorama.toml", 360, 180), 0.53, 0.65);
  expect_a_landscape(small_picture("moonlit_snow.toml", 320, 213), 0.8, 1.0);
}

/// The brightest aurora within 2 degrees of the horizon over the brightest 8 to 15 degrees high.
double light_at_the_horizon(const Scene& scene) {
  const Image light = render(scene).rayleigh;
  const CameraView<double> view = camera_view(scene.camera);
  double low = 0.0, high = 0.0;
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x) {
      double enu[3];
      if (!enu_of_pixel(view, x + 0.5, y + 0.5, enu)) continue;
      const double elevation_deg = std::asin(enu[2]) / kRadiansPerDegree;
      const double green = light.at(x, y, 1);
      if (elevation_deg > 0.0 && elevation_deg < 2.0) low = std::max(low, green);
      if (elevation_deg > 8.0 && elevation_deg < 15.0) high = std::max(high, green);
    }
  return low / high;
}

TEST(GalleryPictures, ArcsFadeAtTheHorizonAndDoNotEndAboveIt) {
  for (const char* name : {"all_sky.toml", "spirals.toml", "panorama.toml"}) {
    const bool around = name == std::string("panorama.toml");
    Scene scene = small_picture(name, around ? 360 : 300, around ? 180 : 300);
    if (!around) scene.camera.focal_px /= 3.0;
    EXPECT_LT(light_at_the_horizon(scene), 0.2) << name;
    for (const Sheet& sheet : scene.sheets) {
      // The feet of the ends, 110 km high, are below the horizon.
      const double to_km = 0.5 * sheet.length_km;
      EXPECT_LT(110.0 / to_km, to_km / (2.0 * kEarthRadiusKm)) << name;
    }
    scene.air.model = AirModel::none;
    EXPECT_GT(light_at_the_horizon(scene), 0.4) << name;
  }
}

// Strands of a flux rope that hardly overlap cross each other as a fish's scales; those of the page on
// ejections do not.
TEST(GalleryPictures, TheFluxRopeHasNoScales) {
  Scene scene = parse_scene(
      "site = { altitude_m = 6e5 }\ncamera = { width = 80, height = 80, hfov_deg = 0.2, azimuth_deg = 178.9, "
      "elevation_deg = 40 }\nsensor = { response = \"grey\" }\nemission = { lines = [560.0] }\n"
      "blur = { width_deg = [0.0] }\ntime = { start_s = 3600 }\nsun = { shown = true, azimuth_deg = 180, "
      "elevation_deg = 40 }\n[[ejection]]\nkind = \"rope\"\nlongitude_deg = -75.0\nbearing_deg = 10.0\n"
      "speed_km_s = 500.0\nstrands = 300\nstrand_radius = 0.14\nrayleigh = [1e6]\n",
      "test");
  const auto scales = [&] {
    const Image light = render(scene).rayleigh;
    double ripple = 0.0, sum = 0.0;
    for (int y = 0; y < light.height; ++y)
      for (int x = 6; x + 6 < light.width; ++x) {
        ripple += std::abs(light.at(x, y, 0) - 0.5 * (light.at(x - 6, y, 0) + light.at(x + 6, y, 0)));
        sum += light.at(x, y, 0);
      }
    EXPECT_GT(sum, 0.0);
    return ripple / sum;
  };
  EXPECT_LT(scales(), 0.02);
  scene.ejections[0].strands = 60;
  scene.ejections[0].strand_radius = 0.1;
  EXPECT_GT(scales(), 0.05);
}

}  // namespace
}  // namespace vegard::sim::gallery_pictures_test
