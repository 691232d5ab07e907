#include "tests/recovery/scorecard/score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

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

namespace {

using Which = std::function<bool(const Row&)>;

std::vector<std::string> missed(const Row& row) {
  std::vector<std::string> all;
  for (int s = 0; s < row.sheets; ++s)
    for (const std::string& name : missed_criteria(row.sheet[s])) all.push_back(name);
  return all;
}

bool recovered(const Row& row) { return missed(row).empty(); }

/// "12 of 20 | 60 ± 11 %": a share with its binomial standard error.
std::string share_cells(int hits, int of) {
  if (of == 0) return "0 of 0 | –";
  const double p = static_cast<double>(hits) / of;
  return fmt::format("{} of {} | {:.1f} ± {:.1f} %", hits, of, 100.0 * p,
                     100.0 * std::sqrt(p * (1.0 - p) / of));
}

std::string by_class(const std::vector<Row>& rows) {
  const std::vector<std::pair<std::string, Which>> classes = {
      {"all", [](const Row&) { return true; }},
      {"beams", [](const Row& r) { return r.line_of_sight == 0; }},
      {"lines of sight", [](const Row& r) { return r.line_of_sight != 0; }},
      {"one sheet", [](const Row& r) { return r.sheets == 1; }},
      {"two sheets", [](const Row& r) { return r.sheets == 2; }},
      {"with rays", [](const Row& r) { return r.rays != 0; }},
      {"without rays", [](const Row& r) { return r.rays == 0; }},
      {"with folds", [](const Row& r) { return r.folds != 0; }},
      {"without folds", [](const Row& r) { return r.folds == 0; }},
  };
  std::string text = "| scenes | recovered | share |\n|---|---|---|\n";
  for (const auto& [name, which] : classes) {
    const auto of = std::count_if(rows.begin(), rows.end(), which);
    const auto hits = std::count_if(rows.begin(), rows.end(),
                                    [&, &is = which](const Row& r) { return is(r) && recovered(r); });
    text += fmt::format("| {} | {} |\n", name, share_cells(static_cast<int>(hits), static_cast<int>(of)));
  }
  return text;
}

std::string by_criterion(const std::vector<Row>& rows) {
  std::map<std::string, int> misses;
  int sheets = 0, with_waves = 0;
  for (const Row& row : rows)
    for (int s = 0; s < row.sheets; ++s) {
      ++sheets;
      if (row.sheet[s].waves_in_view >= Criteria::kWavesInView) ++with_waves;
      for (const std::string& name : missed_criteria(row.sheet[s])) ++misses[name];
    }
  std::string text = "| criterion, per sheet | met | share |\n|---|---|---|\n";
  for (const char* name : {"E0", "distance", "bearing", "wavelength", "amplitude"}) {
    const int of = std::string(name) == "wavelength" ? with_waves : sheets;
    text += fmt::format("| {} | {} |\n", name, share_cells(of - misses[name], of));
  }
  return text;
}

std::string confusion(const std::vector<Row>& rows) {
  std::string text = "| verdict | recovered | not recovered |\n|---|---|---|\n";
  int told[2] = {0, 0}, all[2] = {0, 0};
  for (const char* verdict : {"good", "doubtful", "failed", "interrupted"}) {
    int counts[2] = {0, 0};
    for (const Row& row : rows)
      if (row.verdict == verdict) ++counts[recovered(row) ? 0 : 1];
    for (int i = 0; i < 2; ++i) {
      all[i] += counts[i];
      if (std::string(verdict) != "good") told[i] += counts[i];
    }
    if (counts[0] + counts[1] > 0) text += fmt::format("| {} | {} | {} |\n", verdict, counts[0], counts[1]);
  }
  return text + "\n| | count | share |\n|---|---|---|\n| recovered, but not called good | " +
         share_cells(told[0], all[0]) + " |\n| not recovered, and not called good | " +
         share_cells(told[1], all[1]) + " |\n";
}

/// Of each quantity of each sheet: how often it was called good where it is right, and where it is wrong.
std::string trust_by_quantity(const std::vector<Row>& rows) {
  struct Asked {
    const char* name;
    bool (*is_right)(const SheetRow&);
    std::string SheetRow::*trust;
  };
  static const auto meets = [](const SheetRow& sheet, const char* criterion) {
    const std::vector<std::string> all = missed_criteria(sheet);
    return std::find(all.begin(), all.end(), criterion) == all.end();
  };
  const Asked all[] = {
      {"E0", [](const SheetRow& s) { return meets(s, "E0"); }, &SheetRow::energy_trust},
      {"distance", [](const SheetRow& s) { return meets(s, "distance"); }, &SheetRow::distance_trust},
      {"lower border",
       [](const SheetRow& s) { return std::abs(s.border_km - s.border_true_km) <= Criteria::kBorder_km; },
       &SheetRow::border_trust},
      {"bearing", [](const SheetRow& s) { return meets(s, "bearing"); }, &SheetRow::bearing_trust},
      {"wavelength", [](const SheetRow& s) { return meets(s, "wavelength"); }, &SheetRow::wavelength_trust},
      {"amplitude", [](const SheetRow& s) { return meets(s, "amplitude"); }, &SheetRow::amplitude_trust}};
  std::string text =
      "| quantity, per sheet | not called good where right | share | not called good where wrong | share "
      "|\n|---|---|---|---|---|\n";
  for (const Asked& asked : all) {
    int doubted[2] = {0, 0}, of[2] = {0, 0};
    for (const Row& row : rows)
      for (int s = 0; s < row.sheets; ++s) {
        const int wrong = asked.is_right(row.sheet[s]) ? 0 : 1;
        ++of[wrong];
        if (row.sheet[s].*asked.trust != "good") ++doubted[wrong];
      }
    text += fmt::format("| {} | {} | {} |\n", asked.name, share_cells(doubted[0], of[0]),
                        share_cells(doubted[1], of[1]));
  }
  // Only the ends of a sheet tell these, which stand outside of most pictures.
  for (const auto& [name, trust] :
       {std::pair("length", &SheetRow::length_trust), {"phase", &SheetRow::phase_trust}}) {
    int told[3] = {0, 0, 0}, asked = 0;
    for (const Row& row : rows)
      for (int s = 0; s < row.sheets; ++s) {
        const std::string& word = row.sheet[s].*trust;
        if (word.empty()) continue;
        ++asked;
        ++told[word == "good" ? 0 : word == "doubtful" ? 1 : 2];
      }
    if (asked > 0)
      text += fmt::format("\n{} of {} sheets: good {}, doubtful {}, unconstrained {}\n", name, asked, told[0],
                          told[1], told[2]);
  }
  return text;
}

std::string coverage(const std::vector<Row>& rows, const std::string& title, const Which& which) {
  struct Number {
    const char* name;
    std::vector<double> z;
    int without = 0;
    void take(double value) {
      if (std::isfinite(value))
        z.push_back(value);
      else
        ++without;
    }
  };
  Number numbers[3] = {{"E0", {}}, {"distance", {}}, {"brightness ratio", {}}};
  for (const Row& row : rows) {
    if (!which(row)) continue;
    for (int s = 0; s < row.sheets; ++s) {
      numbers[0].take(row.sheet[s].energy_z);
      numbers[1].take(row.sheet[s].distance_z);
    }
    if (row.sheets == 2) numbers[2].take(row.ratio_z);
  }
  std::string text = "| " + title +
                     " | in 68 % | share | in 95 % | share | mean z | rms z | without an interval "
                     "|\n|---|---|---|---|---|---|---|---|\n";
  for (const Number& number : numbers) {
    constexpr double k68 = 1.0, k95 = 1.959964;
    const int n = static_cast<int>(number.z.size());
    const auto inside = [&](double most) {
      return static_cast<int>(
          std::count_if(number.z.begin(), number.z.end(), [most](double z) { return std::abs(z) <= most; }));
    };
    double sum = 0.0, squares = 0.0;
    for (const double z : number.z) {
      sum += z;
      squares += z * z;
    }
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", number.name, share_cells(inside(k68), n),
                        share_cells(inside(k95), n), n > 0 ? fmt::format("{:.2f}", sum / n) : "–",
                        n > 0 ? fmt::format("{:.2f}", std::sqrt(squares / n)) : "–", number.without);
  }
  return text;
}

