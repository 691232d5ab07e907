// The light behind the aurora: the polynomial of [sky]; and the modelled lights of the night sky (airglow,
// twilight, light pollution, scattered moonlight), added in linear light at the scene's gain times
// sky.lights_gain.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "sim/base/image.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sky/air.h"
#include "sim/view/sky/moonlight.h"
#include "sim/view/sky/sky_numbers.h"

namespace vegard::sim {

/// The glow of a town beyond the horizon. The formula is ours, chosen freely; it is not a calculation of
/// scattered light such as Garstang's (1986, doi:10.1086/131768).
///
/// Returns the luminance over that at the horizon towards the town: exp(-sin e / sin h - cos e (1 - cos a) /
/// s^2), with the elevation e, the azimuth a from the town, and height h and spread s of [light_pollution].
/// Below the horizontal the first term is 0. T is double or a dual number.
template <class T>
T light_pollution_share(const SightLine<T>& line, const LightPollution& town) {
  const double azimuth = town.azimuth_deg * kRadiansPerDegree, spread = town.spread_deg * kRadiansPerDegree;
  const T towards = line.east * std::sin(azimuth) + line.north * std::cos(azimuth);
  // At the zenith the root has no derivative, and nothing depends on the azimuth.
  const T level = square_root(line.east * line.east + line.north * line.north + 1e-12);
  const T height =
      value_of(line.up) > 0.0 ? line.up * (-1.0 / std::sin(town.height_deg * kRadiansPerDegree)) : T(0.0);
  return exponential(height - (level - towards) * (1.0 / (spread * spread)));
}

/// A line of the airglow, from a thin, uniform shell around the Earth. Altitudes: Noll et al. 2025,
/// doi:10.5194/gmd-18-4353-2025 (PALACE).
struct AirglowLayer {
  double wavelength_nm, altitude_km;
  SkyNumber brightness;  ///< rayleighs at the zenith, above the air
};

inline constexpr std::array<AirglowLayer, 3> kAirglowLayers = {
    {{557.7, 97.0, sky_green}, {630.0, 250.0, sky_red}, {589.3, 92.0, sky_sodium}}};

/// Returns the path through a thin shell over that at the zenith (van Rhijn 1921, Publ. Astron. Lab.
/// Groningen 31): 1 / sqrt(1 - ((R + observer) / (R + shell))^2 cos^2 elevation); 0 for an observer above the
/// shell. T is double or a dual number over it.
template <class T>
T van_rhijn(const T& sine_of_elevation, double shell_km, double observer_km) {
  if (observer_km >= shell_km) return T(0.0);
  const double ratio = (kEarthRadiusKm + observer_km) / (kEarthRadiusKm + shell_km);
  return 1.0 / square_root((sine_of_elevation * sine_of_elevation - 1.0) * (ratio * ratio) + 1.0);
}

/// True if the scene has any of these lights.
bool has_night_sky(const Scene& scene);

/// True if any of these lights depends on the scene's time.
bool night_sky_moves(const Scene& scene);

/// The sum of these lights for a line of sight. T is double or SkyDual.
template <class T>
class NightSky {
 public:
  explicit NightSky(const Scene& scene);

  /// Linear, signed RGB; dark below the observer's horizon.
  std::array<T, 3> light(const SightLine<T>& line) const;

 private:
  struct Glow {
    double altitude_km;
    T rayleighs;
    Vector3 rgb_per_rayleigh;
    LineDepths<T> depths;
  };
  Twilight twilight_;
  MoonlitSky moonlit_;
  LightPollution town_;
  double observer_km_, lowest_sine_;
  AirAbove air_;
  std::vector<Glow> glows_;
  Vector3 twilight_rgb_{}, town_rgb_{};  ///< twilight at the zenith; town per mcd m^-2 at the horizon
  T town_luminance_;
};

/// NightSky at the centres of a film's cells; dark outside of the lens's picture.
template <class T>
class NightSkyOnFilm {
 public:
  NightSkyOnFilm(const Scene& scene, const FilmGeometry& film) : film_(film), view_(scene), sky_(scene) {}

  std::array<T, 3> light(int column, int row) const {
    const double x = film_.x0_px + (column + 0.5) * film_.cell_width_px;
    const double y = film_.y0_px + (row + 0.5) * film_.cell_height_px;
    if (!view_.sees(x, y)) return {T(0.0), T(0.0), T(0.0)};
    return sky_.light(view_.at(x, y));
  }

 private:
  FilmGeometry film_;
  SkyView<T> view_;
  NightSky<T> sky_;
};

/// Returns the lights of the night sky in the scene's camera, at the pixels' centres.
Image night_sky_light(const Scene& scene, int threads = 0);

/// Returns the factors of the sky's level, gradient and curvature at a vertical position (0 top, 1 bottom):
/// 1, p and p^2 - 1/12 with p = place - 1/2, so that the level is the mean over the picture.
std::array<double, 3> sky_basis(double place);

/// Adds the sky to a linear RGB image, at the pixels' centres.
void add_sky(const Sky& sky, Image& rgb);

// The sky's brightness while the sun is 5 to 15 degrees below the horizon.

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
