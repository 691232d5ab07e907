// What a calibration takes from the picture, and what was told otherwise.
#include "fit/measurement/calibration_request.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit::calibration_request_test {
namespace {

sim::PictureMetadata phone() {
  sim::PictureMetadata m;
  m.width_px = 4000, m.height_px = 3000;
  m.focal_length_35mm_mm = 27.0, m.exposure_s = 30.0, m.iso = 1600.0;
  m.latitude_deg = 62.5, m.longitude_deg = -114.25, m.altitude_m = 170.0;
  m.taken_local = "2019-03-01T00:16:30.5", m.utc_offset = "-07:00";
  return m;
}

std::string paths_taken(const PictureSays& says) {
  std::string all;
  for (const PhotoFact& fact : says.taken) all += (all.empty() ? "" : " ") + fact.path;
  return all;
}

TEST(CalibrateMetadata, TimeAndPlaceAreTakenWhereNothingIsGiven) {
  const PictureSays says = with_metadata({}, {}, phone());
  EXPECT_EQ(paths_taken(says), "site.latitude_deg site.longitude_deg site.altitude_m site.time_utc");
  ASSERT_TRUE(says.sky.observer && says.sky.julian_date);
  EXPECT_EQ(says.sky.observer->latitude_deg, 62.5);
  EXPECT_EQ(says.sky.observer->longitude_deg, -114.25);
  EXPECT_EQ(says.sky.observer->height_m, 170.0);
  // The middle of the 30 s.
  EXPECT_NEAR(*says.sky.julian_date, *sim::julian_date("2019-03-01T07:16:45.5Z"), 1e-9);
  EXPECT_FALSE(says.camera);
  EXPECT_TRUE(says.notes.empty());
}

TEST(CalibrateMetadata, WhatIsGivenWins) {
  CalibrationRequest request;
  request.site = sim::Observer{65.0, 20.0};
  request.time = "2020-01-01T20:00:00Z";
  const PictureSays says = with_metadata(request, {}, phone());
  EXPECT_EQ(paths_taken(says), "");
  EXPECT_EQ(says.sky.observer->latitude_deg, 65.0);
  EXPECT_EQ(says.sky.observer->height_m, 0.0);  // not that of another place
  EXPECT_NEAR(*says.sky.julian_date, *sim::julian_date("2020-01-01T20:00:15Z"), 1e-9);
  request = {};
  request.no_metadata = true;
  const PictureSays none = with_metadata(request, {}, phone());
  EXPECT_FALSE(none.sky.observer || none.sky.julian_date);
}

TEST(CalibrateMetadata, AnEarlierCamerasSiteIsKeptAndItsTimeIsNot) {
  const sim::Scene earlier = sim::parse_scene(
      "[site]\nlatitude_deg = 65.0\nlongitude_deg = 20.0\ntime_utc = \"2020-01-01T20:00:00Z\"\n"
      "[camera]\nhfov_deg = 80.0\n",
      "earlier.toml");
  const PictureSays says = with_metadata({}, earlier, phone());
  EXPECT_EQ(paths_taken(says), "site.time_utc");
  EXPECT_EQ(says.sky.observer->latitude_deg, 65.0);
  // The middle of the 30 s.
  EXPECT_NEAR(*says.sky.julian_date, *sim::julian_date("2019-03-01T07:16:45.5Z"), 1e-9);
  EXPECT_EQ(says.camera->camera.hfov_deg, 80.0);
}

// 27 mm of a picture of 4 : 3: 0.8 of the diagonal is the width.
TEST(CalibrateMetadata, ARoughPointingTakesTheFocalLength) {
  const sim::Scene rough = sim::parse_scene("[camera]\nelevation_deg = 40.0\n", "rough.toml");
  const PictureSays says = with_metadata({}, rough, phone());
  // A fact has four places.
  EXPECT_NEAR(says.camera->camera.hfov_deg,
              2.0 * std::atan(0.8 * std::hypot(36.0, 24.0) / 2.0 / 27.0) / sim::kRadiansPerDegree, 1e-4);
  EXPECT_EQ(says.camera->camera.width, 4000);
  EXPECT_EQ(says.camera->camera.elevation_deg, 40.0);
  for (const char* words : {"focal_px = 900.0\nmodel = \"equidistant\"\n", "model = \"equidistant\"\n",
                            "width = 640\nheight = 480\n"}) {
    const sim::Scene other = sim::parse_scene(std::string("[camera]\n") + words, "other.toml");
    EXPECT_EQ(paths_taken(with_metadata({}, other, phone())).find("camera."), std::string::npos) << words;
  }
}

}  // namespace
}  // namespace vegard::fit::calibration_request_test
