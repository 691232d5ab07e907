#include "sim/light/tables/emission_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "sim/base/number/spline.h"
#include "sim/scene/rows/value_words.h"

namespace vegard::sim {
namespace {

constexpr double kTableFloorOfPeak = 1e-6;
constexpr std::size_t kMaxFactors = 16;
const std::string kFactorColumn = "oxygen_factor";
const std::string kAltitudeColumn = "altitude_km";

}  // namespace

EmissionTable::EmissionTable(const CsvTable& table, const std::string& energy_column) {
  read_places(table, energy_column);
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const std::string& name = table.columns[c];
    if (name != kFactorColumn && name != energy_column && name != kAltitudeColumn) read_rates(table, c);
  }
}

void EmissionTable::read_places(const CsvTable& table, const std::string& energy_column) {
  const std::vector<double>&energy = table.column(energy_column), &altitude = table.column(kAltitudeColumn);
  const std::size_t rows = table.rows();
  const std::vector<double> ones(table.has(kFactorColumn) ? 0 : rows, 1.0);
  const std::vector<double>& factor = table.has(kFactorColumn) ? table.column(kFactorColumn) : ones;
  for (std::size_t r = 0; r < rows && energy[r] == energy[0] && factor[r] == factor[0]; ++r)
    altitudes_km_.push_back(altitude[r]);
  const std::size_t altitudes = altitudes_km_.size();
  for (std::size_t r = 0; r < rows && factor[r] == factor[0]; r += altitudes)
    energies_kev_.push_back(energy[r]);
  const std::size_t of_factor = altitudes * energies_kev_.size();
  for (std::size_t r = 0; r < rows; r += of_factor) factors_.push_back(factor[r]);

  if (factors_.size() > kMaxFactors)
    throw table.bad_row(0, std::to_string(factors_.size()) + " oxygen factors").expected("16 at most");

  const auto place = [&](double f, double e, double a) {
    return (table.has(kFactorColumn) ? "oxygen factor " + short_real_text(f) + ", " : "") +
           short_real_text(e) + " keV, " + short_real_text(a) + " km";
  };
  for (std::size_t r = 0; r < rows; ++r) {
    const double f = factors_[r / of_factor], e = energies_kev_[r % of_factor / altitudes],
                 a = altitudes_km_[r % altitudes];
    if (factor[r] != f || energy[r] != e || altitude[r] != a)
      throw table.bad_row(r, place(factor[r], energy[r], altitude[r]) + " is out of the order")
          .expected(place(f, e, a))
          .hint("every energy has the same altitudes, and every oxygen factor the same energies");
    if (r % altitudes > 0 && !(a > altitudes_km_[r % altitudes - 1]))
      throw table.bad_row(r, "the altitude does not increase")
          .expected("altitudes of an energy from the bottom up");
    if (r % altitudes == 0 && r % of_factor > 0 && !(e > energies_kev_[r % of_factor / altitudes - 1]))
      throw table.bad_row(r, "the energy does not increase").expected("energies in increasing order");
    if (r % of_factor == 0 && !(f > (r == 0 ? 0.0 : factors_[r / of_factor - 1])))
      throw table.bad_row(r, "the oxygen factor does not increase")
          .expected("factors above 0 in increasing order");
  }
  const std::size_t last = rows - 1;
  if (rows % of_factor != 0)
    throw table.bad_row(last, "rows are missing after this one")
        .expected(std::to_string(altitudes) + " altitudes for each of " +
                  std::to_string(energies_kev_.size()) + " energies");
  if (altitudes < 2 || energies_kev_.size() < 2)
    throw table.bad_row(last, altitudes < 2 ? "a single altitude" : "a single energy")
        .expected("two or more");
  if (!(energies_kev_.front() > 0.0))
    throw table.bad_row(0, "an energy that is not above 0").expected("keV above 0");
  if (std::find(factors_.begin(), factors_.end(), 1.0) == factors_.end())
    throw table.bad_row(0, "no oxygen factor is 1").expected("factors such as 0.5, 1 and 2");
  for (const double knot : energies_kev_) log_energies_.push_back(std::log(knot));
}

