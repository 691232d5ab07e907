#include "sim/view/colour/colour.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "sim/base/file/csv_table.h"
#include "sim/base/number/spline.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {
namespace {

struct Observer {
  std::vector<double> wavelength_nm;
  std::array<std::vector<double>, 3> bar, curvature;

  Observer() {
    const CsvTable table = embedded_csv_table("cie1931_2deg_5nm.csv");
    wavelength_nm = table.numbers.at(0);
    for (int i = 0; i < 3; ++i) bar[i] = table.numbers.at(1 + i);
    assert(wavelength_nm.size() == 81);
    for (int i = 0; i < 3; ++i) curvature[i] = spline_curvature(wavelength_nm, bar[i]);
  }
};

struct Chromaticity {
  double x, y;
  Vector3 xyz() const { return {x / y, 1.0, (1.0 - x - y) / y}; }
};

/// Returns the matrix whose white (equal RGB) is `white` and whose primaries have these chromaticities.
Matrix3 rgb_from_xyz(const std::array<Chromaticity, 3>& primaries, const Chromaticity& white) {
  Matrix3 columns;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) columns[r][c] = primaries[c].xyz()[r];
  const Vector3 share = product(inverse(columns), white.xyz());
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) columns[r][c] *= share[c];
  return inverse(columns);
}

/// Returns the matrix from XYZ under one white to XYZ that look alike under another: the whites' ratio in the
/// Bradford cone responses (Lam 1985; the matrix as in ICC.1:2010, annex E).
Matrix3 bradford(const Chromaticity& from, const Chromaticity& to) {
  constexpr Matrix3 kCones = {
      {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
  const Vector3 old_white = product(kCones, from.xyz()), new_white = product(kCones, to.xyz());
  Vector3 ratio;
  for (int i = 0; i < 3; ++i) ratio[i] = new_white[i] / old_white[i];
  return product(inverse(kCones), product(diagonal(ratio), kCones));
}

}  // namespace

Vector3 colour_matching(double wavelength_nm) {
  static const Observer observer;
  if (wavelength_nm < observer.wavelength_nm.front() || wavelength_nm > observer.wavelength_nm.back())
    return {};
  Vector3 result;
  for (int i = 0; i < 3; ++i)
    result[i] =
        spline_at(observer.wavelength_nm, observer.bar[i], observer.curvature[i], wavelength_nm).value;
  return result;
}

Matrix3 rgb_from_xyz(Primaries primaries) {
  constexpr Chromaticity kD65{0.3127, 0.3290}, kAces{0.32168, 0.33767};
  switch (primaries) {
    case Primaries::smpte_c:
      return rgb_from_xyz({{{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}}}, kD65);
    case Primaries::rec2020:
      return rgb_from_xyz({{{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}}}, kD65);
    case Primaries::acescg:
      return product(rgb_from_xyz({{{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}}}, kAces),
                     bradford(kD65, kAces));
    case Primaries::srgb:
      break;
  }
  return rgb_from_xyz({{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}}}, kD65);
}

Vector3 rgb_of_line(double wavelength_nm, Primaries primaries) {
  return product(rgb_from_xyz(primaries), colour_matching(wavelength_nm));
}

void colour_cells(const float* rayleigh, std::size_t cells, const std::vector<Vector3>& weights, float* rgb) {
  for (std::size_t p = 0; p < cells; ++p) {
    float sum[3] = {};
    for (std::size_t l = 0; l < weights.size(); ++l) {
      const double kilorayleigh = rayleigh[p * weights.size() + l] * 1e-3;
      for (int c = 0; c < 3; ++c) sum[c] += static_cast<float>(kilorayleigh * weights[l][c]);
    }
    for (int c = 0; c < 3; ++c) rgb[p * 3 + c] = sum[c];
  }
}

Image rgb_from_rayleigh(const Image& rayleigh, const std::vector<Vector3>& weights) {
  assert(rayleigh.channels() == static_cast<int>(weights.size()));
  Image rgb(rayleigh.width, rayleigh.height, {"R", "G", "B"});
  colour_cells(rayleigh.data.data(), static_cast<std::size_t>(rayleigh.width) * rayleigh.height, weights,
               rgb.data.data());
  return rgb;
}

double black_body_power(double wavelength_nm, double temperature_k) {
  constexpr double kSecondRadiationConstantNmK = 1.438776877e7;
  return std::pow(wavelength_nm / 560.0, -5.0) /
         std::expm1(kSecondRadiationConstantNmK / (wavelength_nm * temperature_k));
}

double daylight_power(double wavelength_nm, double correlated_temperature_k) {
  static const CsvTable table = embedded_csv_table("daylight_components_10nm.csv");
  const std::vector<double>& nm = table.numbers.at(0);
  if (wavelength_nm < nm.front() || wavelength_nm > nm.back()) return 0.0;
  assert(correlated_temperature_k >= 4000.0 && correlated_temperature_k <= 25000.0);
  const double k = 1e3 / correlated_temperature_k;
  const double x = correlated_temperature_k <= 7000.0 ? 0.244063 + k * (0.09911 + k * (2.9678 - k * 4.6070))
                                                      : 0.237040 + k * (0.24748 + k * (1.9018 - k * 2.0064));
  const double y = -0.275 + x * (2.870 - x * 3.000);
  // The CIE rounds the shares to three digits.
  const auto rounded = [](double share) { return std::round(share * 1e3) * 1e-3; };
  const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
  const double m1 = rounded((-1.3515 - 1.7703 * x + 5.9114 * y) / m);
  const double m2 = rounded((0.0300 - 31.4424 * x + 30.0717 * y) / m);
  const std::size_t i = std::min<std::size_t>(
      std::upper_bound(nm.begin(), nm.end(), wavelength_nm) - nm.begin(), nm.size() - 1);
  const double t = (wavelength_nm - nm[i - 1]) / (nm[i] - nm[i - 1]);
  const auto component = [&](int c) {
    const std::vector<double>& s = table.numbers.at(c);
    return s[i - 1] + t * (s[i] - s[i - 1]);
  };
  return component(1) + m1 * component(2) + m2 * component(3);
}

}  // namespace vegard::sim