double median(std::vector<double> values) {
  if (values.empty()) return kNone;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

std::string cost(const std::vector<Row>& rows) {
  std::string text =
      "| sheets | scenes | median evaluations | with a Jacobian | seconds of one thread | chi² / dof |\n"
      "|---|---|---|---|---|---|\n";
  for (const int sheets : {1, 2}) {
    std::vector<double> evaluations, jacobians, seconds, chi2;
    for (const Row& row : rows) {
      if (row.sheets != sheets) continue;
      evaluations.push_back(row.evaluations);
      jacobians.push_back(row.jacobians);
      seconds.push_back(row.seconds);
      chi2.push_back(row.chi2_per_dof);
    }
    text += fmt::format("| {} | {} | {:.0f} | {:.0f} | {:.1f} | {:.2f} |\n", sheets, evaluations.size(),
                        median(evaluations), median(jacobians), median(seconds), median(chi2));
  }
  return text;
}

std::string failures(const std::vector<Row>& rows) {
  std::string text =
      "| scene | sheets | drawn by | rays | folds | verdict | missed | E0, true / found (keV) | distance "
      "(km) | "
      "bearing (°) | wavelength (km) | amplitude (km) | waves in view | chi² / dof |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    if (recovered(row)) continue;
    const auto pairs = [&](double SheetRow::*is, double SheetRow::*found, const char* format) {
      std::string cell;
      for (int s = 0; s < row.sheets; ++s)
        cell += (s > 0 ? ", " : "") + fmt::format(fmt::runtime(format), row.sheet[s].*is) + " / " +
                fmt::format(fmt::runtime(format), row.sheet[s].*found);
      return cell;
    };
    std::string waves;
    for (int s = 0; s < row.sheets; ++s)
      waves += (s > 0 ? ", " : "") + fmt::format("{:.1f}", row.sheet[s].waves_in_view);
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.2f} |\n",
                        row.scene, row.sheets, row.line_of_sight ? "lines of sight" : "beams",
                        row.rays ? "yes" : "no", row.folds ? "yes" : "no", row.verdict, row.missed,
                        pairs(&SheetRow::energy_true_kev, &SheetRow::energy_kev, "{:.2f}"),
                        pairs(&SheetRow::distance_true_km, &SheetRow::distance_km, "{:.1f}"),
                        pairs(&SheetRow::bearing_true_deg, &SheetRow::bearing_deg, "{:.1f}"),
                        pairs(&SheetRow::wavelength_true_km, &SheetRow::wavelength_km, "{:.1f}"),
                        pairs(&SheetRow::thickness_true_km, &SheetRow::thickness_km, "{:.2f}"), waves,
                        row.chi2_per_dof);
  }
  return text;
}

}  // namespace

std::string summary(const std::vector<Row>& rows) {
  return by_class(rows) + "\n" + by_criterion(rows) + "\n" + confusion(rows) + "\n" +
         trust_by_quantity(rows) + "\n" + coverage(rows, "recovered", recovered) + "\n" +
         coverage(rows, "called good", [](const Row& r) { return r.verdict == "good"; }) + "\n" +
         coverage(rows, "all", [](const Row&) { return true; }) + "\n" + cost(rows) + "\nNot recovered:\n\n" +
         failures(rows);
}

}  // namespace vegard::scorecard
