#include "fit/photo/pointing/map_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fit/photo/pointing/scene_camera.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_scene.h"

namespace vegard::tests::map_calibration_test {
namespace {

using sim::LensModel;

/// A whole sky, a little off the middle of the picture and a little off the zenith.
sim::Camera fisheye(LensModel model, double focal_px) {
  sim::Camera camera;
  camera.model = model;
  camera.width = static_cast<int>(4 * focal_px);
  camera.height = static_cast<int>(3 * focal_px);
  camera.focal_px = focal_px;
  camera.principal_x_px = 3.25;
  camera.principal_y_px = -1.5;
  camera.azimuth_deg = 40.0;
  camera.elevation_deg = 88.5;
  camera.roll_deg = 71.0;
  return camera;
}

fit::LensSettings only(LensModel model) {
  fit::LensSettings settings;
  settings.model = model;
  return settings;
}

/// Maps that the simulator makes of a camera give a camera that sees every one of their directions at the
/// pixel where it stands. 1e-3 px: the maps are floats, whose last bit at 360 degrees is 3e-5 degrees.
void expect_back(const sim::Camera& truth, const fit::LensSettings& settings) {
  const sim::DirectionMap map = sim::direction_map(truth);
  const fit::Calibration found = fit::calibrate_maps(settings, map, "maps");
  ASSERT_TRUE(found.maps);
  int somewhere = 0;
  for (const float elevation : map.elevation_deg) somewhere += std::isfinite(elevation) ? 1 : 0;
  EXPECT_GT(somewhere, 300);
  EXPECT_EQ(found.maps->pixels, somewhere);
  EXPECT_EQ(found.maps->without_image, 0);
  EXPECT_LT(found.maps->largest_px, 1e-3);
  EXPECT_EQ(found.used(), static_cast<int>(found.stars.size()));
  for (const std::string& warning : found.warnings) EXPECT_EQ(warning.find("reproduce"), std::string::npos);
  EXPECT_EQ(found.camera.model, truth.model);
  EXPECT_EQ(found.camera.mirrored, truth.mirrored);
  const sim::Camera camera = fit::scene_camera_of(found);
  EXPECT_NEAR(camera.principal_x_px, truth.principal_x_px, 1e-3);
  EXPECT_NEAR(camera.principal_y_px, truth.principal_y_px, 1e-3);
}

TEST(MapCalibration, GivesTheFisheyeBack) {
  sim::Camera truth = fisheye(LensModel::equisolid, 6.0);
  truth.mirrored = true;
  // Of all lenses, without being told which.
  expect_back(truth, {});
}

TEST(MapCalibration, GivesARadialPolynomialBack) {
  sim::Camera truth = fisheye(LensModel::polynomial, 33.0);
  truth.k1 = -0.03;
  truth.k2 = 0.004;
  expect_back(truth, only(LensModel::polynomial));
}

TEST(MapCalibration, GivesAPinholeBack) {
  sim::Camera truth = small_scene().camera;
  truth.roll_deg = -7.0;
  truth.k1 = -0.08;
  truth.p1 = 0.002;
  expect_back(truth, only(LensModel::pinhole));
}

// One pixel of the maps shifted by a degree: every pixel is looked at, not those of the grid alone.
TEST(MapCalibration, LooksAtEveryPixel) {
  sim::DirectionMap map = sim::direction_map(fisheye(LensModel::equidistant, 30.0));
  map.elevation_deg[map.index(61, 20)] -= 1.0f;
  const fit::Calibration found = fit::calibrate_maps(only(LensModel::equidistant), map, "maps");
  EXPECT_EQ(found.maps->largest_x, 61);
  EXPECT_EQ(found.maps->largest_y, 20);
  EXPECT_NEAR(found.maps->largest_px, 30.0 * 3.14159265 / 180.0, 1e-3);
  EXPECT_NEAR(found.maps->rms_px, found.maps->largest_px / std::sqrt(found.maps->pixels), 1e-4);
}

TEST(MapCalibration, FileSaysThatItIsOfMaps) {
  const fit::Calibration found = fit::calibrate_maps(
      only(LensModel::equidistant), sim::direction_map(fisheye(LensModel::equidistant, 30.0)), "maps");
  fit::CalibrationOrigin origin;
  origin.stars = "az.fits, el.fits";
  const std::string text = fit::camera_toml(found, origin);
  EXPECT_NE(text.find("# maps: az.fits, el.fits"), std::string::npos) << text;
  EXPECT_NE(text.find(fit::words_of(*found.maps)), std::string::npos) << text;
  EXPECT_EQ(text.find("star"), std::string::npos) << text;
}

TEST(MapCalibration, RefusesMapsThatTellNoCamera) {
  sim::DirectionMap map = sim::direction_map(fisheye(LensModel::equidistant, 30.0));
  // One column of the grid alone.
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      if (x < 60 || x > 64) map.elevation_deg[map.index(x, y)] = std::numeric_limits<float>::quiet_NaN();
  expect_words(sim::ErrorKind::unreadable_input, {"az.fits", "one line"},
               [&] { fit::calibrate_maps(only(LensModel::equidistant), map, "az.fits"); });
}

// Azimuths of one camera and elevations of another.
TEST(MapCalibration, SaysWhenNoCameraStandsForTheMaps) {
  sim::Camera tilted = fisheye(LensModel::equidistant, 30.0);
  tilted.elevation_deg = 70.0;
  sim::DirectionMap map = sim::direction_map(fisheye(LensModel::equidistant, 30.0));
  map.elevation_deg = sim::direction_map(tilted).elevation_deg;
  const fit::Calibration found = fit::calibrate_maps(only(LensModel::equidistant), map, "maps");
  EXPECT_GT(found.maps->largest_px, 1.0);
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_NE(found.warnings.back().find("reproduce"), std::string::npos);
}

}  // namespace
}  // namespace vegard::tests::map_calibration_test
