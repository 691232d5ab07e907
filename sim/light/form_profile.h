// The height profile of an auroral form: a measured intensity curve replaces the one that electrons would
// give.
//
// Source: Baranoski et al. 2000, sections 3.3 and 3.4 (after Vegard and Krogness 1920 and Hargreaves 1992);
// docs/physics.md row B19.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"

namespace vegard::sim {

/// The altitude at which a form's light is brightest, and the distances below and above it at which the light
/// has fallen to a tenth.
struct FormCurve {
  double peak_km = 110.0;
  double lower_km = 4.0;
  double upper_km = 20.0;
};

/// Returns the total light at an altitude, 1 at the peak. Below the peak: exp(-ln 10 ((peak - h) / lower)^2),
/// so that it is 1 % at sqrt(2) lower, "a kilometre or two below" the tenth. Above: (1 + x) exp(-x), level at
/// the peak and exponential far above. The formulas are vegard's; the source shows the curves as a figure
/// only.
double form_intensity(const FormCurve& curve, double altitude_km);

/// Returns d form_intensity / d one of the curve's numbers.
double form_intensity_slope(const FormCurve& curve, double altitude_km, double FormCurve::*number);

/// Returns the profile of Maxwellian electrons with its total light redistributed in altitude to follow the
/// form's curve. The total is the sum of the photons of 630.0, 557.7 and 427.8 nm, whatever lines are in
/// `wavelengths_nm`. At each altitude the ratios of the lines are those of the tables (or of their floor);
/// the total over all altitudes is that of the tables. The slope is that of maxwellian_profile().
HeightProfile form_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                           double energy_kev, const FormCurve& curve, double energy_flux_mw_m2 = 1.0,
                           SlopeBy by = SlopeBy::log_energy);

/// Returns d rate / d one of the curve's numbers, indexed as HeightProfile::rate.
std::vector<float> form_slope(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                              double energy_kev, const FormCurve& curve, double energy_flux_mw_m2,
                              double FormCurve::*number);

}  // namespace vegard::sim
