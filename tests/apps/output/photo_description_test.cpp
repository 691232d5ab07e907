#include "apps/output/photo_description.h"

#include <gtest/gtest.h>

#include "apps/commands/commands.h"
#include "sim/scene/file/scene_toml.h"

namespace vegard::apps::photo_description_test {
namespace {

sim::PictureMetadata phone() {
  sim::PictureMetadata m;
  m.width_px = 4000, m.height_px = 3000;
  m.focal_length_35mm_mm = 27.0;
  m.exposure_s = 30.0, m.iso = 1600.0;
  m.latitude_deg = 62.5, m.longitude_deg = -114.25;
  m.gps_time_utc = "2019-03-01T07:16:01Z";
  m.make = "MAKER";
  return m;
}

/// The line of the text that begins like this.
std::string line_of(const std::string& text, const std::string& start) {
  const std::size_t at = text.find("\n" + start);
  return at == std::string::npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
}

TEST(StartScene, IsASceneWithThePicturesNumbers) {
  const sim::Scene scene = sim::parse_scene(start_scene("a.jpg", fit::photo_facts(phone())), "start.toml");
  EXPECT_EQ(scene.camera.width, 4000);
  EXPECT_EQ(scene.site.latitude_deg, 62.5);
  EXPECT_EQ(scene.site.longitude_deg, -114.25);
  EXPECT_EQ(scene.site.time_utc, "2019-03-01T07:16:01Z");
  EXPECT_EQ(scene.time.exposure_s, 30.0);
  EXPECT_EQ(scene.sensor.f_number, sim::Sensor().f_number);
  EXPECT_EQ(scene.camera.elevation_deg, sim::Camera().elevation_deg);
  EXPECT_EQ(scene.sheets.size(), 1u);
}

TEST(StartScene, OfNothingIsAllAssumed) {
  const std::string text = start_scene("a.jpg", {});
  EXPECT_NO_THROW(sim::parse_scene(text, "start.toml"));
  for (const char* key : {"latitude_deg", "hfov_deg", "azimuth_deg", "iso", "exposure_s", "center_km"})
    EXPECT_NE(line_of(text, key).find("assumed"), std::string::npos) << key;
}

TEST(StartScene, SaysOfEachValueWhereItComesFrom) {
  const std::string text = start_scene("a.jpg", fit::photo_facts(phone()));
  EXPECT_NE(line_of(text, "hfov_deg").find("# EXIF FocalLengthIn35mmFilm 27 mm"), std::string::npos);
  EXPECT_NE(line_of(text, "f_number").find("# assumed"), std::string::npos);
  EXPECT_NE(line_of(text, "inclination_deg").find("whatever the place"), std::string::npos);
}

// What a key cannot hold is told, and the scene can be read all the same; no name breaks out of its comment.
TEST(StartScene, SurvivesWhatItCannotHold) {
  sim::PictureMetadata m = phone();
  m.altitude_m = 3.9e9;
  const std::string text = start_scene("a\n[camera]\nwidth = 3\xff.jpg", fit::photo_facts(m));
  EXPECT_EQ(sim::parse_scene(text, "start.toml").camera.width, 4000);
  EXPECT_NE(line_of(text, "altitude_m = 0.0").find("the picture says 39"), std::string::npos);
}

TEST(Description, TellsWhatIsKnownAndNothingElse) {
  const std::string text = description_text("a.jpg", phone());
  for (const char* words : {"4000 x 3000", "MAKER", "27 mm", "30 s", "62.5 deg", "camera.hfov_deg = "})
    EXPECT_NE(text.find(words), std::string::npos) << words;
  for (const char* words : {"f-number", "lens", "altitude"})
    EXPECT_EQ(text.find(words), std::string::npos) << words;
}

}  // namespace
}  // namespace vegard::apps::photo_description_test
