#include "sim/light/form_profile.h"

#include <cmath>
#include <cstddef>

namespace vegard::sim {
namespace {

const std::vector<double> kTotalLinesNm = {630.0, 557.7, 427.8};
constexpr double kLnTen = 2.302585092994046;
constexpr double kDark = 1e-30;  // of the peak; floats would soon lose their digits, and their speed
constexpr double kTenthAbove = 3.8897201698674290;  // (1 + x) exp(-x) = 1/10

/// Light of all lines of a profile, and its derivative.
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

/// Moves the light of a profile to the curve, and its derivatives with it. `reference` is the profile of
/// kTotalLinesNm.
HeightProfile moved(HeightProfile profile, const HeightProfile& reference, const FormCurve& curve) {
  Total of_tables;
  double of_form = 0.0;
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    const double end = a == 0 || a == HeightProfile::kAltitudes - 1 ? 0.5 : 1.0;
    const Total here = total_at(reference, a);
    of_tables.rate += end * here.rate;
    of_tables.slope += end * here.slope;
    of_form += end * form_intensity(curve, HeightProfile::altitude_km(a));
  }
  const double growth = of_tables.slope / of_tables.rate;
  for (int a = 0; a < HeightProfile::kAltitudes; ++a) {
    const Total here = total_at(reference, a);
    const double intensity = form_intensity(curve, HeightProfile::altitude_km(a));
    const double wanted = intensity < kDark ? 0.0 : intensity * of_tables.rate / of_form;
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

HeightProfile form_profile(const std::vector<double>& wavelengths_nm, double energy_kev,
                           const FormCurve& curve, double energy_flux_mw_m2) {
  return moved(maxwellian_profile(wavelengths_nm, energy_kev, energy_flux_mw_m2),
               maxwellian_profile(kTotalLinesNm, energy_kev, energy_flux_mw_m2), curve);
}

HeightProfile form_profile_by_flux(const std::vector<double>& wavelengths_nm, double energy_kev,
                                   const FormCurve& curve, double energy_flux_mw_m2) {
  return moved(maxwellian_profile_by_flux(wavelengths_nm, energy_kev, energy_flux_mw_m2),
               maxwellian_profile_by_flux(kTotalLinesNm, energy_kev, energy_flux_mw_m2), curve);
}

}  // namespace vegard::sim
