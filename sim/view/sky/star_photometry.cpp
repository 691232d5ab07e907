#include "sim/view/sky/star_photometry.h"

#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/illuminants.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/colour/radiometry.h"

namespace vegard::sim {
namespace {

constexpr double kMagnitude0_lx = 2.54e-6;
constexpr double kLuminanceNm = 557.7;
// Where sRGB's primaries are brightest to the eye, roughly: a star's channels are dimmed as these
// wavelengths.
constexpr std::array<double, 3> kChannelNm = {610.0, 550.0, 465.0};

}  // namespace

double colour_temperature_k(double colour_index) {
  return 4600.0 * (1.0 / (0.92 * colour_index + 1.7) + 1.0 / (0.92 * colour_index + 0.62));
}

double star_photons_cm2_s(double magnitude) {
  // A rayleigh is 1e6 / 4 pi photons per cm2, s and sr.
  static const double photons_of_magnitude_0 =
      kMagnitude0_lx / (4.0 * kPi * 1e-6 * luminance_cd_m2_per_rayleigh(kLuminanceNm));
  return photons_of_magnitude_0 * std::pow(10.0, -0.4 * magnitude);
}

std::array<double, 3> star_tint(double colour_index, const SensorResponse& response) {
  const double temperature = colour_temperature_k(colour_index);
  std::array<double, 3> channels{};
  double luminance = 0.0;
  constexpr double kStepNm = 5.0;
  for (double nm = response.first_nm(); nm <= response.last_nm(); nm += kStepNm) {
    const double power = black_body_power(nm, temperature);
    const Vector3 of_power = response.channels_of_power(nm);
    for (int i = 0; i < 3; ++i) channels[i] += power * of_power[i];
    luminance += power * colour_matching(nm)[1];
  }
  const Matrix3& to_rgb = response.rgb_from_channels();
  std::array<double, 3> rgb{};
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < 3; ++i) rgb[c] += to_rgb[c][i] * channels[i] / luminance;
  return rgb;
}

double luminance_per_photon(const Scene& scene) {
  return gain_per_kilorayleigh(scene) * 1e-3 * 4.0 * kPi * 1e-6;
}

StarExtinction::StarExtinction(const Scene& scene) : air_(scene) {
  for (const double nm : kChannelNm)
    depths_.emplace_back(nm, scene.air.aerosol_optical_depth, scene.air.angstrom_exponent,
                         scene.air.ozone_dobson);
}

std::array<double, 3> StarExtinction::towards(double sine_of_elevation) const {
  std::array<double, 3> let_through = {1.0, 1.0, 1.0};
  if (air_.none()) return let_through;
  for (int c = 0; c < 3; ++c) let_through[c] = depths_[c].transmission(air_.towards(sine_of_elevation));
  return let_through;
}

}  // namespace vegard::sim
