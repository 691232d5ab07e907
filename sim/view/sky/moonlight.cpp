#include "sim/view/sky/moonlight.h"

#include "sim/view/colour/colour.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sky/air.h"
#include "sim/view/sky/moon.h"
#include "sim/view/sky/sky_of_scene.h"

namespace vegard::sim {
namespace {

constexpr double kMoonColourK = 4950.0;            // of B - V = 0.92, as stars.h has it
constexpr double kNanolambert_cd_m2 = 1e-5 / kPi;  // 1 lambert is 1 / pi cd cm^-2
constexpr double kUsualExtinction_mag = 0.172;     // theirs, of Mauna Kea
constexpr double kMagnitudesPerDepth = 1.0857362047581296;

/// Returns the Moon's illuminance above the air: their I*, equation (20).
double moon_illuminance(double phase_angle_deg) {
  return std::pow(10.0, -0.4 * (magnitude_of_moon(phase_angle_deg) + 12.73 + 3.84));
}

Vector3 colour_of_scattered(const Scene& scene, double exponent) {
  const Spectrum moon = black_body(kMoonColourK);
  const Spectrum scattered = [=](double nm) { return moon(nm) * std::pow(nm / 550.0, -exponent); };
  Vector3 rgb = colour_of_continuum(scene, scattered);
  const double luminance = luminance_of_continuum(scattered);
  for (double& channel : rgb) channel /= luminance;
  return rgb;
}

}  // namespace

MoonlitSky::MoonlitSky(const Scene& scene) {
  if (!scene.moon.skylight) return;
  const double date = julian_date_at(scene, scene.time.start_s + 0.5 * scene.time.exposure_s);
  const Observer observer = observer_of(scene);
  moon_ = seen_through_air(direction_of_moon(observer, date), observer);
  if (moon_[2] <= 0.0 || !observer.refracting_air) return;  // set, or no air to scatter
  none_ = false;
  depth_ = kUsualExtinction_mag / kMagnitudesPerDepth;
  if (scene.air.model == AirModel::standard) {
    const AirAbove air(scene);
    const LineDepths<double> v(550.0, scene.air.aerosol_optical_depth, scene.air.angstrom_exponent,
                               scene.air.ozone_dobson);
    depth_ = -std::log(v.transmission(air.towards(1.0)));
  }
  const double light = kNanolambert_cd_m2 * moon_illuminance(phase_angle_of_moon_deg(date)) *
                       std::exp(-depth_ * moonlit_airmass(moon_[2])) * scene.sky.lights_gain;
  constexpr double kByMolecules = 4.0;
  of_molecules_ = colour_of_scattered(scene, kByMolecules);
  of_aerosol_ = colour_of_scattered(scene, scene.air.angstrom_exponent);
  for (int c = 0; c < 3; ++c) {
    of_molecules_[c] *= light;
    of_aerosol_[c] *= light;
  }
}

double moonlit_luminance_cd_m2(double phase_angle_deg, double from_moon_deg, double moon_elevation_deg,
                               double elevation_deg, double extinction_mag) {
  const double cosine = std::cos(from_moon_deg * kRadiansPerDegree);
  const double depth = extinction_mag / kMagnitudesPerDepth;
  const auto airmass = [](double elevation) {
    return moonlit_airmass(std::sin(elevation * kRadiansPerDegree));
  };
  return kNanolambert_cd_m2 * moon_illuminance(phase_angle_deg) *
         (moonlit_by_molecules(cosine) + moonlit_by_aerosol(cosine)) *
         std::exp(-depth * airmass(moon_elevation_deg)) * (1.0 - std::exp(-depth * airmass(elevation_deg)));
}

}  // namespace vegard::sim
