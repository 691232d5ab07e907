#include "tests/recovery/scorecard/score.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/answer/derived.h"
#include "fit/parameters/free_parameters.h"
#include "sim/base/number/constants.h"
#include "sim/emit/aurora/beam.h"
#include "sim/light/line_light.h"
#include "sim/view/camera/camera.h"

namespace vegard::scorecard {
namespace {

double relative(double found, double truth) { return std::abs(found - truth) / truth; }

/// Degrees between two lines, which have no direction.
double angle_between(double a_deg, double b_deg) { return std::abs(std::remainder(a_deg - b_deg, 180.0)); }

double misfit(const sim::Sheet& truth, const sim::Sheet& found) {
  return std::abs(std::log(found.energy_kev / truth.energy_kev)) / Criteria::kEnergy +
         relative(fit::nearest_distance_km(found), fit::nearest_distance_km(truth)) / Criteria::kDistance +
         angle_between(found.bearing_deg, truth.bearing_deg) / Criteria::kBearing_deg;
}

/// (found - truth) / sigma in the solver's coordinate.
double z_of_parameter(const sim::Scene& start, const fit::FitResult& result, const std::string& path,
                      double truth) {
  for (const fit::FreeNumber& number : fit::free_numbers(start)) {
    if (number.path != path) continue;
    for (const fit::FittedParameter& p : result.parameters) {
      if (p.path != path || !p.interval68) continue;
      const double sigma =
          0.5 * (number.coordinate(p.interval68->second) - number.coordinate(p.interval68->first));
      return (number.coordinate(p.value) - number.coordinate(truth)) / sigma;
    }
  }
  return kNone;
}

/// The first derived number whose name begins so, of a sheet; null if there is none.
const fit::DerivedNumber* derived_of(const fit::FitResult& result, const std::string& beginning,
                                     const std::string& sheet) {
  const std::string end = " of the " + sheet + " sheet";
  for (const fit::DerivedNumber& d : result.derived)
    if (d.name.rfind(beginning, 0) == 0 && d.name.size() >= end.size() &&
        d.name.compare(d.name.size() - end.size(), end.size(), end) == 0)
      return &d;
  return nullptr;
}

double z_of_distance(const fit::FitResult& result, const std::string& sheet, double truth_km) {
  const fit::DerivedNumber* d = derived_of(result, "distance", sheet);
  return d != nullptr && d->sigma ? (d->value - truth_km) / *d->sigma : kNone;
}

std::string trust_in(const fit::FitResult& result, const std::string& beginning, const std::string& sheet) {
  const fit::DerivedNumber* d = derived_of(result, beginning, sheet);
  return d != nullptr ? fit::trust_name(d->trust) : "";
}

/// ln(found / truth) / sigma of the flux of one sheet over the other's. Both may be free, and are correlated.
double z_of_ratio(const sim::Scene& start, const fit::FitResult& result, bool swapped, double truth) {
  const std::size_t n = result.parameters.size();
  std::vector<double> sigma(n, 0.0);  // of the logarithm of what is upstairs, negative of what is downstairs
  double found = 0.0, variance = 0.0;
  bool any = false;
  for (std::size_t s = 0; s < 2; ++s) {
    const double sign = (s == 1) != swapped ? 1.0 : -1.0;
    found += sign * std::log(result.best.sheets[s].energy_flux_mw_m2);
    for (std::size_t j = 0; j < n; ++j) {
      const fit::FittedParameter& p = result.parameters[j];
      if (p.path != "sheet." + start.sheets[s].name + ".energy_flux_mw_m2") continue;
      if (!p.interval68) return kNone;
      sigma[j] = 0.5 * sign * std::log(p.interval68->second / p.interval68->first);
      any = true;
    }
  }
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k < n; ++k)
      variance += sigma[j] * sigma[k] * (j == k ? 1.0 : result.correlation[j][k]);
  return any && variance > 0.0 ? (found - std::log(truth)) / std::sqrt(variance) : kNone;
}

}  // namespace

std::vector<std::string> missed_criteria(const SheetRow& sheet) {
  std::vector<std::string> missed;
  // "Not within" also of what is no number.
  if (!(relative(sheet.energy_kev, sheet.energy_true_kev) <= Criteria::kEnergy)) missed.push_back("E0");
  if (!(relative(sheet.distance_km, sheet.distance_true_km) <= Criteria::kDistance))
    missed.push_back("distance");
  if (!(angle_between(sheet.bearing_deg, sheet.bearing_true_deg) <= Criteria::kBearing_deg))
    missed.push_back("bearing");
  if (sheet.waves_in_view >= Criteria::kWavesInView &&
      !(relative(sheet.wavelength_km, sheet.wavelength_true_km) <= Criteria::kWavelength))
    missed.push_back("wavelength");
  if (!(relative(sheet.thickness_km, sheet.thickness_true_km) <= Criteria::kThickness))
    missed.push_back("amplitude");
  return missed;
}