void EmissionTable::read_rates(const CsvTable& table, std::size_t column) {
  const std::string& name = table.columns[column];
  table.require_within(name, 0.0, std::numeric_limits<double>::max());
  const std::vector<double>& values = table.numbers[column];
  const std::size_t energies = energies_kev_.size(), altitudes = altitudes_km_.size();
  std::vector<double>& logs = log_rate_[name];
  std::vector<double>& curvatures = log_curvature_[name];
  logs.resize(values.size());
  curvatures.resize(values.size());
  for (std::size_t block = 0; block < factors_.size() * energies; ++block) {
    const std::size_t f = block / energies, e = block % energies;
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(block * altitudes);
    const double floor =
        kTableFloorOfPeak * *std::max_element(first, first + static_cast<std::ptrdiff_t>(altitudes));
    for (std::size_t a = 0; a < altitudes; ++a)
      logs[(f * altitudes + a) * energies + e] =
          std::log(std::max({values[block * altitudes + a], floor, 1e-30}));
  }
  for (std::size_t row = 0; row < factors_.size() * altitudes; ++row) {
    const auto first = logs.begin() + static_cast<std::ptrdiff_t>(row * energies);
    const std::vector<double> by_energy(first, first + static_cast<std::ptrdiff_t>(energies));
    const std::vector<double> curvature = spline_curvature(log_energies_, by_energy);
    std::copy(curvature.begin(), curvature.end(),
              curvatures.begin() + static_cast<std::ptrdiff_t>(row * energies));
  }
}

std::vector<std::string> EmissionTable::columns() const {
  std::vector<std::string> names;
  for (const auto& [name, rates] : log_rate_) names.push_back(name);
  return names;
}

std::vector<Emission1d> EmissionTable::at_energy(const std::string& column, double energy_kev,
                                                 double oxygen_factor) const {
  const auto& logs = log_rate_.at(column);
  const auto& curvatures = log_curvature_.at(column);
  const std::size_t energies = energies_kev_.size(), altitudes = altitudes_km_.size();
  const double log_energy = std::log(energy_kev);
  const std::vector<SplineValue> weights = oxygen_weights(factors_, oxygen_factor);
  std::vector<Emission1d> profile(altitudes);
  for (std::size_t a = 0; a < altitudes; ++a) {
    double log_rate = 0.0, by_energy = 0.0, by_oxygen = 0.0;
    for (std::size_t f = 0; f < factors_.size(); ++f) {
      const std::size_t first = (f * altitudes + a) * energies;
      const SplineValue of_factor = spline_at(log_energies_, &logs[first], &curvatures[first], log_energy);
      log_rate += weights[f].value * of_factor.value;
      by_energy += weights[f].value * of_factor.slope;
      by_oxygen += weights[f].slope * of_factor.value;
    }
    const double rate = std::exp(log_rate);
    profile[a] = {rate, rate * by_energy, rate * by_oxygen};
  }
  return profile;
}

std::vector<SplineValue> oxygen_weights(const std::vector<double>& factors, double factor) {
  if (factors.size() == 1) return {{1.0, 0.0}};
  std::vector<double> log_factors;
  for (const double knot : factors) log_factors.push_back(std::log(knot));
  const double log_factor = std::log(factor),
               held = std::clamp(log_factor, log_factors.front(), log_factors.back());
  std::vector<SplineValue> weights;
  for (std::size_t f = 0; f < factors.size(); ++f) {
    std::vector<double> one(factors.size(), 0.0);
    one[f] = 1.0;
    SplineValue weight = spline_at(log_factors, one, spline_curvature(log_factors, one), held);
    weight.value += weight.slope * (log_factor - held);
    weights.push_back(weight);
  }
  return weights;
}

}  // namespace vegard::sim
