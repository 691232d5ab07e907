#include "sim/light/emission_table.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/base/embedded_table.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/number/spline.h"

namespace vegard::sim {
namespace {

constexpr double kTableFloorOfPeak = 1e-6;

}  // namespace

const EmissionTable& EmissionTable::glow() {
  static const EmissionTable table{std::string(embedded_table("ver_maxwellian.csv"))};
  return table;
}

EmissionTable::EmissionTable(const std::string& csv) {
  const CsvTable table = read_csv_table(csv, "ver_maxwellian.csv");
  const std::vector<double>&energy = table.numbers.at(0), &altitude = table.numbers.at(1);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (energies_kev_.empty() || energies_kev_.back() != energy[row]) energies_kev_.push_back(energy[row]);
    if (energies_kev_.size() == 1) altitudes_km_.push_back(altitude[row]);
  }
  for (const double knot : energies_kev_) log_energies_.push_back(std::log(knot));
  const std::size_t energies = energies_kev_.size(), altitudes = altitudes_km_.size();
  for (std::size_t c = 2; c < table.columns.size(); ++c) {
    const std::string& name = table.columns[c];
    const std::vector<double>& values = table.numbers[c];
    if (values.size() != energies * altitudes)
      throw std::runtime_error("the emission table has a missing row");
    std::vector<double>& logs = log_rate_[name];
    std::vector<double>& curvatures = log_curvature_[name];
    logs.resize(energies * altitudes);
    curvatures.resize(energies * altitudes);
    for (std::size_t e = 0; e < energies; ++e) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(e * altitudes);
      const double floor =
          kTableFloorOfPeak * *std::max_element(first, first + static_cast<std::ptrdiff_t>(altitudes));
      for (std::size_t a = 0; a < altitudes; ++a)
        logs[a * energies + e] = std::log(std::max({values[e * altitudes + a], floor, 1e-30}));
    }
    for (std::size_t a = 0; a < altitudes; ++a) {
      const auto first = logs.begin() + static_cast<std::ptrdiff_t>(a * energies);
      const std::vector<double> column(first, first + static_cast<std::ptrdiff_t>(energies));
      const std::vector<double> curvature = spline_curvature(log_energies_, column);
      std::copy(curvature.begin(), curvature.end(),
                curvatures.begin() + static_cast<std::ptrdiff_t>(a * energies));
    }
  }
}

std::vector<Emission1d> EmissionTable::at_energy(const std::string& column, double energy_kev) const {
  const auto& logs = log_rate_.at(column);
  const auto& curvatures = log_curvature_.at(column);
  const std::size_t energies = energies_kev_.size();
  std::vector<Emission1d> profile(altitudes_km_.size());
  for (std::size_t a = 0; a < profile.size(); ++a) {
    const auto first = static_cast<std::ptrdiff_t>(a * energies),
               last = first + static_cast<std::ptrdiff_t>(energies);
    const SplineValue log_rate =
        spline_at(log_energies_, {logs.begin() + first, logs.begin() + last},
                  {curvatures.begin() + first, curvatures.begin() + last}, std::log(energy_kev));
    profile[a].rate = std::exp(log_rate.value);
    profile[a].d_rate_d_ln_energy = profile[a].rate * log_rate.slope;
  }
  return profile;
}

}  // namespace vegard::sim
