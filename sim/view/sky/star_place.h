// The direction of a catalogued star in the sky of an observer at an instant; Julian dates and sidereal time.
//
// Corrections to the catalogue's place at J2000: proper motion; annual aberration (the Earth's orbit taken as
// a circle, 0.4 seconds of arc); precession by Lieske's angles of 1976 (Astronomy and Astrophysics 58, 1;
// Meeus, Astronomical Algorithms, formula 21.2), good to a second of arc for centuries about 2000; the four
// largest terms of nutation (0.5 seconds of arc; Meeus, chapter 22). Left out: parallax (below a second of
// arc), polar motion, the aberration of the Earth's rotation (0.3 seconds of arc), deflection of the
// vertical.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace vegard::sim {

/// Equatorial coordinates, in degrees.
struct Equatorial {
  double right_ascension_deg = 0.0;  ///< 0 to 360
  double declination_deg = 0.0;
};

/// The place of a star in a catalogue: equinox and epoch J2000.
struct CataloguePlace {
  Equatorial j2000;
  double motion_ra_mas_per_year = 0.0;  ///< times the cosine of the declination
  double motion_dec_mas_per_year = 0.0;
};

/// Returns the mean place at the equinox and epoch of the instant: with proper motion and precession.
Equatorial mean_place(const CataloguePlace& star, double julian_date);

/// Returns the apparent place: the mean place with nutation and aberration.
Equatorial apparent_place(const CataloguePlace& star, double julian_date);

/// The place of an observer. North and east are positive.
struct Observer {
  double latitude_deg = 0.0, longitude_deg = 0.0;
  double height_m = 0.0;
  bool refracting_air = true;  ///< refraction by the standard atmosphere above height_m
};

/// Returns the elevation of the observer's horizon: 0 on the ground, which is level round about a station up
/// to the height of the mountains (9 km); above, by the dip of the sphere's edge, acos(R / (R + h)).
double horizon_elevation_deg(const Observer& observer);

/// Returns the unit vector (east, north, up) in which the star is seen.
std::array<double, 3> direction_of_star(const CataloguePlace& star, const Observer& observer,
                                        double julian_date);

/// Returns the direction in which an object in a true direction is seen, raised by refraction if
/// refracting_air is true. Both are unit vectors (east, north, up).
std::array<double, 3> seen_through_air(const std::array<double, 3>& enu, const Observer& observer);

/// Returns the refraction at a true elevation in degrees: Saemundsson's formula (Sky and Telescope 72, 1986,
/// 70; Meeus, formula 16.4), good to 0.07 minutes of arc above 15 degrees, for air of this pressure and
/// temperature. 0 below -1 degree.
double refraction_deg(double true_elevation_deg, double pressure_hpa = 1010.0, double temperature_c = 10.0);

inline constexpr double kJ2000 = 2451545.0;  ///< Julian date of 2000 January 1, 12 h
inline constexpr double kDaysPerCentury = 36525.0;

/// Returns the Julian date, to 40 microseconds, of a UTC time in ISO 8601, "2014-02-21T19:30:40.5Z"; nothing
/// for any other text (sim/base/utc_time.h).
std::optional<double> julian_date(const std::string& utc);

/// Returns the UTC time of a Julian date as text, to the nearest second: "2014-02-21T19:30:40Z".
std::string text_of_julian_date(double julian_date);

/// Greenwich mean sidereal time in degrees, 0 to 360: Aoki et al. 1982 (Astronomy and Astrophysics 105, 359),
/// as in Meeus, Astronomical Algorithms, formula 12.4. UTC is used as UT1, from which it differs by at most
/// 0.9 s (13 seconds of arc).
double mean_sidereal_time_deg(double julian_date);

}  // namespace vegard::sim
