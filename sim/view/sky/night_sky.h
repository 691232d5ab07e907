// The lights of the night sky that are known beforehand: airglow, twilight, light pollution. They add up in
// linear light behind the aurora, at the scene's own gain times sky.lights_gain.
#pragma once

#include <array>
#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/colour.h"
#include "sim/view/sky/air.h"
#include "sim/view/sky/sky_numbers.h"

namespace vegard::sim {

/// Whether the scene has any.
bool has_night_sky(const Scene& scene);

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