double waves_in_view(const sim::Scene& scene, int index) {
  const sim::Sheet& sheet = scene.sheets[index];
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  const sim::FallFrame<double> fall = sim::fall_frame(scene.field.inclination_deg * sim::kRadiansPerDegree,
                                                      scene.field.declination_deg * sim::kRadiansPerDegree);
  const double bearing = sheet.bearing_deg * sim::kRadiansPerDegree;
  const auto in_picture = [&](double along_km) {
    const double east = sheet.center_km.east + along_km * std::sin(bearing);
    const double north = sheet.center_km.north + along_km * std::cos(bearing);
    for (const double altitude_km : {100.0, 110.0, 120.0, 140.0, 160.0, 180.0, 200.0}) {
      const sim::Beam<double> beam =
          sim::start_beam(east, north, fall, 1e-3 * scene.site.altitude_m, altitude_km, 80.0);
      double camera[3] = {};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) camera[i] += view.camera_from_enu[i][j] * beam.start_in_enu_km[j];
      if (camera[2] <= 0.0) continue;
      const double x = view.lens.focal_px * camera[0] / camera[2] + 0.5 * scene.camera.width;
      const double y = view.lens.focal_px * camera[1] / camera[2] + 0.5 * scene.camera.height;
      if (x >= 0.0 && x <= scene.camera.width && y >= 0.0 && y <= scene.camera.height) return true;
    }
    return false;
  };
  constexpr double kStepKm = 0.5;
  int seen = 0;
  for (double along = -0.5 * sheet.length_km; along <= 0.5 * sheet.length_km; along += kStepKm)
    if (in_picture(along)) ++seen;
  return seen * kStepKm / sheet.wavelength_km;
}

Row score(const Truth& truth, const sim::Scene& start, const fit::FitResult& result) {
  const std::vector<sim::Sheet>& known = truth.scene.sheets;
  const std::vector<sim::Sheet>& found = result.best.sheets;
  Row row;
  row.line_of_sight = truth.line_of_sight ? 1 : 0;
  row.sheets = static_cast<int>(known.size());
  row.rays = known[0].ray_contrast > 0.0 ? 1 : 0;
  row.folds = known[0].fold_spacing_km > 0.0 ? 1 : 0;
  row.verdict = fit::verdict_name(result.verdict);
  row.chi2 = result.chi2;
  row.chi2_per_dof = result.chi2 / result.dof;
  row.inflation = result.error_inflation;
  row.rms_over_peak = result.rms_over_peak;
  row.evaluations = result.evaluations;
  row.jacobians = result.jacobian_evaluations;
  for (const std::string& reason : result.reasons) row.reasons += (row.reasons.empty() ? "" : "; ") + reason;

  const bool swapped = known.size() == 2 && misfit(known[0], found[1]) + misfit(known[1], found[0]) <
                                                misfit(known[0], found[0]) + misfit(known[1], found[1]);
  for (std::size_t s = 0; s < known.size(); ++s) {
    const sim::Sheet& is = known[s];
    const sim::Sheet& as_found = found[swapped ? 1 - s : s];
    SheetRow& sheet = row.sheet[s];
    sheet.energy_true_kev = is.energy_kev;
    sheet.energy_kev = as_found.energy_kev;
    sheet.energy_z = z_of_parameter(start, result, "sheet." + as_found.name + ".energy_kev", is.energy_kev);
    sheet.distance_true_km = fit::nearest_distance_km(is);
    sheet.distance_km = fit::nearest_distance_km(as_found);
    sheet.distance_z = z_of_distance(result, as_found.name, sheet.distance_true_km);
    sheet.bearing_true_deg = is.bearing_deg;
    sheet.bearing_deg = as_found.bearing_deg;
    sheet.thickness_true_km = is.thickness_km;
    sheet.thickness_km = as_found.thickness_km;
    sheet.wavelength_true_km = is.wavelength_km;
    sheet.wavelength_km = as_found.wavelength_km;
    sheet.waves_in_view = waves_in_view(truth.scene, static_cast<int>(s));
    sheet.width_true_km = is.width_km;
    sheet.width_km = as_found.width_km;
    const double border_nm = sim::border_line_nm(truth.scene, static_cast<int>(s));
    sheet.border_true_km = fit::lower_border_km(border_nm, truth.scene, static_cast<int>(s));
    sheet.border_km =
        fit::lower_border_km(border_nm, result.best, static_cast<int>(&as_found - found.data()));
    sheet.energy_trust = trust_in(result, "characteristic energy", as_found.name);
    sheet.distance_trust = trust_in(result, "distance", as_found.name);
    sheet.border_trust = trust_in(result, "lower border", as_found.name);
    sheet.bearing_trust = trust_in(result, "bearing", as_found.name);
    sheet.wavelength_trust = trust_in(result, "wavelength of", as_found.name);
    sheet.amplitude_trust = trust_in(result, "amplitude", as_found.name);
    sheet.length_trust = trust_in(result, "length", as_found.name);
    sheet.phase_trust = trust_in(result, "phase", as_found.name);
    for (const std::string& missed : missed_criteria(sheet))
      row.missed +=
          (row.missed.empty() ? "" : " ") + missed + (known.size() > 1 ? std::to_string(s + 1) : "");
  }
  row.recovered = row.missed.empty() ? 1 : 0;
  if (known.size() == 2) {
    const double first = known[0].energy_flux_mw_m2, second = known[1].energy_flux_mw_m2;
    row.ratio_true = second / first;
    row.ratio = found[swapped ? 0 : 1].energy_flux_mw_m2 / found[swapped ? 1 : 0].energy_flux_mw_m2;
    row.ratio_z = z_of_ratio(start, result, swapped, row.ratio_true);
  }
  return row;
}

}  // namespace vegard::scorecard
