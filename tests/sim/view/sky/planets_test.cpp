#include "sim/view/sky/planets.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/view/sky/instant.h"

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
// ecliptic longitude of that day's equinox, which is 300.19 of J2000's. The elements' errors are 400 and 600
// seconds of arc.
TEST(Planets, JupiterMeetsSaturn) {
  const double when = jd("2020-12-21T18:20:00Z");
  const sim::Equatorial jupiter = sim::place_of_planet(sim::Planet::jupiter, when),
                        saturn = sim::place_of_planet(sim::Planet::saturn, when);
  EXPECT_NEAR(longitude_deg(jupiter), 300.19 - 360.0, 0.11);
  EXPECT_NEAR(longitude_deg(saturn), 300.19 - 360.0, 0.17);
  EXPECT_LT(sim::separation_deg(jupiter, saturn), 0.102 + 0.1);
  // A month before they were more than two degrees apart.
  EXPECT_GT(sim::separation_deg(sim::place_of_planet(sim::Planet::jupiter, when - 30.0),
                                sim::place_of_planet(sim::Planet::saturn, when - 30.0)),
            2.0);
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
