// The sky's brightness while the sun is 5 to 15 degrees below the horizon.
#pragma once

#include <array>

#include "sim/base/number/dual.h"
#include "sim/view/sky/continuum_colour.h"
#include "sim/view/sky/sky_numbers.h"

namespace vegard::sim {

/// A photometric band: its wavelength; the flux density of magnitude 0 (Bessell, Castelli and Plez 1998,
/// A&A 333, 231, table A2); the twilight at the zenith as mag arcsec^-2 = a0 + a1 x + a2 x^2, with x the
/// sun's zenith distance minus 95 deg, from 0 to 10 (Patat, Ugolnikov and Postylyakov 2006,
/// doi:10.1051/0004-6361:20064992, table 1, at 2640 m); and the zenith of the dark night there (Patat 2003,
/// doi:10.1051/0004-6361:20030030).
struct TwilightBand {
  double wavelength_nm;
  double zero_w_m2_nm;
  double a0, a1, a2;
  double night_mag;
};

inline constexpr std::array<TwilightBand, 5> kTwilightBands = {{
    {366.0, 4.175e-11, 11.78, 1.376, -0.039, 22.3},  // U
    {438.0, 6.320e-11, 11.84, 1.411, -0.041, 22.6},  // B
    {545.0, 3.631e-11, 11.84, 1.518, -0.057, 21.6},  // V
    {641.0, 2.177e-11, 11.40, 1.567, -0.064, 20.9},  // R
    {798.0, 1.126e-11, 10.93, 1.470, -0.062, 19.7},  // I
}};

/// Returns the brightness of the zenith in mag arcsec^-2, including the dark night's.
double twilight_mag_arcsec2(const TwilightBand& band, double sun_elevation_deg);

/// Converts mag arcsec^-2 to W m^-2 sr^-1 nm^-1.
double radiance_of_mag_arcsec2(const TwilightBand& band, double mag_arcsec2);

/// Returns the spectrum of the zenith without that of the dark night, log-linear between the bands.
Spectrum twilight_spectrum(double sun_elevation_deg);

/// Returns the brightness over that of the zenith: contrast^(q^2) if q, the cosine of the angle to the
/// horizon below the sun, is positive, else 1. The formula is ours, chosen for its simplicity. T is double or
/// a dual number.
template <class T>
T twilight_gradient(const SightLine<T>& line, const Twilight& twilight) {
  const double azimuth = twilight.sun_azimuth_deg * kRadiansPerDegree;
  const T q = line.east * std::sin(azimuth) + line.north * std::cos(azimuth);
  if (value_of(q) <= 0.0) return T(1.0);
  return exponential(q * q * std::log(twilight.contrast));
}

}  // namespace vegard::sim
