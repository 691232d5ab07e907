#include "fit/photo/photo_defaults.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fit/photo/picture_field_of_view.h"
#include "sim/base/number/constants.h"
#include "sim/scene/file/scene_toml.h"

namespace vegard::fit::photo_defaults_test {
namespace {

using sim::kRadiansPerDegree;

sim::PictureMetadata phone() {
  sim::PictureMetadata m;
  m.width_px = m.exif_width_px = 4000;
  m.height_px = m.exif_height_px = 3000;
  m.focal_length_mm = 4.0;
  m.focal_length_35mm_mm = 27.0;
  m.exposure_s = 30.0, m.f_number = 1.8, m.iso = 1600.0;
  m.latitude_deg = 62.416271, m.longitude_deg = -114.28894, m.altitude_m = 169.86;
  m.taken_local = "2019-03-01T00:16:30", m.gps_time_utc = "2019-03-01T07:16:01Z";
  return m;
}

std::vector<std::string> paths_of(const std::vector<PhotoFact>& facts) {
  std::vector<std::string> paths;
  for (const PhotoFact& fact : facts) paths.push_back(fact.path);
  return paths;
}

const PhotoFact* find(const std::vector<PhotoFact>& facts, const std::string& path) {
  const auto found =
      std::find_if(facts.begin(), facts.end(), [&](const PhotoFact& f) { return f.path == path; });
  return found == facts.end() ? nullptr : &*found;
}

bool mentions(const std::vector<std::string>& notes, const std::string& words) {
  return std::any_of(notes.begin(), notes.end(),
                     [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

sim::Scene parsed(const std::string& text) { return sim::parse_scene(text, "scene.toml"); }

// ---- the field of view ----

// Of a 3:2 picture the diagonal and the width say the same: 2 atan(18 mm / F).
TEST(PictureFieldOfView, OfThreeToTwoIsThatOfTheFrame) {
  sim::PictureMetadata m = phone();
  m.width_px = m.exif_width_px = 6000, m.height_px = m.exif_height_px = 4000;
  m.focal_length_35mm_mm = 17.0;
  EXPECT_NEAR(*picture_field_of_view(m).hfov_deg, 2.0 * std::atan(18.0 / 17.0) / kRadiansPerDegree, 1e-10);
  // The same picture made smaller sees as much.
  m.width_px = 600, m.height_px = 400;
  EXPECT_NEAR(*picture_field_of_view(m).hfov_deg, 2.0 * std::atan(18.0 / 17.0) / kRadiansPerDegree, 1e-10);
}

// The diagonal's angle is that of the film, whatever the shape.
TEST(PictureFieldOfView, KeepsTheAngleOfTheDiagonal) {
  const sim::PictureMetadata m = phone();
  const PictureFieldOfView view = picture_field_of_view(m);
  EXPECT_NEAR(std::atan(0.5 * std::hypot(4000, 3000) / *view.focal_px),
              std::atan(0.5 * std::hypot(36, 24) / 27.0), 1e-12);
  EXPECT_NEAR(std::tan(0.5 * *view.hfov_deg * kRadiansPerDegree) * *view.focal_px, 2000.0, 1e-9);
  EXPECT_NE(view.source.find("27 mm"), std::string::npos);
}

TEST(PictureFieldOfView, OfAPictureTurnedIsAcrossItsNewWidth) {
  sim::PictureMetadata m = phone();
  m.orientation = 6;
  m.width_px = 3000, m.height_px = 4000;
  EXPECT_DOUBLE_EQ(*picture_field_of_view(m).focal_px, *picture_field_of_view(phone()).focal_px);
  EXPECT_LT(*picture_field_of_view(m).hfov_deg, *picture_field_of_view(phone()).hfov_deg);
}

TEST(PictureFieldOfView, OfACutPictureIsNotKnown) {
  sim::PictureMetadata m = phone();
  m.height_px = 2250;  // 16:9 of it
  EXPECT_FALSE(picture_field_of_view(m).hfov_deg);
  EXPECT_NE(picture_field_of_view(m).why_not.find("cut"), std::string::npos);
  m.height_px = 2990;  // the rounding of a small picture
  EXPECT_TRUE(picture_field_of_view(m).hfov_deg);
}

// 6000 pixels on 24 mm behind a lens of 24 mm: 2 atan(1/2).
TEST(PictureFieldOfView, FollowsFromTheSensorsPixelsToo) {
  sim::PictureMetadata m = phone();
  m.focal_length_35mm_mm.reset();
  EXPECT_FALSE(picture_field_of_view(m).hfov_deg);
  m.width_px = 1500, m.height_px = 1000, m.exif_width_px = 6000, m.exif_height_px = 4000;
  m.focal_length_mm = 24.0, m.focal_plane_px_per_mm = 250.0;
  EXPECT_NEAR(*picture_field_of_view(m).hfov_deg, 2.0 * std::atan(0.5) / kRadiansPerDegree, 1e-10);
  std::swap(m.width_px, m.height_px);
  m.orientation = 8;
  EXPECT_NEAR(*picture_field_of_view(m).hfov_deg, 2.0 * std::atan(4000.0 / 6000.0 / 2.0) / kRadiansPerDegree,
              1e-10);
}

// ---- what is said ----

TEST(PhotoFacts, TimeIsThatOfTheClockWhereItsZoneIsKnown) {
  sim::PictureMetadata m = phone();
  EXPECT_EQ(find(photo_facts(m).facts, "site.time_utc")->value, "\"2019-03-01T07:16:01Z\"");
  EXPECT_TRUE(mentions(photo_facts(m).notes, "2019-03-01T00:16:30"));
  m.utc_offset = "-07:00";
  EXPECT_EQ(find(photo_facts(m).facts, "site.time_utc")->value, "\"2019-03-01T07:16:30Z\"");
  EXPECT_FALSE(mentions(photo_facts(m).notes, "zone"));
  m.utc_offset.reset(), m.gps_time_utc.reset();
  EXPECT_EQ(find(photo_facts(m).facts, "site.time_utc"), nullptr);
}

TEST(PhotoFacts, OfNothingAreNone) { EXPECT_TRUE(photo_facts({}).facts.empty()); }

// ---- what a scene takes ----

TEST(PhotoDefaults, AnEmptySceneTakesAll) {
  const PhotoDefaults defaults = with_photo_defaults(parsed("seed = 3\n"), phone());
  EXPECT_EQ(paths_of(defaults.taken),
            (std::vector<std::string>{"site.latitude_deg", "site.longitude_deg", "site.altitude_m",
                                      "site.time_utc", "camera.width", "camera.height", "camera.hfov_deg",
                                      "sensor.f_number", "sensor.iso", "time.exposure_s"}));
  const sim::Scene& scene = defaults.scene;
  EXPECT_EQ(scene.seed, 3u);
  EXPECT_EQ(scene.site.latitude_deg, 62.416271);
  EXPECT_EQ(scene.site.longitude_deg, -114.28894);
  EXPECT_EQ(scene.site.altitude_m, 169.86);
  EXPECT_EQ(scene.site.time_utc, "2019-03-01T07:16:01Z");
  EXPECT_EQ(scene.camera.width, 4000);
  EXPECT_EQ(scene.camera.height, 3000);
  EXPECT_NEAR(scene.camera.hfov_deg, *picture_field_of_view(phone()).hfov_deg, 5e-5);
  EXPECT_EQ(scene.time.exposure_s, 30.0);
  EXPECT_EQ(scene.sensor.iso, 1600.0);
  EXPECT_EQ(scene.sensor.f_number, 1.8);
}

TEST(PhotoDefaults, WhatTheFileGivesWins) {
  const sim::Scene given = parsed(
      "[site]\nlatitude_deg = 60.0\ntime_utc = \"2000-01-01\"\n[camera]\nfocal_length_mm = 20.0\n"
      "sensor_width_mm = 36.0\nheight = 300\n[time]\nexposure_s = 2.0\n[sensor]\niso = 800\nf_number = 4\n");
  const PhotoDefaults defaults = with_photo_defaults(given, phone());
  // A longitude goes with its latitude, a width with its height; two lengths gave the field of view.
  EXPECT_EQ(paths_of(defaults.taken), std::vector<std::string>{"site.altitude_m"});
  sim::Scene expected = given;
  expected.site.altitude_m = 169.86;
  EXPECT_EQ(sim::write_scene(defaults.scene), sim::write_scene(expected));
}

TEST(PhotoDefaults, WhatTheCommandLineGivesWins) {
  const PhotoDefaults defaults =
      with_photo_defaults(parsed(""), phone(), {"site.longitude_deg", "camera.hfov_deg", "sensor.iso"});
  EXPECT_EQ(find(defaults.taken, "site.latitude_deg"), nullptr);
  EXPECT_EQ(find(defaults.taken, "camera.hfov_deg"), nullptr);
  EXPECT_EQ(find(defaults.taken, "sensor.iso"), nullptr);
  EXPECT_NE(find(defaults.taken, "camera.width"), nullptr);
}

TEST(PhotoDefaults, APictureThatSaysNothingChangesNothing) {
  const sim::Scene scene = parsed("[camera]\nwidth = 300\n");
  sim::PictureMetadata m;
  m.width_px = 300, m.height_px = 200;
  const PhotoDefaults defaults = with_photo_defaults(scene, m);
  EXPECT_TRUE(defaults.taken.empty());
  EXPECT_TRUE(defaults.notes.empty());
  EXPECT_EQ(sim::write_scene(defaults.scene), sim::write_scene(scene));
}

// Of a picture without words only its size is known: that of the default camera is no news.
TEST(PhotoDefaults, ASizeThatIsThereAnywayIsNotTaken) {
  sim::PictureMetadata m;
  m.width_px = sim::Camera().width, m.height_px = sim::Camera().height;
  EXPECT_TRUE(with_photo_defaults(parsed(""), m).taken.empty());
  m.height_px = sim::Camera().height + 1;
  EXPECT_EQ(paths_of(with_photo_defaults(parsed(""), m).taken),
            (std::vector<std::string>{"camera.width", "camera.height"}));
}

// The field does not follow the place silently, nor does it silently stay.
TEST(PhotoDefaults, SayWhatBecomesOfTheMagneticField) {
  EXPECT_TRUE(mentions(with_photo_defaults(parsed(""), phone()).notes, "78 deg"));
  EXPECT_TRUE(mentions(with_photo_defaults(parsed("[field]\nmodel = \"dipole\"\n"), phone()).notes, "photograph's place"));
  EXPECT_TRUE(with_photo_defaults(parsed("[field]\ninclination_deg = 80\n"), phone()).notes.empty());
  EXPECT_TRUE(with_photo_defaults(parsed(""), phone(), {"field.inclination_deg"}).notes.empty());
  EXPECT_TRUE(with_photo_defaults(parsed("[site]\nlatitude_deg = 62\n"), phone()).notes.empty());
  EXPECT_EQ(with_photo_defaults(parsed(""), phone()).scene.field.inclination_deg,
            sim::Field().inclination_deg);
}

TEST(PhotoDefaults, ValuesOutsideOfTheLimitsAreLeftWithANote) {
  sim::PictureMetadata m = phone();
  m.altitude_m = 4e9, m.exposure_s = 1e6;
  const PhotoDefaults defaults = with_photo_defaults(parsed(""), m);
  EXPECT_EQ(find(defaults.taken, "site.altitude_m"), nullptr);
  EXPECT_EQ(find(defaults.taken, "time.exposure_s"), nullptr);
  EXPECT_EQ(defaults.scene.site.altitude_m, 0.0);
  EXPECT_TRUE(mentions(defaults.notes, "not taken: site.altitude_m = 4"));
  EXPECT_TRUE(mentions(defaults.notes, "not taken: time.exposure_s"));
}

}  // namespace
}  // namespace vegard::fit::photo_defaults_test
