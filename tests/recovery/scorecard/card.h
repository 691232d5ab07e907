// One row of the scorecard per scene, as CSV.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace vegard::scorecard {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A sheet as it is and as it was found. z: (found - true) / standard deviation, in the solver's coordinate
/// for what is a parameter; kNone without an error bar.
struct SheetRow {
  double energy_true_kev = kNone, energy_kev = kNone, energy_z = kNone;
  double distance_true_km = kNone, distance_km = kNone, distance_z = kNone;
  double bearing_true_deg = kNone, bearing_deg = kNone;
  double thickness_true_km = kNone, thickness_km = kNone;
  double wavelength_true_km = kNone, wavelength_km = kNone;
  double waves_in_view = kNone;
  double width_true_km = kNone, width_km = kNone;
  double border_true_km = kNone, border_km = kNone;  ///< altitude of the lower border
  std::string energy_trust, distance_trust, border_trust, bearing_trust, wavelength_trust, amplitude_trust,
      length_trust, phase_trust;  ///< trust_name() of what was derived
};

struct Row {
  int scene = 0;
  std::string set;
  int line_of_sight = 0, sheets = 1, rays = 0, folds = 0;
  std::string verdict;
  int recovered = 0;
  std::string missed;                                         ///< criteria, as missed_criteria() names them
  double ratio_true = kNone, ratio = kNone, ratio_z = kNone;  ///< energy flux of the second over the first
  double chi2 = kNone, chi2_per_dof = kNone, inflation = kNone, rms_over_peak = kNone;
  int evaluations = 0, jacobians = 0;
  double seconds = 0.0;
  std::array<SheetRow, 2> sheet;
  std::string reasons;
};

/// Calls see(name, value) for every column in its order.
template <class AnyRow, class See>
void each_column(AnyRow& row, const See& see) {
  see("scene", row.scene);
  see("set", row.set);
  see("line_of_sight", row.line_of_sight);
  see("sheets", row.sheets);
  see("rays", row.rays);
  see("folds", row.folds);
  see("verdict", row.verdict);
  see("recovered", row.recovered);
  see("missed", row.missed);
  see("ratio_true", row.ratio_true);
  see("ratio", row.ratio);
  see("ratio_z", row.ratio_z);
  see("chi2", row.chi2);
  see("chi2_per_dof", row.chi2_per_dof);
  see("inflation", row.inflation);
  see("rms_over_peak", row.rms_over_peak);
  see("evaluations", row.evaluations);
  see("jacobians", row.jacobians);
  see("seconds", row.seconds);
  for (int s = 0; s < 2; ++s) {
    auto& sheet = row.sheet[s];
    const std::string of = s == 0 ? "first." : "second.";
    see(of + "energy_true_kev", sheet.energy_true_kev);
    see(of + "energy_kev", sheet.energy_kev);
    see(of + "energy_z", sheet.energy_z);
    see(of + "distance_true_km", sheet.distance_true_km);
    see(of + "distance_km", sheet.distance_km);
    see(of + "distance_z", sheet.distance_z);
    see(of + "bearing_true_deg", sheet.bearing_true_deg);
    see(of + "bearing_deg", sheet.bearing_deg);
    see(of + "thickness_true_km", sheet.thickness_true_km);
    see(of + "thickness_km", sheet.thickness_km);
    see(of + "wavelength_true_km", sheet.wavelength_true_km);
    see(of + "wavelength_km", sheet.wavelength_km);
    see(of + "waves_in_view", sheet.waves_in_view);
    see(of + "width_true_km", sheet.width_true_km);
    see(of + "width_km", sheet.width_km);
    see(of + "border_true_km", sheet.border_true_km);
    see(of + "border_km", sheet.border_km);
    see(of + "energy_trust", sheet.energy_trust);
    see(of + "distance_trust", sheet.distance_trust);
    see(of + "border_trust", sheet.border_trust);
    see(of + "bearing_trust", sheet.bearing_trust);
    see(of + "wavelength_trust", sheet.wavelength_trust);
    see(of + "amplitude_trust", sheet.amplitude_trust);
    see(of + "length_trust", sheet.length_trust);
    see(of + "phase_trust", sheet.phase_trust);
  }
  see("reasons", row.reasons);
}

/// With the line's end.
std::string csv_header();
std::string csv_row(const Row& row);

/// The rows of a card written so. Throws std::runtime_error for a file that is none.
std::vector<Row> read_card(const std::string& file);

}  // namespace vegard::scorecard
