#include "sim/light/tables/flux_law.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

#include "sim/base/number/spline.h"
#include "sim/scene/rows/value_words.h"

namespace vegard::sim {
namespace {

constexpr double kBackgroundEnergyKev = 10.0;  // both tables have it, and the lines are faint there
constexpr double kColumnRounding = 5e-5;       // of column_brightness.csv
constexpr double kLowestFlux = 0.1, kMiddleFlux = 1.0, kHighestFlux = 10.0;

/// Returns the rows of a table at one flux (all of them, if it has none) by energy.
std::map<double, std::size_t> rows_at(const CsvTable& table, double flux) {
  const std::vector<double>& energy = table.column("E0_keV");
  std::map<double, std::size_t> rows;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (!table.has("Q_erg") || table.column("Q_erg")[row] == flux) rows[energy[row]] = row;
  return rows;
}

/// Returns the row of an energy. Throws at the table's last row if there is none.
std::size_t row_at(const CsvTable& table, const std::map<double, std::size_t>& rows, double energy,
                   double flux) {
  const auto found = rows.find(energy);
  if (found == rows.end())
    throw table
        .bad_row(table.rows() - 1, "no row of " + short_real_text(energy) + " keV" +
                                       (table.has("Q_erg") ? " at Q_erg " + short_real_text(flux) : ""))
        .expected("one")
        .hint("it gives how light grows with the energy flux");
  return found->second;
}

/// Returns a function of ln Q through three values, and its slope: a linear function of them.
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

FluxFactors::FluxFactors(const std::vector<std::string>& columns, const CsvTable& brightness,
                         const CsvTable& linearity) {
  const std::map<double, std::size_t> at_one = rows_at(linearity, kMiddleFlux),
                                      alone = rows_at(brightness, 0.0);
  for (const auto& [energy, row] : at_one) {
    if (!(energy > 0.0))
      throw linearity.bad_row(row, "an energy that is not above 0").expected("keV above 0");
    energies_kev_.push_back(energy);
    log_energies_.push_back(std::log(energy));
  }
  if (at_one.size() < 2)
    throw linearity.bad_row(linearity.rows() - 1, "fewer than two energies at Q_erg 1")
        .expected("two or more");
  const std::size_t with_background = row_at(linearity, at_one, kBackgroundEnergyKev, kMiddleFlux);
  for (const std::string& column : columns) {
    const std::string name = "R_" + column.substr(column.find('_') + 1);
    const std::vector<double>& rayleigh = linearity.column(name);
    ColumnLaw& law = laws_[column];
    if (brightness.has(name)) {
      const double bare = brightness.column(name)[row_at(brightness, alone, kBackgroundEnergyKev, 0.0)];
      const double beyond = rayleigh[with_background] - bare;
      if (std::abs(beyond) > kColumnRounding * bare) law.background_rayleigh = beyond;
    }
    law.at_low = curve_of(linearity, name, kLowestFlux, law.background_rayleigh);
    law.at_high = curve_of(linearity, name, kHighestFlux, law.background_rayleigh);
  }
}

FluxFactors::FluxCurve FluxFactors::curve_of(const CsvTable& linearity, const std::string& name, double flux,
                                             double background) const {
  const std::vector<double>& rayleigh = linearity.column(name);
  const std::map<double, std::size_t> at_one = rows_at(linearity, kMiddleFlux),
                                      at_flux = rows_at(linearity, flux);
  FluxCurve curve;
  for (const auto& [energy, row] : at_one) {
    const std::size_t there = row_at(linearity, at_flux, energy, flux);
    for (const std::size_t each : {row, there})
      if (!(rayleigh[each] > background))
        throw linearity
            .bad_row(each, name + " is " + short_real_text(rayleigh[each]) +
                               ", no more than the light without electrons")
            .expected("above " + short_real_text(background));
    curve.log_factor.push_back(
        std::log((rayleigh[there] - background) / (flux * (rayleigh[row] - background))));
  }
  curve.curvature = spline_curvature(log_energies_, curve.log_factor);
  return curve;
}

FluxFactor FluxFactors::at(const std::string& column, double energy_kev, double energy_flux_mw_m2) const {
  const ColumnLaw& law = laws_.at(column);
  const double log_energy = std::log(energy_kev), log_flux = std::log(energy_flux_mw_m2);
  const auto at = [&](const FluxCurve& curve) {
    return spline_at(log_energies_, curve.log_factor, curve.curvature, log_energy);
  };
  const SplineValue low = at(law.at_low), high = at(law.at_high);
  const SplineValue factor = along_flux(low.value, 0.0, high.value, log_flux);
  return {factor.value, along_flux(low.slope, 0.0, high.slope, log_flux).value, factor.slope};
}

double FluxFactors::background_rayleigh(const std::string& column) const {
  return laws_.at(column).background_rayleigh;
}

}  // namespace vegard::sim
