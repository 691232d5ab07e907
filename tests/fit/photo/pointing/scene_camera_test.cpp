#include "fit/photo/pointing/scene_camera.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "fit/photo/pointing/calibration_tables.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/camera/camera.h"
#include "tests/support/star_field.h"

namespace vegard::tests::scene_camera_test {
namespace {

fit::Calibration calibrated(const fit::SkyCamera& truth, int radial) {
  fit::LensSettings settings;
  settings.start = truth;
  settings.model = truth.model;
  settings.form = fit::LensForm{truth.model, radial, false, false};
  return fit::calibrate(settings, star_field(truth, 20, 0.1, 6), {640, 480, true}, "stars");
}

// The file that is written, read as a scene, looks where the calibration looks; by the simulator's own
// camera.
TEST(CameraToml, IsTheCamera) {
  fit::SkyCamera fisheye = known_camera(sim::LensModel::polynomial, 160.0, 60.0, 87.0, 45.0);
  fisheye.mirrored = true;
  fisheye.numbers[fit::radial_1_number] = -0.04;
  const fit::SkyCamera pinhole = known_camera(sim::LensModel::pinhole, 500.0, 210.0, 30.0, 5.0);
  for (const auto& [truth, radial] : {std::pair(fisheye, 1), std::pair(pinhole, 0)}) {
    const fit::Calibration found = calibrated(truth, radial);
    fit::CalibrationOrigin origin;
    origin.stars = "stars.csv";
    origin.site_known = true;
    origin.site.latitude_deg = 78.148;
    origin.site.longitude_deg = 16.043;
    origin.site.altitude_m = 520.0;
    origin.site.time_utc = "2014-02-21T19:30:40Z";
    const sim::Scene scene = sim::parse_scene(fit::camera_toml(found, origin), "camera.toml");
    EXPECT_EQ(scene.site.latitude_deg, 78.148);
    EXPECT_EQ(scene.site.time_utc, origin.site.time_utc);
    for (const fit::StarSighting& star : found.stars) {
      double x = 0.0, y = 0.0, seen_x = 0.0, seen_y = 0.0;
      ASSERT_TRUE(fit::place_of_star(found.camera, star.enu, x, y));
      ASSERT_TRUE(sim::pixel_of_enu(sim::camera_view(scene.camera), star.enu.data(), seen_x, seen_y));
      EXPECT_NEAR(seen_x, x, 1e-7);
      EXPECT_NEAR(seen_y, y, 1e-7);
    }
    // And back, to go on from.
    const fit::SkyCamera again = fit::sky_camera_of(scene.camera, found.frame);
    for (int i = 0; i < fit::lens_numbers; ++i) EXPECT_NEAR(again.numbers[i], found.camera.numbers[i], 1e-9);
    EXPECT_LT((again.camera_from_enu - found.camera.camera_from_enu).norm(), 1e-12);
  }
}

TEST(CalibrationTables, SayWhatWasFound) {
  const fit::Calibration found =
      calibrated(known_camera(sim::LensModel::equisolid, 165.0, 200.0, 84.0, 12.0), 0);
  const auto json = nlohmann::json::parse(fit::calibration_json(found, {}));
  EXPECT_EQ(json["lens"], "equisolid");
  EXPECT_EQ(json["stars"].size(), 20u);
  EXPECT_EQ(json["correlation"].size(), 6u);
  EXPECT_DOUBLE_EQ(json["rms_px"], found.rms_px);
  const std::string csv = fit::residuals_csv(found);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 21);
  const std::string first = csv.substr(0, csv.find('\n'));
  const std::string second =
      csv.substr(first.size() + 1, csv.find('\n', first.size() + 1) - first.size() - 1);
  EXPECT_EQ(std::count(first.begin(), first.end(), ','), std::count(second.begin(), second.end(), ','));
}

}  // namespace
}  // namespace vegard::tests::scene_camera_test
