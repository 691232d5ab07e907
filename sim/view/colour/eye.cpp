#include "sim/view/colour/eye.h"

#include <algorithm>
#include <cmath>

#include "sim/base/file/csv_table.h"
#include "sim/base/number/spline.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/colour/radiometry.h"

namespace vegard::sim {
namespace {

struct Rods {
  std::vector<double> wavelength_nm, efficiency, curvature;

  Rods() {
    const CsvTable table = embedded_csv_table("cie1951_scotopic_5nm.csv");
    wavelength_nm = table.column("wavelength_nm");
    efficiency = table.column("v_prime");
    curvature = spline_curvature(wavelength_nm, efficiency);
  }
};

constexpr Vector3 kLuminanceOfSrgb{0.2126, 0.7152, 0.0722};  // IEC 61966-2-1
constexpr Vector3 kNightBlue{1.05, 0.97, 1.27};

double luminance_of(const Vector3& rgb) {
  return kLuminanceOfSrgb[0] * rgb[0] + kLuminanceOfSrgb[1] * rgb[1] + kLuminanceOfSrgb[2] * rgb[2];
}

}  // namespace

double scotopic_efficiency(double wavelength_nm) {
  static const Rods rods;
  if (wavelength_nm < rods.wavelength_nm.front() || wavelength_nm > rods.wavelength_nm.back()) return 0.0;
  return spline_at(rods.wavelength_nm, rods.efficiency, rods.curvature, wavelength_nm).value;
}

EyeLight eye_light_per_rayleigh(double wavelength_nm) {
  const double radiance = radiance_w_m2_sr_per_rayleigh(wavelength_nm);
  EyeLight light{colour_matching(wavelength_nm),
                 kScotopicEfficacy_lm_w * scotopic_efficiency(wavelength_nm) * radiance};
  for (double& value : light.xyz_cd_m2) value *= kLuminousEfficacy_lm_w * radiance;
  return light;
}

EyeLight eye_light_per_rayleigh(const std::vector<LineComponent>& components) {
  EyeLight sum;
  for (const LineComponent& component : components) {
    EyeLight light = eye_light_per_rayleigh(component.wavelength_nm);
    for (double& value : light.xyz_cd_m2) value *= component.share;
    light.scotopic_cd_m2 *= component.share;
    sum = sum + light;
  }
  return sum;
}

EyeLight eye_light_of_colour(const Vector3& xyz) {
  const double rods = xyz[0] > 0.0 ? xyz[1] * (1.33 * (1.0 + (xyz[1] + xyz[2]) / xyz[0]) - 1.68) : 0.0;
  return {xyz, std::max(rods, 0.0)};
}

EyeLight operator+(const EyeLight& a, const EyeLight& b) {
  EyeLight sum{a.xyz_cd_m2, a.scotopic_cd_m2 + b.scotopic_cd_m2};
  for (int i = 0; i < 3; ++i) sum.xyz_cd_m2[i] += b.xyz_cd_m2[i];
  return sum;
}

double rod_share(double luminance_cd_m2) {
  return kRodHalfLuminance_cd_m2 / (kRodHalfLuminance_cd_m2 + std::max(luminance_cd_m2, 0.0));
}

Vector3 seen_linear_srgb(const EyeLight& light) {
  static const Matrix3 srgb_from_xyz = rgb_from_xyz(Primaries::srgb);
  const double rods = rod_share(light.xyz_cd_m2[1]);
  const double grey = rods * light.scotopic_cd_m2 / luminance_of(kNightBlue);
  Vector3 seen;
  for (int c = 0; c < 3; ++c) {
    const Vector3& row = srgb_from_xyz[c];
    const double cones =
        row[0] * light.xyz_cd_m2[0] + row[1] * light.xyz_cd_m2[1] + row[2] * light.xyz_cd_m2[2];
    seen[c] = (1.0 - rods) * cones + grey * kNightBlue[c];
  }
  return seen;
}

Vector3 displayed_as_seen(const Vector3& seen_cd_m2, double half_cd_m2) {
  constexpr double kExponent = 0.73;
  const double luminance = luminance_of(seen_cd_m2);
  if (!(luminance > 0.0)) return {};
  const double response = 1.0 / (1.0 + std::pow(half_cd_m2 / luminance, kExponent));
  Vector3 shown;
  for (int c = 0; c < 3; ++c) shown[c] = std::clamp(seen_cd_m2[c] * (response / luminance), 0.0, 1.0);
  return shown;
}

}  // namespace vegard::sim
