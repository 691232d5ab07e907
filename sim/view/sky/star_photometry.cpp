#include "sim/view/sky/star_photometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/colour/radiometry.h"

namespace vegard::sim {
namespace {

constexpr double kMagnitude0_lx = 2.54e-6;
constexpr double kLuminanceNm = 557.7;
// Wavelengths where sRGB's primaries are brightest to the eye, roughly: a star's channels are dimmed as
// these.
constexpr std::array<double, 3> kChannelNm = {610.0, 550.0, 465.0};

constexpr double kNormNm = 555.6, kVegaFlux_w_m2_nm = 3.44e-11, kVegaMagnitude = 0.03;
constexpr double kColourTerm = 0.07;

/// A point of the spectrum of the library's type of this B - V, over that at 555.6 nm.
struct SpectrumPoint {
  double colour_index, ratio;
};
struct SpectrumNode {
  double wavelength_nm, error;
  std::vector<SpectrumPoint> points;  ///< by increasing colour index
};

/// Returns the spectra of the types B2 IV, A0 IV, F8 IV and K0 III.
const std::array<SpectrumNode, 4>& spectrum_nodes() {
  static const std::array<SpectrumNode, 4> nodes = {{
      {427.8, 0.04, {{-0.20, 2.722}, {0.0, 2.225}, {0.52, 1.015}, {1.0, 0.596}}},
      {kNormNm, 0.02, {{0.0, 1.0}, {1.0, 1.0}}},
      {557.7, 0.02, {{0.0, 0.991}, {1.0, 1.005}}},
      {630.0, 0.03, {{0.0, 0.687}, {0.52, 0.829}, {1.0, 0.978}}},
  }};
  return nodes;
}

/// Interpolates linearly in the logarithm, and extrapolates beyond the ends.
double ln_ratio(const SpectrumNode& node, double colour_index) {
  const std::vector<SpectrumPoint>& points = node.points;
  std::size_t i = 0;
  while (i + 2 < points.size() && colour_index > points[i + 1].colour_index) ++i;
  const double share =
      (colour_index - points[i].colour_index) / (points[i + 1].colour_index - points[i].colour_index);
  return std::log(points[i].ratio) + share * std::log(points[i + 1].ratio / points[i].ratio);
}

/// Returns ln of the spectrum over a black body's at a node.
double ln_excess(const SpectrumNode& node, double colour_index, const Spectrum& black) {
  return ln_ratio(node, colour_index) - std::log(black(node.wavelength_nm) / black(kNormNm));
}

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
    const Vector3 per_power = response.channels_of_power(nm);
    for (int i = 0; i < 3; ++i) channels[i] += power * per_power[i];
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

double star_photons_cm2_s_nm(double magnitude, double colour_index, double wavelength_nm) {
  const Spectrum black = black_body(colour_temperature_k(colour_index));
  const std::array<SpectrumNode, 4>& nodes = spectrum_nodes();
  const double nm = std::clamp(wavelength_nm, nodes.front().wavelength_nm, nodes.back().wavelength_nm);
  std::size_t i = 0;
  while (i + 2 < nodes.size() && nm > nodes[i + 1].wavelength_nm) ++i;
  const double share = (nm - nodes[i].wavelength_nm) / (nodes[i + 1].wavelength_nm - nodes[i].wavelength_nm);
  const double excess = (1.0 - share) * ln_excess(nodes[i], colour_index, black) +
                        share * ln_excess(nodes[i + 1], colour_index, black);
  constexpr double kMagnitude = 0.4;
  const double w_m2_nm =
      kVegaFlux_w_m2_nm *
      std::pow(10.0, kMagnitude * (kVegaMagnitude - magnitude + kColourTerm * colour_index)) *
      black(wavelength_nm) / black(kNormNm) * std::exp(excess);
  constexpr double kMetresPerNm = 1e-9, kSquareCm = 1e4;
  return w_m2_nm * wavelength_nm * kMetresPerNm / kPlanckTimesLight_j_m / kSquareCm;
}

double star_flux_error(double wavelength_nm) {
  const std::array<SpectrumNode, 4>& nodes = spectrum_nodes();
  constexpr double kNear_nm = 5.0, kFar_nm = 30.0, kFarError = 0.10, kBeyondError = 0.12;
  const bool inside = wavelength_nm > nodes.front().wavelength_nm - kNear_nm &&
                      wavelength_nm < nodes.back().wavelength_nm + kNear_nm;
  double error = inside ? kFarError : kBeyondError;
  for (const SpectrumNode& node : nodes) {
    const double away = std::abs(wavelength_nm - node.wavelength_nm);
    const double share = std::clamp((away - kNear_nm) / (kFar_nm - kNear_nm), 0.0, 1.0);
    error = std::min(error, node.error + share * ((inside ? kFarError : kBeyondError) - node.error));
  }
  return error;
}

}  // namespace vegard::sim
