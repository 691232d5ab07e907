#include "sim/view/sky/night_sky.h"

#include <algorithm>
#include <cmath>

#include "sim/base/parallel.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sky/sky_of_scene.h"

namespace vegard::sim {
namespace {

Vector3 times(double factor, Vector3 rgb) {
  for (double& channel : rgb) channel *= factor;
  return rgb;
}

}  // namespace

bool has_night_sky(const Scene& scene) {
  const Airglow& glow = scene.airglow;
  return glow.green_rayleigh > 0.0 || glow.red_rayleigh > 0.0 || glow.sodium_rayleigh > 0.0 ||
         scene.twilight.shown || scene.light_pollution.luminance_mcd_m2 > 0.0 || scene.moon.skylight;
}

bool night_sky_moves(const Scene& scene) {
  return scene.moon.skylight || (scene.twilight.shown && scene.twilight.sun == TwilightSun::of_time);
}

template <class T>
NightSky<T>::NightSky(const Scene& scene)
    : twilight_(twilight_at(scene)),
      moonlit_(scene),
      town_(scene.light_pollution),
      observer_km_(scene.site.altitude_m * 1e-3),
      lowest_sine_(sine_of_horizon(observer_km_)),
      air_(scene),
      town_luminance_(sky_number<T>(scene, sky_pollution)) {
  const double gain = scene.sky.lights_gain;
  for (const AirglowLayer& layer : kAirglowLayers)
    glows_.push_back({layer.altitude_km, sky_number<T>(scene, layer.brightness),
                      times(1e-3 * gain, line_colour(scene, layer.wavelength_nm)),
                      LineDepths<T>(layer.wavelength_nm, sky_number<T>(scene, sky_aerosol_depth),
                                    sky_number<T>(scene, sky_angstrom), scene.air.ozone_dobson)});
  if (twilight_.shown)
    twilight_rgb_ = times(gain, colour_of_continuum(scene, twilight_spectrum(twilight_.sun_elevation_deg)));
  const Spectrum lamps = black_body(town_.colour_temperature_k);
  town_rgb_ = times(1e-3 * gain / luminance_of_continuum(lamps), colour_of_continuum(scene, lamps));
}

template <class T>
std::array<T, 3> NightSky<T>::light(const SightLine<T>& line) const {
  std::array<T, 3> rgb = {T(0.0), T(0.0), T(0.0)};
  if (value_of(line.up) < lowest_sine_) return rgb;
  const auto add = [&](const T& brightness, const Vector3& colour) {
    for (int c = 0; c < 3; ++c) rgb[c] = rgb[c] + brightness * colour[c];
  };
  Airmasses<T> through{T(0.0), T(0.0), T(0.0)};
  if (!air_.none()) through = air_.towards(line.up);
  for (const Glow& glow : glows_)
    add(glow.rayleighs * van_rhijn(line.up, glow.altitude_km, observer_km_) *
            glow.depths.transmission(through),
        glow.rgb_per_rayleigh);
  if (twilight_.shown) add(twilight_gradient(line, twilight_), twilight_rgb_);
  add(town_luminance_ * light_pollution_share(line, town_), town_rgb_);
  if (!moonlit_.none()) {
    const std::array<T, 3> moonlit = moonlit_.light(line);
    for (int c = 0; c < 3; ++c) rgb[c] = rgb[c] + moonlit[c];
  }
  return rgb;
}

template class NightSky<double>;
template class NightSky<SkyDual>;

Image night_sky_light(const Scene& scene, int threads) {
  Image light(scene.camera.width, scene.camera.height, {"R", "G", "B"});
  FilmGeometry film;
  film.columns = light.width;
  film.rows = light.height;
  const NightSkyOnFilm<double> sky(scene, film);
  parallel_for(static_cast<std::size_t>(light.height), threads, [&](std::size_t row, int) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < light.width; ++x) {
      const std::array<double, 3> rgb = sky.light(x, y);
      for (int c = 0; c < 3; ++c) light.at(x, y, c) = static_cast<float>(rgb[c]);
    }
  });
  return light;
}

std::array<double, 3> sky_basis(double place) {
  const double p = place - 0.5;
  return {1.0, p, p * p - 1.0 / 12.0};
}

void add_sky(const Sky& sky, Image& rgb) {
  for (int y = 0; y < rgb.height; ++y) {
    const std::array<double, 3> basis = sky_basis((y + 0.5) / rgb.height);
    for (int c = 0; c < 3; ++c) {
      const double light = sky.level[c] * basis[0] + sky.gradient[c] * basis[1] + sky.curvature[c] * basis[2];
      for (int x = 0; x < rgb.width; ++x) rgb.at(x, y, c) += static_cast<float>(light);
    }
  }
}

double twilight_mag_arcsec2(const TwilightBand& band, double sun_elevation_deg) {
  const double x = 90.0 - sun_elevation_deg - 95.0;
  return band.a0 + (band.a1 + band.a2 * x) * x;
}

double radiance_of_mag_arcsec2(const TwilightBand& band, double mag_arcsec2) {
  constexpr double kArcsecPerRadian = 206264.80624709636;
  return band.zero_w_m2_nm * std::pow(10.0, -0.4 * mag_arcsec2) * kArcsecPerRadian * kArcsecPerRadian;
}

Spectrum twilight_spectrum(double sun_elevation_deg) {
  std::array<double, kTwilightBands.size()> log_radiance{};
  for (std::size_t i = 0; i < kTwilightBands.size(); ++i) {
    const TwilightBand& band = kTwilightBands[i];
    log_radiance[i] = std::log(radiance_of_mag_arcsec2(band, twilight_mag_arcsec2(band, sun_elevation_deg)) -
                               radiance_of_mag_arcsec2(band, band.night_mag));
  }
  return [=](double nm) {
    std::size_t i = 0;
    while (i + 2 < kTwilightBands.size() && kTwilightBands[i + 1].wavelength_nm < nm) ++i;
    const double t = (nm - kTwilightBands[i].wavelength_nm) /
                     (kTwilightBands[i + 1].wavelength_nm - kTwilightBands[i].wavelength_nm);
    return std::exp(log_radiance[i] + t * (log_radiance[i + 1] - log_radiance[i]));
  };
}

}  // namespace vegard::sim
