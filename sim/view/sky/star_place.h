// Where a catalogued star stands in the sky of a place and an instant.
//
// From the catalogue's place at J2000: proper motion; the Earth's yearly aberration (its orbit taken as a
// circle, 0.4 seconds of arc); precession by Lieske's angles of 1976 (Astronomy and Astrophysics 58, 1;
// Meeus, Astronomical Algorithms, formula 21.2), good to a second of arc for centuries about 2000; the four
// largest terms of nutation (0.5 seconds of arc; Meeus, chapter 22). Left out: parallax (below a second of
// arc), polar motion, the aberration of the Earth's rotation (0.3 seconds of arc), deflection of the
// vertical.
#pragma once

#include <array>

namespace vegard::sim {

/// Equatorial coordinates, in degrees.
struct Equatorial {
  double right_ascension_deg = 0.0;  ///< 0 to 360
  double declination_deg = 0.0;
};

/// A star as catalogues have it: equinox and epoch J2000.
struct CataloguePlace {
  Equatorial j2000;
  double motion_ra_mas_per_year = 0.0;  ///< times the cosine of the declination
  double motion_dec_mas_per_year = 0.0;
};

/// Mean place at the equinox and epoch of the instant: proper motion and precession.
Equatorial mean_place(const CataloguePlace& star, double julian_date);

/// Apparent place: the same with nutation and aberration.
Equatorial apparent_place(const CataloguePlace& star, double julian_date);

/// Where an observer stands. North and east are positive.
struct Observer {
  double latitude_deg = 0.0, longitude_deg = 0.0;
  double height_m = 0.0;
  bool refracting_air = true;  ///< the standard atmosphere over the observer's height
};

/// East, north, up, of length 1, of where the star is seen.
std::array<double, 3> direction_of_star(const CataloguePlace& star, const Observer& observer,
                                        double julian_date);

/// Where what stands in a direction (east, north, up, of length 1) is seen: lifted by the observer's air, if
/// that refracts.
std::array<double, 3> seen_through_air(const std::array<double, 3>& enu, const Observer& observer);

/// By how much air lifts what stands at the true elevation, in degrees: Saemundsson's formula (Sky and
/// Telescope 72, 1986, 70; Meeus, formula 16.4), good to 0.07 minutes of arc above 15 degrees, for air of
/// this pressure and temperature. 0 below -1 degree.
double refraction_deg(double true_elevation_deg, double pressure_hpa = 1010.0, double temperature_c = 10.0);

}  // namespace vegard::sim
