#include "sim/view/sky/star_place.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/view/sky/bright_stars.h"

namespace vegard::tests::star_place_test {
namespace {

double degrees_of_hours(int hours, int minutes, double seconds) {
  return 15.0 * (hours + minutes / 60.0 + seconds / 3600.0);
}
double degrees_of(int degrees, int minutes, double seconds) {
  return degrees + minutes / 60.0 + seconds / 3600.0;
}

constexpr double kSecondOfArc = 1.0 / 3600.0;

TEST(Instant, JulianDatesOfMeeus) {
  EXPECT_DOUBLE_EQ(*sim::julian_date("1957-10-04T19:26:24Z"), 2436116.31);
  EXPECT_DOUBLE_EQ(*sim::julian_date("2000-01-01T12:00Z"), 2451545.0);
  EXPECT_DOUBLE_EQ(*sim::julian_date("1987-04-10 19:21:00"), 2446896.30625);
  EXPECT_NEAR(*sim::julian_date("1987-04-10T19:21:00.5Z") - 2446896.30625, 0.5 / 86400.0, 1e-9);
}

TEST(Instant, RefusesWhatIsNoInstant) {
  for (const char* text :
       {"", "2014-02-21", "2014-02-30T00:00Z", "2013-02-29T00:00Z", "2014-13-01T00:00Z", "2014-02-21T24:00Z",
        "2014-02-21T10:60Z", "2014-02-21T10:00:00.Z", "2014-02-21T10:00+15", "2014-02-21T10:00 CET"})
    EXPECT_FALSE(sim::julian_date(text)) << text;
  EXPECT_TRUE(sim::julian_date("2012-02-29T00:00Z"));
}

TEST(Instant, WordsAndBack) {
  for (const char* text :
       {"2012-11-12T21:47:03Z", "1999-12-31T23:59:59Z", "2000-02-29T00:00:00Z", "1969-07-20T20:17:40Z"})
    EXPECT_EQ(sim::text_of_julian_date(*sim::julian_date(text)), text);
}

// Meeus, examples 12.a and 12.b.
TEST(Instant, SiderealTimesOfMeeus) {
  EXPECT_NEAR(sim::mean_sidereal_time_deg(2446895.5), degrees_of_hours(13, 10, 46.3668),
              15e-4 * kSecondOfArc);
  EXPECT_NEAR(sim::mean_sidereal_time_deg(2446896.30625), 128.7378734, 1e-6);
}

// Meeus, examples 21.b and 23.a: theta Persei on 2028 November 13.19.
class ThetaPersei : public testing::Test {
 protected:
  ThetaPersei() {
    star.j2000 = {degrees_of_hours(2, 44, 11.986), degrees_of(49, 13, 42.48)};
    star.motion_ra_mas_per_year =
        0.03425 * 15e3 * std::cos(star.j2000.declination_deg * sim::kRadiansPerDegree);
    star.motion_dec_mas_per_year = -89.5;
  }
  sim::CataloguePlace star;
  const double julian_date = 2462088.69;
};

TEST_F(ThetaPersei, PrecessionAndProperMotion) {
  const sim::Equatorial place = sim::mean_place(star, julian_date);
  EXPECT_NEAR(place.right_ascension_deg, degrees_of_hours(2, 46, 11.331), 0.03 * kSecondOfArc);
  EXPECT_NEAR(place.declination_deg, degrees_of(49, 20, 54.54), 0.02 * kSecondOfArc);
}

TEST_F(ThetaPersei, NutationAndAberration) {
  const sim::Equatorial place = sim::apparent_place(star, julian_date);
  // 0.5 for the terms of nutation and 0.4 for the roundness of the Earth's orbit that are left out.
  EXPECT_NEAR(place.right_ascension_deg, degrees_of_hours(2, 46, 14.390), 1.3 * kSecondOfArc);
  EXPECT_NEAR(place.declination_deg, degrees_of(49, 21, 7.45), 0.9 * kSecondOfArc);
}

// Meeus, example 16.a, and the refraction of the setting sun's limb there.
TEST(Refraction, KnownValues) {
  EXPECT_NEAR(60.0 * sim::refraction_deg(33.246 / 60.0), 24.618, 0.005);
  EXPECT_NEAR(60.0 * sim::refraction_deg(90.0), 0.0, 0.003);
  EXPECT_NEAR(sim::refraction_deg(10.0, 505.0), 0.5 * sim::refraction_deg(10.0), 1e-12);
  EXPECT_EQ(sim::refraction_deg(-2.0), 0.0);
}

// Polaris circles about the pole, which stands due north at the observer's latitude.
TEST(DirectionOfStar, PolarisCirclesAboutThePole) {
  const sim::Observer observer{78.148, 16.043, 520.0, false};
  const sim::CataloguePlace polaris = sim::find_bright_star("Polaris")->place;
  const double latitude = observer.latitude_deg * sim::kRadiansPerDegree;
  for (const double julian_date : {2456244.0, 2456244.3, 2456244.7}) {
    const auto enu = sim::direction_of_star(polaris, observer, julian_date);
    const double to_pole = std::acos(enu[1] * std::cos(latitude) + enu[2] * std::sin(latitude));
    EXPECT_NEAR(to_pole / sim::kRadiansPerDegree,
                90.0 - sim::apparent_place(polaris, julian_date).declination_deg, 1e-6);
  }
}

// Meeus, example 13.b: Venus, given by its apparent place, from the US Naval Observatory on 1987 April 10,
// 19:21 UT.
TEST(DirectionOfStar, AzimuthAndElevationOfMeeus) {
  // The place whose apparent place at that instant is the example's, found by two corrections.
  const double julian_date = 2446896.30625;
  const sim::Equatorial wanted{degrees_of_hours(23, 9, 16.641), -degrees_of(6, 43, 11.61)};
  sim::CataloguePlace star;
  star.j2000 = wanted;
  for (int i = 0; i < 4; ++i) {
    const sim::Equatorial got = sim::apparent_place(star, julian_date);
    star.j2000.right_ascension_deg += wanted.right_ascension_deg - got.right_ascension_deg;
    star.j2000.declination_deg += wanted.declination_deg - got.declination_deg;
  }
  const sim::Observer observer{degrees_of(38, 55, 17.0), -degrees_of(77, 3, 56.0), 0.0, false};
  const auto enu = sim::direction_of_star(star, observer, julian_date);
  // Meeus counts azimuths from the south.
  const double azimuth = std::atan2(enu[0], enu[1]) / sim::kRadiansPerDegree;
  EXPECT_NEAR(azimuth + (azimuth < 0.0 ? 360.0 : 0.0), 68.0337 + 180.0, 2e-4);
  EXPECT_NEAR(std::asin(enu[2]) / sim::kRadiansPerDegree, 15.1249, 2e-4);
}

TEST(BrightStars, TableHoldsTheSky) {
  const auto& stars = sim::bright_stars();
  ASSERT_EQ(stars.size(), 921u);
  EXPECT_EQ(stars.front().name, "Sirius");
  for (std::size_t i = 1; i < stars.size(); ++i) EXPECT_LE(stars[i - 1].magnitude, stars[i].magnitude);
  for (const sim::BrightStar& star : stars) {
    EXPECT_GT(star.hip, 0);
    EXPECT_LE(star.magnitude, 4.5);
    EXPECT_LE(std::abs(star.place.j2000.declination_deg), 90.0);
    EXPECT_GE(star.place.j2000.right_ascension_deg, 0.0);
    EXPECT_LT(star.place.j2000.right_ascension_deg, 360.0);
  }
}

TEST(BrightStars, FoundByEveryName) {
  for (const char* words : {"Vega", "vega", "alf Lyr", "HIP 91262", "hip91262", "HD 172167"}) {
    ASSERT_NE(sim::find_bright_star(words), nullptr) << words;
    EXPECT_EQ(sim::find_bright_star(words)->name, "Vega") << words;
  }
  EXPECT_EQ(sim::find_bright_star("Wega"), nullptr);
  EXPECT_EQ(sim::find_bright_star(""), nullptr);
}

// Places at J2000 as the almanacs print them.
TEST(BrightStars, KnownPlaces) {
  const sim::Equatorial vega = sim::find_bright_star("Vega")->place.j2000;
  EXPECT_NEAR(vega.right_ascension_deg, degrees_of_hours(18, 36, 56.34), 0.5 * kSecondOfArc);
  EXPECT_NEAR(vega.declination_deg, degrees_of(38, 47, 1.3), 0.5 * kSecondOfArc);
  const sim::BrightStar& arcturus = *sim::find_bright_star("Arcturus");
  EXPECT_NEAR(arcturus.place.motion_ra_mas_per_year, -1093.4, 20.0);
  EXPECT_NEAR(arcturus.place.motion_dec_mas_per_year, -1999.4, 20.0);
}

}  // namespace
}  // namespace vegard::tests::star_place_test
