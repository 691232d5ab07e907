// The Moon's place against a longer series, its phases against a calendar.
#include "sim/view/sky/moon.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/view/sky/star_place.h"

namespace vegard::sim::moon_test {
namespace {

// Meeus, Astronomical Algorithms, example 47.a: 1992 April 12, 0 h dynamical time; apparent right ascension
// and declination, which hold 0.005 degrees of nutation more. The terms that are left out are below 0.004
// degrees each.
TEST(Moon, StandsWhereALongerSeriesHasIt) {
  const double date = 2448724.5;
  const MoonPlace moon = place_of_moon(date);
  EXPECT_NEAR(moon.longitude_deg, 133.162655, 0.01);
  EXPECT_NEAR(moon.latitude_deg, -3.229126, 0.01);
  EXPECT_NEAR(moon.parallax_deg, 0.991990, 0.0003);
  const Equatorial place = equatorial_place_of_moon(date);
  EXPECT_NEAR(place.right_ascension_deg, 134.688470, 0.015);
  EXPECT_NEAR(place.declination_deg, 13.768368, 0.015);
}

// Meeus, example 48.a, at the same instant: phase angle 69.0756 degrees, 0.6786 of the disc lit.
TEST(Moon, HasThePhaseOfAPublishedExample) {
  EXPECT_NEAR(phase_angle_of_moon_deg(2448724.5), 69.0756, 0.05);
  EXPECT_NEAR(0.5 * (1.0 + std::cos(phase_angle_of_moon_deg(2448724.5) * kRadiansPerDegree)), 0.6786, 0.0005);
}

// Krisciunas and Schaefer's fit of Allen's magnitudes: -12.73 at full, some 2.7 magnitudes fainter at the
// quarters.
TEST(Moon, IsAsBrightAsItsPhase) {
  EXPECT_DOUBLE_EQ(magnitude_of_moon(0.0), -12.73);
  EXPECT_NEAR(magnitude_of_moon(90.0), -10.13, 0.01);
  EXPECT_DOUBLE_EQ(magnitude_of_moon(-60.0), magnitude_of_moon(60.0));
}

// New and full moons of the U.S. Naval Observatory's calendar for 2014, and a first quarter.
TEST(Moon, ShinesByItsPhase) {
  EXPECT_LT(lit_share_of_moon(*julian_date("2014-03-30T18:45:00Z")), 0.005);
  EXPECT_GT(lit_share_of_moon(*julian_date("2014-03-16T17:08:00Z")), 0.995);
  EXPECT_NEAR(lit_share_of_moon(*julian_date("2014-03-08T13:27:00Z")), 0.5, 0.02);
}

// From the place where it is in the zenith it is there; a quarter of the Earth away it stands lower by its
// parallax.
TEST(Moon, IsSeenFromTheObserversPlace) {
  const double date = *julian_date("2014-03-16T17:08:00Z");
  const Equatorial place = equatorial_place_of_moon(date);
  Observer observer;
  observer.latitude_deg = place.declination_deg;
  observer.longitude_deg = place.right_ascension_deg - mean_sidereal_time_deg(date);
  EXPECT_NEAR(direction_of_moon(observer, date)[2], 1.0, 1e-12);
  observer.latitude_deg += 90.0;
  const std::array<double, 3> low = direction_of_moon(observer, date);
  EXPECT_NEAR(std::asin(low[2]) / kRadiansPerDegree, -place_of_moon(date).parallax_deg, 0.001);
  EXPECT_LT(low[1], -0.99);  // in the south
}

}  // namespace
}  // namespace vegard::sim::moon_test
