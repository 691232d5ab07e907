#include "sim/light/line_profile.h"

#include <algorithm>
#include <cstddef>

#include "sim/scene/lines/emission_lines.h"

namespace vegard::sim {
namespace line_of_form {

constexpr double kDark = 1e-30;  // of the peak; floats would soon lose their digits, and their speed

/// Returns the column in rayleighs below an altitude of a rate at the altitudes of a profile. It is
/// column_below() in double precision.
template <class Rate>
double column(const Rate& rate, double top_km) {
  double sum = 0.0;
  for (int a = 0; a + 1 < HeightProfile::kAltitudes; ++a) {
    const double part =
        std::clamp((top_km - HeightProfile::altitude_km(a)) / HeightProfile::kStepKm, 0.0, 1.0);
    if (part == 0.0) break;
    const double here = rate(HeightProfile::altitude_km(a)), above = rate(HeightProfile::altitude_km(a + 1));
    sum += part * ((1.0 - 0.5 * part) * here + 0.5 * part * above);
  }
  return 0.1 * HeightProfile::kStepKm * sum;
}

/// Sets every row of the line in rates of [altitude][stride] to a function of the altitude.
template <class Rate>
void fill(const std::vector<double>& wavelengths_nm, double line_nm, int stride, const Rate& rate,
          std::vector<float>& rates) {
  const int line = line_index(wavelengths_nm, line_nm);
  if (line < 0) return;
  for (int a = 0; a < HeightProfile::kAltitudes; ++a)
    rates[static_cast<std::size_t>(a) * stride + line] =
        static_cast<float>(rate(HeightProfile::altitude_km(a)));
}

}  // namespace line_of_form

HeightProfile line_profile(const std::vector<double>& wavelengths_nm, const GivenLine& line,
                           const FormCurve& curve) {
  HeightProfile profile = dark_profile(static_cast<int>(wavelengths_nm.size()));
  const auto intensity = [&](double altitude_km) { return form_intensity(curve, altitude_km); };
  const double scale = line.rayleigh / line_of_form::column(intensity, line.top_km);
  const auto rate = [&](double altitude_km) {
    const double here = intensity(altitude_km);
    return here < line_of_form::kDark ? 0.0 : here * scale;
  };
  line_of_form::fill(wavelengths_nm, line.wavelength_nm, profile.stride, rate, profile.rate);
  return profile;
}

std::vector<float> line_profile_slope(const std::vector<double>& wavelengths_nm, const GivenLine& line,
                                      const FormCurve& curve, double FormCurve::*number) {
  const HeightProfile shape = dark_profile(static_cast<int>(wavelengths_nm.size()));
  const auto intensity = [&](double altitude_km) { return form_intensity(curve, altitude_km); };
  const auto growth = [&](double altitude_km) { return form_intensity_slope(curve, altitude_km, number); };
  const double column = line_of_form::column(intensity, line.top_km),
               column_growth = line_of_form::column(growth, line.top_km);
  const auto rate_growth = [&](double altitude_km) {
    const double here = intensity(altitude_km);
    if (here < line_of_form::kDark) return 0.0;
    return (growth(altitude_km) - here * column_growth / column) * line.rayleigh / column;
  };
  std::vector<float> slope = shape.rate;
  line_of_form::fill(wavelengths_nm, line.wavelength_nm, shape.stride, rate_growth, slope);
  return slope;
}

}  // namespace vegard::sim
