#include "fit/photo/pointing/star_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/view/sky/bright_stars.h"
#include "sim/view/sky/star_place.h"
#include "tests/support/expect_error.h"

namespace vegard::tests::star_table_test {
namespace {

const fit::SkyOfPicture kSky{sim::julian_date("2014-02-21T19:30:40Z"),
                             sim::Observer{78.148, 16.043, 520.0, true}};

std::string refused(const std::string& text, const fit::SkyOfPicture& sky = {}) {
  return expect_error(sim::ErrorKind::unreadable_input,
                      [&] { fit::parse_star_table(text, "stars.csv", sky); });
}

TEST(StarTable, AzimuthsAndElevations) {
  const auto stars = fit::parse_star_table(
      "# made by hand\nname,azimuth_deg,elevation_deg,x_px,y_px,magnitude\n\n\"A, "
      "B\",90,30,10.5,20.25,1.5\r\nC,0,90,1,2,\n",
      "stars.csv", {});
  ASSERT_EQ(stars.size(), 2u);
  EXPECT_EQ(stars[0].name, "A, B");
  EXPECT_EQ(stars[0].line, 4);
  EXPECT_NEAR(stars[0].enu[0], std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(stars[0].enu[1], 0.0, 1e-15);
  EXPECT_NEAR(stars[0].enu[2], 0.5, 1e-15);
  EXPECT_EQ(stars[0].x_px, 10.5);
  EXPECT_EQ(stars[0].magnitude, 1.5);
  EXPECT_TRUE(std::isnan(stars[1].magnitude));
  EXPECT_NEAR(stars[1].enu[2], 1.0, 1e-15);
}

TEST(StarTable, ZenithDistancesAndOtherOrigins) {
  const auto stars =
      fit::parse_star_table("azimuth_deg,zenith_deg,x_px,y_px\n0,60,1,1\n", "stars.csv", {}, 1.0);
  EXPECT_NEAR(stars[0].enu[2], 0.5, 1e-15);
  EXPECT_EQ(stars[0].x_px, 0.5);
  EXPECT_EQ(stars[0].y_px, 0.5);
}

TEST(StarTable, NamesAndRightAscensionsAgree) {
  const sim::BrightStar& vega = *sim::find_bright_star("Vega");
  const std::string ra = std::to_string(vega.place.j2000.right_ascension_deg / 15.0);
  const std::string dec = std::to_string(vega.place.j2000.declination_deg);
  const auto by_name = fit::parse_star_table("star,x_px,y_px\nHIP 91262,1,2\n", "stars.csv", kSky);
  const auto by_place =
      fit::parse_star_table("ra_hours,dec_deg,x_px,y_px\n" + ra + "," + dec + ",1,2\n", "s.csv", kSky);
  EXPECT_EQ(by_name[0].name, "Vega");
  EXPECT_EQ(by_name[0].magnitude, vega.magnitude);
  // But for the proper motion of fourteen years, 0.35 seconds of arc a year, and the hours' six decimals.
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(by_name[0].enu[i], by_place[0].enu[i], 14.2 * 0.36 / 206265.0);
}

TEST(StarTable, RefusesBadTables) {
  EXPECT_NE(refused("").find("empty table"), std::string::npos);
  EXPECT_NE(refused("azimuth_deg,zenith_deg\n1,2\n").find("x_px and y_px"), std::string::npos);
  EXPECT_NE(refused("x_px,y_px\n1,2\n").find("the stars are"), std::string::npos);
  EXPECT_NE(refused("x_px,y_px,x_px\n").find("two columns"), std::string::npos);
  const std::string head = "azimuth_deg,zenith_deg,x_px,y_px\n";
  EXPECT_NE(refused(head + "1,2,3\n").find("stars.csv:2: 3 cells"), std::string::npos);
  EXPECT_NE(refused(head + "1,2,3,nan\n").find("is no number"), std::string::npos);
  EXPECT_NE(refused(head + "1,2,3,4 px\n").find("is no number"), std::string::npos);
  EXPECT_NE(refused(head + "1,181,3,4\n").find("0 to 180"), std::string::npos);
  EXPECT_NE(refused("star,x_px,y_px\nWega,1,2\n", kSky).find("Vega"), std::string::npos);
  expect_error(sim::ErrorKind::usage,
               [] { fit::parse_star_table("star,x_px,y_px\nVega,1,2\n", "stars.csv", {}); });
  expect_error(sim::ErrorKind::unreadable_input, [] { fit::read_star_table("/nowhere/stars.csv", {}); });
}

TEST(StarTable, SemicolonsTabsAndCapitals) {
  for (const char* text : {"x_px;y_px;ra_deg;dec_deg\n646,6580;310,4019;213,9153;19,1824\n",
                           "x_px\ty_px\tra_deg\tdec_deg\n646.6580\t310.4019\t213.9153\t19.1824\n",
                           "X_PX,Y_PX,RA_DEG,DEC_DEG\n646.6580,310.4019,213.9153,19.1824\n"}) {
    const auto stars = fit::parse_star_table(text, "stars.csv", kSky);
    ASSERT_EQ(stars.size(), 1u) << text;
    EXPECT_EQ(stars[0].x_px, 646.658);
    const auto enu =
        sim::direction_of_star({{213.9153, 19.1824}, 0.0, 0.0}, *kSky.observer, *kSky.julian_date);
    EXPECT_EQ(stars[0].enu, enu) << text;
  }
}

TEST(StarTable, BytesOfZeroAreNoTable) {
  const std::string text("x_px,y_px,azimuth_deg,elevation_deg\n1,2,3,4\n\0\0\0\0", 48);
  EXPECT_NE(refused(text).find("stars.csv:3"), std::string::npos);
}

}  // namespace
}  // namespace vegard::tests::star_table_test
