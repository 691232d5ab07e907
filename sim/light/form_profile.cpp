#include "sim/light/form_profile.h"

#include <cmath>
#include <cstddef>

namespace vegard::sim {
namespace {

const std::vector<double> kTotalLinesNm = {630.0, 557.7, 427.8};
constexpr double kLnTen = 2.302585092994046;
constexpr double kDark = 1e-30;  // of the peak; floats would soon lose their digits, and their speed
constexpr double kTenthAbove = 3.8897201698674290;  // (1 + x) exp(-x) = 1/10

/// The light of all lines of a profile, and its derivative.
struct Total {
  double rate = 0.0, slope = 0.0;
};

Total total_at(const HeightProfile& profile, int altitude) {
  Total total;
  for (int l = 0; l < profile.lines; ++l) {
    const std::size_t i = static_cast<std::size_t>(altitude) * profile.stride + l;
    total.rate += profile.rate[i];
    total.slope += profile.d_rate_d_ln_energy[i];
  }
  return total;
}

/// Shifts the light of a profile to the curve, and its derivatives with it. `reference` is the profile of
/// kTotalLinesNm.
HeightProfile moved(HeightProfile profile, const HeightProfile& reference, const FormCurve& curve) {
  Total tables_light;
  double form_column = 0.0;
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    const double end = a == 0 || a == HeightProfile::kAltitudes - 1 ? 0.5 : 1.0;
    const Total here = total_at(reference, a);
    tables_light.rate += end * here.rate;
    tables_light.slope += end * here.slope;
    form_column += end * form_intensity(curve, HeightProfile::altitude_km(a));
  }
  const double growth = tables_light.slope / tables_light.rate;
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    const Total here = total_at(reference, a);
    const double intensity = form_intensity(curve, HeightProfile::altitude_km(a));
    const double wanted = intensity < kDark ? 0.0 : intensity * tables_light.rate / form_column;
    for (int l = 0; l < profile.lines; ++l) {
      const std::size_t i = static_cast<std::size_t>(a) * profile.stride + l;
      const double rate = profile.rate[i], slope = profile.d_rate_d_ln_energy[i];
      profile.rate[i] = static_cast<float>(rate / here.rate * wanted);
      profile.d_rate_d_ln_energy[i] =
          static_cast<float>((slope - rate * here.slope / here.rate + rate * growth) / here.rate * wanted);
    }
  }
  return profile;
}

}  // namespace

double form_intensity(const FormCurve& curve, double altitude_km) {
  const double above = altitude_km - curve.peak_km;
  if (above < 0.0) return std::exp(-kLnTen * (above / curve.lower_km) * (above / curve.lower_km));
  const double x = kTenthAbove * above / curve.upper_km;
  return (1.0 + x) * std::exp(-x);
}

double form_intensity_slope(const FormCurve& curve, double altitude_km, double FormCurve::*number) {
  const double above = altitude_km - curve.peak_km;
  if (above < 0.0) {
    if (number == &FormCurve::upper_km) return 0.0;
    const double x = above / curve.lower_km;
    const double by_x = -2.0 * kLnTen * x * std::exp(-kLnTen * x * x);
    return by_x * (number == &FormCurve::peak_km ? -1.0 : -x) / curve.lower_km;
  }
  if (number == &FormCurve::lower_km) return 0.0;
  const double x = kTenthAbove * above / curve.upper_km;
  const double by_x = -x * std::exp(-x);
  return by_x * (number == &FormCurve::peak_km ? -kTenthAbove : -x) / curve.upper_km;
}

HeightProfile form_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                           double energy_kev, const FormCurve& curve, double energy_flux_mw_m2, SlopeBy by) {
  return moved(maxwellian_profile(source, wavelengths_nm, energy_kev, energy_flux_mw_m2, by),
               maxwellian_profile(source, kTotalLinesNm, energy_kev, energy_flux_mw_m2, by), curve);
}

std::vector<float> form_slope(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                              double energy_kev, const FormCurve& curve, double energy_flux_mw_m2,
                              double FormCurve::*number) {
  const HeightProfile profile = maxwellian_profile(source, wavelengths_nm, energy_kev, energy_flux_mw_m2);
  const HeightProfile reference = maxwellian_profile(source, kTotalLinesNm, energy_kev, energy_flux_mw_m2);
  double tables_column = 0.0, form_column = 0.0, form_grows = 0.0;
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    const double end = a == 0 || a == HeightProfile::kAltitudes - 1 ? 0.5 : 1.0;
    tables_column += end * total_at(reference, a).rate;
    form_column += end * form_intensity(curve, HeightProfile::altitude_km(a));
    form_grows += end * form_intensity_slope(curve, HeightProfile::altitude_km(a), number);
  }
  std::vector<float> slope(profile.rate.size(), 0.0f);
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    const double altitude = HeightProfile::altitude_km(a), intensity = form_intensity(curve, altitude);
    if (intensity < kDark) continue;
    const double wanted =
        (form_intensity_slope(curve, altitude, number) - intensity * form_grows / form_column) *
        tables_column / form_column;
    const double here = total_at(reference, a).rate;
    for (int l = 0; l < profile.lines; ++l) {
      const std::size_t i = static_cast<std::size_t>(a) * profile.stride + l;
      slope[i] = static_cast<float>(profile.rate[i] / here * wanted);
    }
  }
  return slope;
}

}  // namespace vegard::sim
