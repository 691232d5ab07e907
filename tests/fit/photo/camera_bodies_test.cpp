// A made table in the form of Lensfun's database; and, where that is installed, a camera everybody knows.
#include "fit/photo/camera_bodies.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "fit/photo/picture_field_of_view.h"
#include "sim/base/number/constants.h"
#include "tests/support/expect_error.h"

namespace vegard::fit::camera_bodies_test {
namespace {

class CameraBodies : public testing::Test {
 protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() /
             ("vegard_bodies_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "b.xml") << R"(<!DOCTYPE lensdatabase SYSTEM "lensfun-database.dtd">
<lensdatabase version="1">
  <mount><name>Made</name></mount>
  <!-- <camera><maker>Made Corp.</maker><model>MADE 1</model><cropfactor>9</cropfactor></camera> -->
  <camera>
    <maker>Made Corporation</maker><maker lang="en">Made</maker>
    <model>Made  1</model><model lang="en">One</model><mount>Made</mount><cropfactor>1.5</cropfactor>
  </camera>
  <camera><maker>Made</maker><model>Made &amp; Two</model><cropfactor>2</cropfactor></camera>
  <camera><maker>Made</maker><model>Broken</model><cropfactor>0</cropfactor></camera>
  <camera><maker>Other</maker><model>Shared</model><cropfactor>3</cropfactor></camera>
  <camera><maker>Made</maker><model>Shared</model><cropfactor>4</cropfactor></camera>
</lensdatabase>)";
    std::ofstream(folder / "a.xml") << "<lensdatabase><camera>";  // not XML: passed over
    std::ofstream(folder / "c.txt") << "<lensdatabase/>";
    setenv("VEGARD_LENSFUN", folder.c_str(), 1);
  }
  void TearDown() override {
    unsetenv("VEGARD_LENSFUN");
    std::filesystem::remove_all(folder);
  }
  static sim::PictureMetadata picture(int width, int height) {
    sim::PictureMetadata m;
    m.make = "MADE CORPORATION", m.model = "MADE 1", m.focal_length_mm = 20.0;
    m.width_px = width, m.height_px = height;
    return m;
  }
  std::filesystem::path folder;
};

TEST_F(CameraBodies, AreFoundByMakeAndModel) {
  const auto body = find_camera_body(folder, "made corp", "MADE 1");
  ASSERT_TRUE(body);
  EXPECT_EQ(body->crop_factor, 1.5);
  EXPECT_EQ(find_camera_body(folder, "Made", "made & two")->crop_factor, 2.0);
  EXPECT_EQ(find_camera_body(folder, "MADE", "Shared")->crop_factor, 4.0);
  EXPECT_FALSE(find_camera_body(folder, "Made", "One"));  // the name that people say is not EXIF's
  EXPECT_FALSE(find_camera_body(folder, "Made", "Broken"));
  EXPECT_FALSE(find_camera_body(folder, "Another", "MADE 1"));
  EXPECT_FALSE(find_camera_body(folder, "Made", ""));
  EXPECT_FALSE(find_camera_body((folder / "none").string(), "Made", "MADE 1"));
}

// A crop factor of 1.5 on 3:2 is a sensor of 24 mm x 16 mm: 20 mm see 2 atan(12 / 20) across its width.
TEST_F(CameraBodies, GiveAFieldOfView) {
  const PictureFieldOfView view = picture_field_of_view(picture(3000, 2000));
  ASSERT_TRUE(view.hfov_deg);
  EXPECT_NEAR(*view.hfov_deg, 2.0 * std::atan(12.0 / 20.0) / sim::kRadiansPerDegree, 1e-9);
  EXPECT_TRUE(tests::has_facts(view.source, "FocalLength 20 mm | Made  1 | crop factor 1.5 | Lensfun"));
  EXPECT_FALSE(view.rounding_deg);
  // What the picture itself says wins.
  sim::PictureMetadata told = picture(3000, 2000);
  told.focal_length_35mm_mm = 50.0;
  EXPECT_NEAR(*picture_field_of_view(told).hfov_deg, 2.0 * std::atan(18.0 / 50.0) / sim::kRadiansPerDegree,
              1e-9);
}

TEST_F(CameraBodies, SayWhatIsLacking) {
  EXPECT_NE(picture_field_of_view(picture(3200, 1800)).why_not.find("cut"), std::string::npos);
  sim::PictureMetadata cut = picture(2400, 1600);
  cut.exif_width_px = 4000, cut.exif_height_px = 3000;
  EXPECT_NE(picture_field_of_view(cut).why_not.find("cut"), std::string::npos);
  sim::PictureMetadata unknown = picture(3000, 2000);
  unknown.model = "Nobody's";
  const PictureFieldOfView none = picture_field_of_view(unknown);
  EXPECT_FALSE(none.hfov_deg);
  EXPECT_NE(none.why_not.find("has no Nobody's"), std::string::npos);
  unknown.focal_length_mm.reset();
  EXPECT_TRUE(tests::has_facts(picture_field_of_view(unknown).why_not, "how wide"));
  setenv("VEGARD_LENSFUN", "", 1);
  EXPECT_NE(picture_field_of_view(picture(3000, 2000)).why_not.find("liblensfun-data-v1"), std::string::npos);
}

TEST(LensfunItself, KnowsTheNikonD800) {
  if (lensfun_folder().empty()) GTEST_SKIP() << "Lensfun's database is not installed";
  const auto body = find_camera_body(lensfun_folder(), "NIKON CORPORATION", "NIKON D800");
  ASSERT_TRUE(body);
  EXPECT_NEAR(body->crop_factor, 1.0, 0.01);  // 35.9 mm x 24 mm
}

}  // namespace
}  // namespace vegard::fit::camera_bodies_test
