#include "sim/view/sky/planets.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/view/sky/star_place.h"

namespace vegard::tests::planets_test {
namespace {

double jd(const char* utc) { return *sim::julian_date(utc); }

/// Ecliptic longitude, of the equinox J2000, in degrees.
double longitude_deg(const sim::Equatorial& place) {
  const double a = place.right_ascension_deg * sim::kRadiansPerDegree,
               d = place.declination_deg * sim::kRadiansPerDegree, e = 23.43928 * sim::kRadiansPerDegree;
  return std::atan2(std::sin(a) * std::cos(e) + std::tan(d) * std::sin(e), std::cos(a)) /
         sim::kRadiansPerDegree;
}

// Meeus, Astronomical Algorithms, example 33.a: Venus on 1992 December 20, 0 h of dynamical time (59 s before
// UTC): apparent place 21 h 04 min 41.50 s, -18 degrees 53' 16.8". The elements' errors are 20 seconds of arc
// for Venus and the Earth as the Sun sees them; Venus was 0.91 astronomical units away.
TEST(Planets, VenusIsWhereMeeusHasIt) {
  sim::CataloguePlace venus;
  const double when = jd("1992-12-19T23:59:01Z");
  venus.j2000 = sim::place_of_planet(sim::Planet::venus, when);
  EXPECT_LT(sim::separation_deg(sim::apparent_place(venus, when), {316.17291, -18.88801}), 0.02);
}

// Transits (F. Espenak, NASA, Six Millennium Catalog of Venus Transits; Seven Century Catalog of Mercury
// Transits): seen from the Earth's centre, Venus was 554.4 seconds of arc from the Sun's middle on 2012 June
// 6 at 01:30 UT, and Mercury 75.9 on 2019 November 11 at 15:20 UT. In a transit Venus is 0.29 units away and
// 20 seconds as the Sun sees it are 50 as the Earth does.
TEST(Planets, TransitsCrossTheSun) {
  const double venus = jd("2012-06-06T01:30:00Z"), mercury = jd("2019-11-11T15:20:00Z");
  EXPECT_NEAR(sim::separation_deg(sim::place_of_planet(sim::Planet::venus, venus), sim::place_of_sun(venus)),
              554.4 / 3600.0, 0.03);
  EXPECT_NEAR(
      sim::separation_deg(sim::place_of_planet(sim::Planet::mercury, mercury), sim::place_of_sun(mercury)),
      75.9 / 3600.0, 0.03);
}

// The great conjunction of 2020 December 21: 6.1 minutes of arc apart at 18:20 UT, at 300.48 degrees of
// ecliptic longitude of that day's equinox, which is 300.19 of J2000's. Each may be 0.05 degrees off.
TEST(Planets, JupiterMeetsSaturn) {
  const double when = jd("2020-12-21T18:20:00Z");
  const sim::Equatorial jupiter = sim::place_of_planet(sim::Planet::jupiter, when),
                        saturn = sim::place_of_planet(sim::Planet::saturn, when);
  EXPECT_NEAR(longitude_deg(jupiter), 300.19 - 360.0, 0.06);
  EXPECT_NEAR(longitude_deg(saturn), 300.19 - 360.0, 0.06);
  EXPECT_NEAR(sim::separation_deg(jupiter, saturn), 0.102, 0.08);
  // A month before they were more than two degrees apart.
  EXPECT_GT(sim::separation_deg(sim::place_of_planet(sim::Planet::jupiter, when - 30.0),
                                sim::place_of_planet(sim::Planet::saturn, when - 30.0)),
            2.0);
}

// Places of VSOP87 by PyEphem 4.1.4 (astrometric, equinox J2000, the Earth's centre), in degrees: dates of
// long nights all over Jupiter's and Saturn's years.
TEST(Planets, StandWithinATenthOfADegreeOfVsop87) {
  struct Known {
    sim::Planet planet;
    double date, right_ascension_deg, declination_deg;
  };
  const Known known[] = {
      {sim::Planet::mercury, 2447892.50, 297.8349, -20.4940},
      {sim::Planet::mercury, 2450865.50, 333.8256, -12.9450},
      {sim::Planet::mercury, 2454135.75, 334.5867, -10.7681},
      {sim::Planet::mercury, 2457406.00, 289.7850, -18.7099},
      {sim::Planet::mercury, 2460676.25, 258.3608, -21.8522},
      {sim::Planet::mercury, 2464031.50, 324.2406, -14.9265},
      {sim::Planet::mercury, 2467301.75, 319.9277, -17.6343},
      {sim::Planet::venus, 2447892.50, 308.3451, -16.9453},
      {sim::Planet::venus, 2450865.50, 293.4326, -15.8255},
      {sim::Planet::venus, 2454135.75, 340.9174, -9.6595},
      {sim::Planet::venus, 2457406.00, 262.6743, -21.9322},
      {sim::Planet::venus, 2460676.25, 329.8076, -13.8131},
      {sim::Planet::venus, 2464031.50, 4.6938, 0.7666},
      {sim::Planet::venus, 2467301.75, 292.4016, -20.6952},
      {sim::Planet::mars, 2447892.50, 248.1326, -21.9468},
      {sim::Planet::mars, 2450865.50, 351.9929, -4.3282},
      {sim::Planet::mars, 2454135.75, 284.7469, -23.4268},
      {sim::Planet::mars, 2457406.00, 215.9542, -12.7040},
      {sim::Planet::mars, 2460676.25, 124.8336, 23.5971},
      {sim::Planet::mars, 2464031.50, 36.7370, 15.0593},
      {sim::Planet::mars, 2467301.75, 334.1731, -11.8211},
      {sim::Planet::jupiter, 2447892.50, 95.8193, 23.2144},
      {sim::Planet::jupiter, 2450865.50, 336.2124, -10.8642},
      {sim::Planet::jupiter, 2454135.75, 253.1890, -21.8357},
      {sim::Planet::jupiter, 2457406.00, 173.9477, 4.0557},
      {sim::Planet::jupiter, 2460676.25, 71.5326, 21.7434},
      {sim::Planet::jupiter, 2464031.50, 350.7684, -5.0824},
      {sim::Planet::jupiter, 2467301.75, 268.0114, -22.9684},
      {sim::Planet::saturn, 2447892.50, 287.0401, -22.2203},
      {sim::Planet::saturn, 2450865.50, 16.8194, 4.6443},
      {sim::Planet::saturn, 2454135.75, 144.8652, 15.3779},
      {sim::Planet::saturn, 2457406.00, 251.4909, -20.6913},
      {sim::Planet::saturn, 2460676.25, 346.1761, -8.0581},
      {sim::Planet::saturn, 2464031.50, 105.0918, 22.5329},
      {sim::Planet::saturn, 2467301.75, 226.1275, -14.8333},
  };
  for (const Known& one : known)
    EXPECT_LT(sim::separation_deg(sim::place_of_planet(one.planet, one.date),
                                  {one.right_ascension_deg, one.declination_deg}),
              0.06)
        << sim::name_of(one.planet) << ' ' << one.date;
}

// Meeus, example 41.a, by the expression of the Almanac since 1984: Venus on 1992 December 20, -4.2. At its
// opposition of 2018 June 27, rings wide open, Saturn had 0.0, in that of 2009 March 8, rings nearly closed,
// 0.5; at theirs of 2010 September 21 Jupiter -2.9 and of 2003 August 28 Mars -2.9 (calendars' figures, all
// to a tenth).
TEST(Planets, AreAsBrightAsPublished) {
  const auto magnitude = [](sim::Planet planet, const char* utc) {
    return sim::light_of_planet(planet, jd(utc)).magnitude;
  };
  EXPECT_NEAR(magnitude(sim::Planet::venus, "1992-12-20T00:00:00Z"), -4.2, 0.06);
  EXPECT_NEAR(magnitude(sim::Planet::saturn, "2018-06-27T13:00:00Z"), 0.0, 0.1);
  EXPECT_NEAR(magnitude(sim::Planet::saturn, "2009-03-08T20:00:00Z"), 0.5, 0.1);
  EXPECT_NEAR(magnitude(sim::Planet::jupiter, "2010-09-21T12:00:00Z"), -2.9, 0.1);
  EXPECT_NEAR(magnitude(sim::Planet::mars, "2003-08-28T18:00:00Z"), -2.9, 0.1);
}

// At the March equinox of 2024 (March 20, 03:06 UT) the Sun's apparent right ascension and declination are 0.
TEST(Planets, TheSunIsAtTheEquinox) {
  sim::CataloguePlace sun;
  const double when = jd("2024-03-20T03:06:00Z");
  sun.j2000 = sim::place_of_sun(when);
  EXPECT_LT(sim::separation_deg(sim::apparent_place(sun, when), {0.0, 0.0}), 0.02);
}

TEST(Planets, SeparationsAreAngles) {
  EXPECT_NEAR(sim::separation_deg({10.0, 90.0}, {200.0, 90.0}), 0.0, 1e-12);
  EXPECT_NEAR(sim::separation_deg({0.0, 0.0}, {90.0, 0.0}), 90.0, 1e-12);
  EXPECT_NEAR(sim::separation_deg({350.0, 0.0}, {10.0, 0.0}), 20.0, 1e-12);
}

}  // namespace
}  // namespace vegard::tests::planets_test
