#include "sim/view/colour.h"

#include <cassert>

#include "sim/base/csv_table.h"
#include "sim/base/spline.h"

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

Matrix3 inverse(const Matrix3& m) {
  const auto minor = [&](int r, int c) {
    const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
  };
  const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  Matrix3 result;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) result[r][c] = minor(c, r) / determinant;
  return result;
}

Vector3 product(const Matrix3& m, const Vector3& v) {
  Vector3 r{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i] += m[i][j] * v[j];
  return r;
}

/// The matrix whose white (equal RGB) is `white` and whose primaries have these chromaticities.
Matrix3 rgb_from_xyz(const std::array<Chromaticity, 3>& primaries, const Chromaticity& white) {
  Matrix3 columns;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) columns[r][c] = primaries[c].xyz()[r];
  const Vector3 share = product(inverse(columns), white.xyz());
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) columns[r][c] *= share[c];
  return inverse(columns);
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

Matrix3 rgb_from_xyz(const std::string& primaries) {
  constexpr Chromaticity kD65{0.3127, 0.3290};
  if (primaries == "smpte-c") return rgb_from_xyz({{{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}}}, kD65);
  assert(primaries == "srgb");
  return rgb_from_xyz({{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}}}, kD65);
}

Vector3 rgb_of_line(double wavelength_nm, const std::string& primaries) {
  return product(rgb_from_xyz(primaries), colour_matching(wavelength_nm));
}

std::vector<Vector3> rgb_per_kilorayleigh(const std::vector<double>& wavelengths_nm,
                                          const std::string& primaries, double gain_per_kilorayleigh) {
  constexpr double kGreenNm = 557.7;
  const double green_luminance = colour_matching(kGreenNm)[1];
  std::vector<Vector3> weights;
  for (double nm : wavelengths_nm) {
    Vector3 rgb = rgb_of_line(nm, primaries);
    for (double& channel : rgb) channel *= gain_per_kilorayleigh * (kGreenNm / nm) / green_luminance;
    weights.push_back(rgb);
  }
  return weights;
}

Image rgb_from_rayleigh(const Image& rayleigh, const std::vector<Vector3>& weights) {
  assert(rayleigh.channels() == static_cast<int>(weights.size()));
  Image rgb(rayleigh.width, rayleigh.height, {"R", "G", "B"});
  const std::size_t pixels = static_cast<std::size_t>(rayleigh.width) * rayleigh.height;
  for (std::size_t p = 0; p < pixels; ++p) {
    for (std::size_t l = 0; l < weights.size(); ++l) {
      const double kilorayleigh = rayleigh.data[p * weights.size() + l] * 1e-3;
      for (int c = 0; c < 3; ++c) rgb.data[p * 3 + c] += static_cast<float>(kilorayleigh * weights[l][c]);
    }
  }
  return rgb;
}

}  // namespace vegard::sim
