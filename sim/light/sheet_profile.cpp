#include "sim/light/sheet_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/base/error.h"
#include "sim/light/drawn_profile.h"
#include "sim/light/form_profile.h"
#include "sim/light/line_profile.h"
#include "sim/light/own_light.h"
#include "sim/light/proton_profile.h"
#include "sim/light/spectrum_profile.h"
#include "sim/light/tables/emission_tables.h"
#include "sim/scene/rows/spline_rates.h"
#include "sim/scene/table/table_files.h"

namespace vegard::sim {
namespace {

const std::vector<double> kBrightnessLineNm = {557.7};

FormCurve form_curve(const Sheet& sheet) { return {sheet.peak_km, sheet.lower_km, sheet.upper_km}; }

GivenLine given_line(const Sheet& sheet) {
  return {sheet.line_nm, 1e3 * sheet.line_kilorayleigh, sheet.top_km};
}

/// Returns whether the profile is scaled to a brightness of 557.7 nm.
bool is_scaled(const Sheet& sheet) { return sheet.brightness_kilorayleigh > 0.0; }

/// Returns the flux at which the light per mW m^-2 is taken: the sheet's own, at the peak of a layer, for all
/// of it.
double flux_of(const Scene& scene, const Sheet& sheet) {
  return scene.emission.flux_law == FluxLaw::linear || has_given_brightness(sheet) ? 1.0
                                                                                   : sheet.energy_flux_mw_m2;
}

/// Returns the profile by the model that the sheet names.
HeightProfile of_model(const std::vector<double>& wavelengths_nm, const Scene& scene, const Sheet& sheet,
                       SlopeBy by) {
  const double flux = flux_of(scene, sheet);
  switch (sheet.profile) {
    case ProfileKind::spline:
      return spline_profile(wavelengths_nm, scene, sheet);
    case ProfileKind::mono:
      return mono_profile(emission_source(scene), wavelengths_nm, sheet.energy_kev, by);
    case ProfileKind::gaussian:
      return gaussian_profile(emission_source(scene), wavelengths_nm, sheet.energy_kev, sheet.energy_spread,
                              by);
    case ProfileKind::file:
      return drawn_profile(wavelengths_nm, scene, sheet);
    case ProfileKind::form:
      return form_profile(emission_source(scene), wavelengths_nm, sheet.energy_kev, form_curve(sheet), flux,
                          by);
    case ProfileKind::layer:
      return dark_profile(static_cast<int>(wavelengths_nm.size()));
    case ProfileKind::line:
      return line_profile(wavelengths_nm, given_line(sheet), form_curve(sheet));
    case ProfileKind::proton:
      return proton_profile(emission_source(scene).tables, wavelengths_nm, given_line(sheet),
                            sheet.energy_kev);
    case ProfileKind::maxwellian:
      break;
  }
  return maxwellian_profile(emission_source(scene), wavelengths_nm, sheet.energy_kev, flux, by);
}

/// The derivative by the brightness of a line, to which all light of a sheet is in proportion.
HeightProfile with_kilorayleigh_of_one(const std::vector<double>& wavelengths_nm, const Scene& scene,
                                       Sheet sheet) {
  sheet.line_kilorayleigh = 1.0;
  return of_model(wavelengths_nm, scene, sheet, SlopeBy::log_energy);
}

HeightProfile of_unit_flux(const std::vector<double>& wavelengths_nm, const Scene& scene, const Sheet& sheet,
                           SlopeBy by = SlopeBy::log_energy) {
  const OwnLight own(wavelengths_nm, scene, sheet);
  HeightProfile profile = of_model(own.asked_nm(), scene, sheet, by);
  own.add_to(profile);
  return profile;
}

/// Returns whether the light per flux of electrons grows with their flux.
bool follows_flux_law(const Scene& scene, const Sheet& sheet) {
  return scene.emission.flux_law != FluxLaw::linear && !has_given_brightness(sheet) &&
         (sheet.profile == ProfileKind::form || sheet.profile == ProfileKind::maxwellian);
}

/// Returns the derivative of the light per flux by a number; empty for one that it does not depend on, or by
/// the energy alone.
std::vector<float> slope_of_unit_flux(const std::vector<double>& wavelengths_nm, const Scene& scene,
                                      const Sheet& sheet, const ParameterId& number) {
  const auto by_form = [&](double FormCurve::*of_curve) {
    if (sheet.profile == ProfileKind::line)
      return line_profile_slope(wavelengths_nm, given_line(sheet), form_curve(sheet), of_curve);
    if (sheet.profile != ProfileKind::form) return std::vector<float>();
    const OwnLight own(wavelengths_nm, scene, sheet);
    std::vector<float> slope = form_slope(emission_source(scene), own.asked_nm(), sheet.energy_kev,
                                          form_curve(sheet), flux_of(scene, sheet), of_curve);
    own.scale(dark_profile(static_cast<int>(wavelengths_nm.size())).stride, slope);
    return slope;
  };
  const auto slope_by = [&](SlopeBy by, bool counts) {
    return counts ? of_unit_flux(wavelengths_nm, scene, sheet, by).d_rate_d_ln_energy : std::vector<float>();
  };
  switch (number.role()) {
    case ParameterRole::energy_spread:
      return slope_by(SlopeBy::energy_spread, sheet.profile == ProfileKind::gaussian);
    case ParameterRole::energy_flux:
      return slope_by(SlopeBy::energy_flux, follows_flux_law(scene, sheet));
    case ParameterRole::oxygen_factor:
      return slope_by(SlopeBy::oxygen_factor, is_of_electrons(sheet.profile));
    case ParameterRole::light_mode:
      return slope_by(slope_by_mode(number.component), is_of_electrons(sheet.profile));
    case ParameterRole::profile_coefficient:
      if (!has_spline_profile(sheet)) return {};
      return spline_slope(wavelengths_nm, scene, sheet, index_in(scene, number));
    case ParameterRole::form_peak:
      return by_form(&FormCurve::peak_km);
    case ParameterRole::form_lower:
      return by_form(&FormCurve::lower_km);
    case ParameterRole::form_upper:
      return by_form(&FormCurve::upper_km);
    case ParameterRole::line_brightness:
      if (!is_as_bright_as_given(sheet.profile)) return {};
      return with_kilorayleigh_of_one(wavelengths_nm, scene, sheet).rate;
    default:
      return {};
  }
}

bool may_shape(const ParameterId& number, int sheet) {
  return number.sheet() == sheet || number.role() == ParameterRole::oxygen_factor ||
         number.role() == ParameterRole::light_mode;
}

}  // namespace

bool has_given_brightness(const Sheet& sheet) {
  return is_scaled(sheet) || is_as_bright_as_given(sheet.profile);
}

HeightProfile sheet_profile(const std::vector<double>& wavelengths_nm, const Scene& scene, int index) {
  const Sheet& sheet = scene.sheets[index];
  HeightProfile profile = of_unit_flux(wavelengths_nm, scene, sheet);
  if (!is_scaled(sheet)) return profile;
  const Column green = column_below(of_unit_flux(kBrightnessLineNm, scene, sheet), 0, sheet.top_km);
  const double scale = 1000.0 * sheet.brightness_kilorayleigh / green.rayleigh;
  const double growth = green.d_rayleigh_d_ln_energy / green.rayleigh;
  for (std::size_t i = 0; i < profile.rate.size(); ++i) {
    const double rate = profile.rate[i];
    profile.d_rate_d_ln_energy[i] =
        static_cast<float>((profile.d_rate_d_ln_energy[i] - rate * growth) * scale);
    profile.rate[i] = static_cast<float>(rate * scale);
  }
  return profile;
}

std::vector<float> profile_slope(const std::vector<double>& wavelengths_nm, const Scene& scene, int index,
                                 const ParameterId& number) {
  if (!may_shape(number, index)) return {};
  const Sheet& sheet = scene.sheets[index];
  std::vector<float> slope = slope_of_unit_flux(wavelengths_nm, scene, sheet, number);
  if (slope.empty() || !is_scaled(sheet)) return slope;
  // The rate is scaled by brightness / green, and green changes too.
  const HeightProfile profile = of_unit_flux(wavelengths_nm, scene, sheet);
  HeightProfile green = of_unit_flux(kBrightnessLineNm, scene, sheet);
  const double rayleigh = column_below(green, 0, sheet.top_km).rayleigh;
  green.rate = slope_of_unit_flux(kBrightnessLineNm, scene, sheet, number);
  const double growth = column_below(green, 0, sheet.top_km).rayleigh / rayleigh;
  const double scale = 1000.0 * sheet.brightness_kilorayleigh / rayleigh;
  for (std::size_t i = 0; i < slope.size(); ++i)
    slope[i] = static_cast<float>((slope[i] - static_cast<double>(profile.rate[i]) * growth) * scale);
  return slope;
}

double EnergyLadder::energy_kev(int rung) const {
  return std::clamp(std::exp((first + rung) * kLnStep), min_kev, max_kev);
}

EnergyLadder energy_ladder(const Scene& scene, int index) {
  const Sheet& sheet = scene.sheets[index];
  EnergyLadder ladder;
  if (sheet.course != SheetCourse::curve || sheet.point_energy_kev.empty()) return ladder;
  const auto [least, most] =
      std::minmax_element(sheet.point_energy_kev.begin(), sheet.point_energy_kev.end());
  // Between its points a curve goes beyond their values by less than a third of their range
  // (sim/emit/aurora/sheet_curve.h).
  const double low = std::log(*least), high = std::log(*most), beyond = (high - low) / 3.0;
  const std::vector<double>& energies = emission_tables(scene).energies_kev();
  ladder.min_kev = energies.front();
  ladder.max_kev = energies.back();
  const double bottom = std::max(low - beyond, std::log(ladder.min_kev)),
               top = std::min(high + beyond, std::log(ladder.max_kev));
  ladder.first = static_cast<int>(std::floor(bottom / EnergyLadder::kLnStep));
  ladder.count = std::max(2, static_cast<int>(std::ceil(top / EnergyLadder::kLnStep)) - ladder.first + 1);
  return ladder;
}

std::vector<HeightProfile> ladder_profiles(const std::vector<double>& wavelengths_nm, const Scene& scene,
                                           int sheet) {
  const EnergyLadder ladder = energy_ladder(scene, sheet);
  std::vector<HeightProfile> profiles;
  if (ladder.count == 0) return profiles;
  Scene of_energy = scene;
  for (int rung = 0; rung < ladder.count; ++rung) {
    of_energy.sheets[sheet].energy_kev = ladder.energy_kev(rung);
    profiles.push_back(sheet_profile(wavelengths_nm, of_energy, sheet));
  }
  return profiles;
}

std::vector<std::vector<float>> profile_slopes(const std::vector<double>& wavelengths_nm, const Scene& scene,
                                               int sheet, const ParameterId& number) {
  const EnergyLadder ladder = energy_ladder(scene, sheet);
  std::vector<std::vector<float>> slopes;
  if (ladder.count == 0) {
    slopes.push_back(profile_slope(wavelengths_nm, scene, sheet, number));
  } else if (may_shape(number, sheet)) {
    Scene of_energy = scene;
    for (int rung = 0; rung < ladder.count; ++rung) {
      of_energy.sheets[sheet].energy_kev = ladder.energy_kev(rung);
      slopes.push_back(profile_slope(wavelengths_nm, of_energy, sheet, number));
    }
  }
  if (!slopes.empty() && slopes.front().empty()) slopes.clear();
  return slopes;
}

void check_profiles(const Scene& scene) {
  check_emission_tables(scene);
  for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
    const Sheet& sheet = scene.sheets[s];
    if (sheet.profile != ProfileKind::file) continue;
    of_unit_flux(scene.emission.lines, scene, sheet);
    if (!is_scaled(sheet)) continue;
    if (column_below(of_unit_flux(kBrightnessLineNm, scene, sheet), 0, sheet.top_km).rayleigh > 0.0) continue;
    throw unreadable(table_place(scene, sheet.profile_file),
                     "557.7 nm has no light below top_km, so that the sheet's brightness cannot be reached")
        .expected("a column of 557.7 nm that is not all zeros")
        .hint("brightness_kilorayleigh (and ibc) is that of this line");
  }
}

}  // namespace vegard::sim
