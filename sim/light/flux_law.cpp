#include "sim/light/flux_law.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

#include "sim/base/file/csv_table.h"
#include "sim/base/number/spline.h"

namespace vegard::sim {
namespace {

constexpr double kBackgroundEnergyKev = 10.0;  // both tables have it, and the lines are faint there
constexpr double kColumnRounding = 5e-5;       // of column_brightness.csv
constexpr double kLowestFlux = 0.1, kHighestFlux = 10.0;

struct FluxCurve {
  std::vector<double> log_factor, curvature;  ///< at the energies
};

struct ColumnLaw {
  double background_rayleigh = 0.0;
  std::vector<double> log_energy;
  FluxCurve at_low, at_high;
};

/// R_5577 of a table at one flux (or, of a table without, at all rows) by energy.
std::map<double, double> columns_at(const CsvTable& table, const std::string& name, double flux) {
  std::map<double, double> columns;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (!table.has("Q_erg") || table.column("Q_erg")[row] == flux)
      columns[table.column("E0_keV")[row]] = table.column(name)[row];
  return columns;
}

FluxCurve curve_of(const std::vector<double>& log_energy, const std::map<double, double>& at_flux,
                   double flux, const std::map<double, double>& at_one, double background) {
  FluxCurve curve;
  for (const auto& [energy, column] : at_one)
    curve.log_factor.push_back(std::log((at_flux.at(energy) - background) / (flux * (column - background))));
  curve.curvature = spline_curvature(log_energy, curve.log_factor);
  return curve;
}

std::map<std::string, ColumnLaw> read_laws() {
  const CsvTable linearity = embedded_csv_table("linearity_Q.csv");
  const CsvTable brightness = embedded_csv_table("column_brightness.csv");
  std::map<std::string, ColumnLaw> laws;
  for (const std::string& name : brightness.columns) {
    if (name.substr(0, 2) != "R_") continue;
    ColumnLaw& law = laws["ver_" + name.substr(2)];
    const std::map<double, double> at_one = columns_at(linearity, name, 1.0);
    const double alone = columns_at(brightness, name, 1.0).at(kBackgroundEnergyKev);
    const double beyond = at_one.at(kBackgroundEnergyKev) - alone;
    if (std::abs(beyond) > kColumnRounding * alone) law.background_rayleigh = beyond;
    for (const auto& [energy, column] : at_one) law.log_energy.push_back(std::log(energy));
    law.at_low = curve_of(law.log_energy, columns_at(linearity, name, kLowestFlux), kLowestFlux, at_one,
                          law.background_rayleigh);
    law.at_high = curve_of(law.log_energy, columns_at(linearity, name, kHighestFlux), kHighestFlux, at_one,
                           law.background_rayleigh);
  }
  return laws;
}

const ColumnLaw& law_of(const std::string& column) {
  static const std::map<std::string, ColumnLaw> laws = read_laws();
  assert(laws.count(column) > 0);
  return laws.at(column);
}

/// A function of ln Q through three values, and its slope: a linear function of them.
SplineValue along_flux(double low, double middle, double high, double log_flux) {
  static const std::vector<double> knots = {std::log(kLowestFlux), 0.0, std::log(kHighestFlux)};
  const std::vector<double> values = {low, middle, high}, curvature = spline_curvature(knots, values);
  const auto levelled = [&](double end) {
    const SplineValue there = spline_at(knots, values, curvature, end);
    const double rise = std::tanh(log_flux - end);
    return SplineValue{there.value + there.slope * rise, there.slope * (1.0 - rise * rise)};
  };
  if (log_flux < knots.front()) return levelled(knots.front());
  if (log_flux > knots.back()) return levelled(knots.back());
  return spline_at(knots, values, curvature, log_flux);
}

}  // namespace

FluxFactor flux_factor(const std::string& column, double energy_kev, double energy_flux_mw_m2) {
  const ColumnLaw& law = law_of(column);
  const double log_energy = std::log(energy_kev), log_flux = std::log(energy_flux_mw_m2);
  const auto at = [&](const FluxCurve& curve) {
    return spline_at(law.log_energy, curve.log_factor, curve.curvature, log_energy);
  };
  const SplineValue low = at(law.at_low), high = at(law.at_high);
  const SplineValue factor = along_flux(low.value, 0.0, high.value, log_flux);
  return {factor.value, along_flux(low.slope, 0.0, high.slope, log_flux).value, factor.slope};
}

double background_rayleigh(const std::string& column) { return law_of(column).background_rayleigh; }

}  // namespace vegard::sim
