// Lists of stars as Astrometry.net has them.
#include "fit/photo/pointing/exchange/star_files.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/picture/fits_io.h"
#include "sim/view/sky/star_place.h"
#include "tests/support/expect_error.h"

namespace vegard::fit::star_files_test {
namespace {

TEST(StarFiles, ReadsTheListItWrites) {
  const std::vector<FoundStar> points = {{10.25, 20.5, 0.1, 5.0, 9.0}, {3.0, 4.0, 0.1, 8.0, 9.0}};
  const std::string bytes = encode_star_list(points, {640, 480, true});
  EXPECT_TRUE(is_star_list(bytes, "a.axy"));
  const sim::FitsTable table = sim::read_fits_table(bytes, "a.axy");
  EXPECT_EQ(table.columns.at("X")[0], 10.75);  // the first pixel's centre at 1
  const StarPoints list = read_star_list(bytes, "a.axy");
  ASSERT_EQ(list.points.size(), 2u);
  EXPECT_EQ(list.points[0].flux, 8.0);  // the brightest first
  EXPECT_EQ(list.points[1].x_px, 10.25);
  EXPECT_EQ(list.points[1].y_px, 20.5);
  EXPECT_EQ(list.frame.width_px, 640);
  EXPECT_TRUE(list.frame.known);
}

TEST(StarFiles, KnowsListsFromPairs) {
  EXPECT_FALSE(is_star_list("x_px,y_px\n1,2\n", "a.csv"));
  const std::string pairs = sim::encode_fits_table(
      {{"X", "", {1.0}}, {"Y", "", {1.0}}, {"field_x", "", {1.0}}, {"field_y", "", {1.0}}}, {});
  EXPECT_FALSE(is_star_list(pairs, "a.corr"));
  const std::string none = sim::encode_fits_table({{"X", "", {}}, {"Y", "", {}}}, {});
  tests::expect_error(sim::ErrorKind::unreadable_input, [&] { read_star_list(none, "a.axy"); });
  const std::string far = sim::encode_fits_table({{"X", "", {1e9}}, {"Y", "", {1.0}}}, {});
  tests::expect_error(sim::ErrorKind::unreadable_input, [&] { read_star_list(far, "a.axy"); });
}

// Pairs that are written are the stars that were read: through the sky and back.
TEST(StarFiles, ReadsThePairsItWrites) {
  const SkyOfPicture sky{sim::julian_date("2014-02-21T19:30:40Z"),
                         sim::Observer{78.148, 16.043, 520.0, true}};
  // An equidistant fisheye to the zenith, 15 pixels a degree from the middle of 2800 x 2800.
  std::string text = "azimuth_deg,elevation_deg,x_px,y_px\n";
  for (int i = 0; i < 24; ++i) {
    const double azimuth = 15.0 * i, zenith = 10.0 + 60.0 * ((i * 7) % 24) / 24.0,
                 a = azimuth * 3.14159265358979 / 180.0;
    text += std::to_string(azimuth) + "," + std::to_string(90.0 - zenith) + "," +
            std::to_string(1400.0 - 15.0 * zenith * std::sin(a)) + "," +
            std::to_string(1400.0 - 15.0 * zenith * std::cos(a)) + "\n";
  }
  const std::vector<StarSighting> stars = parse_star_table(text, "stars.csv", sky);
  LensSettings settings;
  const Calibration calibration = calibrate(settings, stars, {2800, 2800, true}, "stars.csv");
  const std::vector<StarSighting> again = solved_field(encode_star_pairs(calibration, sky), "a.corr", sky);
  ASSERT_EQ(again.size(), stars.size());
  for (std::size_t i = 0; i < stars.size(); ++i) {
    EXPECT_NEAR(again[i].x_px, stars[i].x_px, 1e-9);
    EXPECT_NEAR(again[i].y_px, stars[i].y_px, 1e-9);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(again[i].enu[k], stars[i].enu[k], 1e-9);
  }
}

}  // namespace
}  // namespace vegard::fit::star_files_test
