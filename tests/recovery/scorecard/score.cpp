#include "tests/recovery/scorecard/score.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/answer/derived.h"
#include "fit/parameters/free_parameters.h"
#include "sim/base/number/constants.h"
#include "sim/emit/aurora/beam.h"
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

double z_of_distance(const fit::FitResult& result, const std::string& sheet, double truth_km) {
  for (const fit::DerivedNumber& d : result.derived)
    if (d.name == "distance of the " + sheet + " sheet" && d.sigma) return (d.value - truth_km) / *d.sigma;
  return kNone;
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
    for (const std::string& missed : missed_criteria(sheet))
      row.missed +=
          (row.missed.empty() ? "" : " ") + missed + (known.size() > 1 ? std::to_string(s + 1) : "");
  }
  row.recovered = row.missed.empty() ? 1 : 0;
  if (known.size() == 2) {
    const double first = known[0].energy_flux_mw_m2, second = known[1].energy_flux_mw_m2;
    row.ratio_true = second / first;
    row.ratio = found[swapped ? 0 : 1].energy_flux_mw_m2 / found[swapped ? 1 : 0].energy_flux_mw_m2;
    // The flux that is free is that of the fit's second sheet.
    const double held = start.sheets[0].energy_flux_mw_m2;
    const double z = z_of_parameter(start, result, "sheet." + start.sheets[1].name + ".energy_flux_mw_m2",
                                    held * (swapped ? first / second : second / first));
    row.ratio_z = swapped ? -z : z;
  }
  return row;
}

}  // namespace vegard::scorecard
