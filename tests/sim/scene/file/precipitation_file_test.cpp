#include "sim/scene/file/precipitation_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "sim/base/error.h"
#include "sim/base/picture/fits_io.h"
#include "sim/scene/structs/scene.h"
#include "tests/support/temporary_folder.h"

namespace vegard::sim::precipitation_file_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

std::vector<FitsKeyword> axes() {
  return {{"CTYPE1", "EAST", ""}, {"CUNIT1", "km", ""},    {"CRPIX1", 1.0, ""},  {"CRVAL1", -19.0, ""},
          {"CDELT1", 2.0, ""},    {"CTYPE2", "NORTH", ""}, {"CUNIT2", "km", ""}, {"CRPIX2", 2.0, ""},
          {"CRVAL2", 101.0, ""},  {"CDELT2", 2.0, ""}};
}

/// Three columns and two rows, three planes; light in the north-west and the south-east.
Image cube(float flux = 8.0f, float energy = 4.0f) {
  Image image(3, 2, {"1", "2", "3"});
  for (float& value : image.data) value = 0.0f;
  image.at(0, 0, 0) = flux;  // the upper row is the northern one
  image.at(0, 0, 1) = energy;
  image.at(2, 1, 0) = 2.0f;
  image.at(2, 1, 1) = 1.5f;
  image.at(1, 1, 0) = kNaN;
  image.at(1, 0, 0) = 1e-7f;  // too little to matter, and without an energy
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) image.at(x, y, 2) = -5.0f;
  return image;
}

class PrecipitationFile : public testing::Test {
 protected:
  PrecipitationMap read(const Image& image, const std::vector<FitsKeyword>& keywords) {
    tests::put(folder_ / "map.fits", encode_fits(image, keywords));
    return read_precipitation_map(folder_ / "map.fits");
  }
  std::string problem_of(const Image& image, const std::vector<FitsKeyword>& keywords) {
    try {
      read(image, keywords);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
      return error.details().problem + " | " + error.details().expected;
    }
    return "";
  }
  /// With one of the axes' keywords other than it should be.
  std::string problem_with(const std::string& name, const std::variant<std::string, double>& value) {
    std::vector<FitsKeyword> keywords = axes();
    for (FitsKeyword& keyword : keywords)
      if (keyword.name == name) keyword.value = value;
    return problem_of(cube(), keywords);
  }
  tests::TemporaryFolder folder_;
};

TEST_F(PrecipitationFile, HasItsCellsWhereTheHeaderPutsThem) {
  const PrecipitationMap map = read(cube(), axes());
  EXPECT_EQ(map.columns, 3);
  EXPECT_EQ(map.rows, 2);
  EXPECT_EQ(map.cell_km, 2.0);
  EXPECT_EQ(map.west_km, -20.0);
  EXPECT_EQ(map.south_km, 98.0) << "the middle of the second row is 101 km to the north";
  EXPECT_EQ(map.energy_flux_mw_m2, (std::vector<float>{0, 0, 2, 8, 0, 0}));
  EXPECT_EQ(map.energy_kev, (std::vector<float>{0, 0, 1.5, 4, 0, 0}));
  EXPECT_FALSE(map.site.has_value());
}

TEST_F(PrecipitationFile, SaysWhoseSiteItIs) {
  std::vector<FitsKeyword> keywords = axes();
  keywords.push_back({"SITELAT", 67.5, ""});
  EXPECT_NE(problem_of(cube(), keywords).find("SITELAT alone"), std::string::npos);
  keywords.push_back({"SITELONG", -20.25, ""});
  const PrecipitationMap map = read(cube(), keywords);
  ASSERT_TRUE(map.site.has_value());
  EXPECT_EQ(map.site->latitude_deg, 67.5);
  EXPECT_EQ(map.site->longitude_deg, -20.25);
  keywords.back().value = 1e9;
  EXPECT_NE(problem_of(cube(), keywords).find("SITELAT and SITELONG in degrees"), std::string::npos);
}

TEST_F(PrecipitationFile, RefusesWhatIsNoMap) {
  const auto has = [](const std::string& words, const char* part) {
    EXPECT_NE(words.find(part), std::string::npos) << words;
  };
  Image plane(3, 2, {"Y"});
  has(problem_of(plane, axes()), "one plane alone | a cube");
  has(problem_with("CTYPE1", "RA---TAN"), "CTYPE1 is 'RA---TAN' | CTYPE1 = 'EAST'");
  has(problem_with("CTYPE2", "EAST"), "CTYPE2 is 'EAST' | CTYPE2 = 'NORTH'");
  has(problem_with("CUNIT2", "m"), "CUNIT2 is 'm'");
  has(problem_with("CDELT1", 1.0), "cells of 1 by 2 km");
  has(problem_with("CDELT1", -2.0), "cells of -2 by 2 km");
  has(problem_with("CRPIX1", 1e9), "CRVAL1 and CRVAL2");
  has(problem_with("CRVAL1", 1e7), "CRVAL1 and CRVAL2 in km from the site");
  has(problem_of(cube(), {}), "CTYPE1 is ''");
  std::vector<FitsKeyword> without = axes();
  without.pop_back();
  has(problem_of(cube(), without), "there is no CDELT2");
  has(problem_of(cube(-1.0f), axes()), "an energy flux of -1 mW m-2 in the cell 1, 2");
  has(problem_of(cube(8.0f, 30.0f), axes()),
      "an energy of 30 keV in the cell 1, 2 | energies from 0.1 to 20");
  EXPECT_EQ(problem_of(cube(8.0f, kNaN), axes()), "") << "its energy is its neighbours'";
  tests::put(folder_ / "map.fits", "no FITS");
  EXPECT_THROW(read_precipitation_map(folder_ / "map.fits"), Error);
  EXPECT_THROW(read_precipitation_map(folder_ / "none.fits"), Error);
}

TEST_F(PrecipitationFile, OfAFootprintNamesTheKey) {
  Scene scene;
  scene.file = folder_ / "scene.toml";
  scene.footprints.emplace_back();
  scene.footprints[0].source = FootprintSource::precipitation;
  scene.footprints[0].file = "missing.fits";
  try {
    read_precipitation_maps(scene);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.details().key, "footprint.arc.file");
    EXPECT_NE(error.details().hint.find("scene's file"), std::string::npos);
  }
}

}  // namespace
}  // namespace vegard::sim::precipitation_file_test
