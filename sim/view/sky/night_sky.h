// The lights of the night sky that are known beforehand: airglow, twilight, light pollution, moonlit air.
// They add up in linear light behind the aurora, at the scene's own gain times sky.lights_gain.
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
#include "sim/view/sky/air.h"
#include "sim/view/sky/moonlight.h"
#include "sim/view/sky/sky_numbers.h"

namespace vegard::sim {

/// The glow of a town beyond the horizon. Ours: a form with a free hand, not a calculation of scattered light
/// such as Garstang's (1986, doi:10.1086/131768).
///
/// Luminance over that at the horizon towards the town: exp(-sin e / sin h - cos e (1 - cos a) / s^2), with
/// the elevation e, the azimuth a from the town, and height h and spread s of [light_pollution]. Below the
/// horizontal it stays as it is there. T is double or a dual number.
template <class T>
T light_pollution_share(const SightLine<T>& line, const LightPollution& town) {
  const double azimuth = town.azimuth_deg * kRadiansPerDegree, spread = town.spread_deg * kRadiansPerDegree;
  const T towards = line.east * std::sin(azimuth) + line.north * std::cos(azimuth);
  // Straight up the root has no slope, and nothing depends on the azimuth.
  const T level = square_root(line.east * line.east + line.north * line.north + 1e-12);
  const T height =
      value_of(line.up) > 0.0 ? line.up * (-1.0 / std::sin(town.height_deg * kRadiansPerDegree)) : T(0.0);
  return exponential(height - (level - towards) * (1.0 / (spread * spread)));
}

/// A line of the airglow, of a thin shell around the Earth that shines evenly. Altitudes: Noll et al. 2025,
/// doi:10.5194/gmd-18-4353-2025 (PALACE).
struct AirglowLayer {
  double wavelength_nm, altitude_km;
  SkyNumber brightness;  ///< rayleighs at the zenith, above the air
};

inline constexpr std::array<AirglowLayer, 3> kAirglowLayers = {
    {{557.7, 97.0, sky_green}, {630.0, 250.0, sky_red}, {589.3, 92.0, sky_sodium}}};

/// How much longer a slanted line of sight stays in a thin shell than one to the zenith (van Rhijn 1921,
/// Publ. Astron. Lab. Groningen 31): 1 / sqrt(1 - ((R + observer) / (R + shell))^2 cos^2 elevation). 0 for an
/// observer above the shell. T is double or a dual number over it.
template <class T>
T van_rhijn(const T& sine_of_elevation, double shell_km, double observer_km) {
  if (observer_km >= shell_km) return T(0.0);
  const double ratio = (kEarthRadiusKm + observer_km) / (kEarthRadiusKm + shell_km);
  return 1.0 / square_root((sine_of_elevation * sine_of_elevation - 1.0) * (ratio * ratio) + 1.0);
}

/// Whether the scene has any.
bool has_night_sky(const Scene& scene);

/// Whether any of it follows the scene's time.
bool night_sky_moves(const Scene& scene);

/// Their light by the line of sight. T is double or SkyDual.
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
  Vector3 twilight_rgb_{}, town_rgb_{};  ///< at the zenith; per mcd m^-2 at the horizon
  T town_luminance_;
};

/// The same in the cells of a film, at their centres; dark where the lens has an image of nothing.
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

/// Of the scene's camera, at the pixels' centres.
Image night_sky_light(const Scene& scene, int threads = 0);

}  // namespace vegard::sim
