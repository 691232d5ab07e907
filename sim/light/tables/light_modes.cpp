#include "sim/light/tables/light_modes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sim/scene/rows/value_words.h"

namespace vegard::sim {
namespace {

const std::string kModeColumn = "mode", kModeEnergyColumn = "E0_keV", kModeAltitudeColumn = "altitude_km";
constexpr double kMostOfMode = 20.0;  // of a logarithm; far beyond any

/// A place between two knots: the share of the upper one, and its derivative by the coordinate.
struct Between {
  std::size_t lower = 0;
  double upper_share = 0.0, slope = 0.0;
};

Between between(const std::vector<double>& knots, double x) {
  if (knots.size() < 2 || x <= knots.front()) return {};
  if (x >= knots.back()) return {knots.size() - 2, 1.0, 0.0};
  const auto after = std::upper_bound(knots.begin(), knots.end(), x);
  const auto upper = static_cast<std::size_t>(after - knots.begin());
  const double width = knots[upper] - knots[upper - 1];
  return {upper - 1, (x - knots[upper - 1]) / width, 1.0 / width};
}

}  // namespace

LightModes::LightModes(const CsvTable& table) {
  const std::vector<double>&mode = table.column(kModeColumn), &energy = table.column(kModeEnergyColumn),
        &altitude = table.column(kModeAltitudeColumn);
  const std::size_t rows = table.rows();
  for (std::size_t r = 0; r < rows && mode[r] == mode[0] && energy[r] == energy[0]; ++r)
    altitudes_km_.push_back(altitude[r]);
  const std::size_t altitudes = altitudes_km_.size();
  std::vector<double> energies;
  for (std::size_t r = 0; r < rows && mode[r] == mode[0]; r += altitudes) energies.push_back(energy[r]);
  const std::size_t of_mode = altitudes * energies.size();
  count_ = static_cast<int>((rows + of_mode - 1) / of_mode);
  if (count_ > kMaxLightModes)
    throw table.bad_row(0, std::to_string(count_) + " modes")
        .expected(std::to_string(kMaxLightModes) + " at most");
  for (std::size_t r = 0; r < rows; ++r) {
    const double m = static_cast<double>(r / of_mode + 1), e = energies[r % of_mode / altitudes],
                 a = altitudes_km_[r % altitudes];
    if (mode[r] != m || energy[r] != e || altitude[r] != a)
      throw table
          .bad_row(r, "mode " + short_real_text(mode[r]) + ", " + short_real_text(energy[r]) + " keV, " +
                          short_real_text(altitude[r]) + " km is out of the order")
          .expected("mode " + short_real_text(m) + ", " + short_real_text(e) + " keV, " + short_real_text(a) +
                    " km");
  }
  if (rows % of_mode != 0)
    throw table.bad_row(rows - 1, "rows are missing after this one")
        .expected(std::to_string(altitudes) + " altitudes for each of " + std::to_string(energies.size()) +
                  " energies");
  if (altitudes < 2 || energies.size() < 2 || !(energies.front() > 0.0) ||
      !std::is_sorted(energies.begin(), energies.end()) ||
      !std::is_sorted(altitudes_km_.begin(), altitudes_km_.end()))
    throw table.bad_row(0, "the energies or altitudes do not increase")
        .expected("two or more of each in increasing order");
  for (const double e : energies) log_energies_.push_back(std::log(e));
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const std::string& name = table.columns[c];
    if (name == kModeColumn || name == kModeEnergyColumn || name == kModeAltitudeColumn) continue;
    table.require_within(name, -kMostOfMode, kMostOfMode);
    values_[name] = table.numbers[c];
  }
}

std::vector<ModeValue> LightModes::at(int mode, const std::string& column, double energy_kev,
                                      const std::vector<double>& altitudes_km) const {
  std::vector<ModeValue> result(altitudes_km.size());
  const auto found = values_.find(column);
  if (found == values_.end()) return result;
  const std::size_t altitudes = altitudes_km_.size();
  const Between e = between(log_energies_, std::log(energy_kev));
  const double* low =
      &found->second[(static_cast<std::size_t>(mode) * log_energies_.size() + e.lower) * altitudes];
  const double* high = low + altitudes;
  for (std::size_t i = 0; i < altitudes_km.size(); ++i) {
    const Between a = between(altitudes_km_, altitudes_km[i]);
    const auto on = [&](const double* row) {
      return row[a.lower] + a.upper_share * (row[a.lower + 1] - row[a.lower]);
    };
    const double below = on(low), above = on(high);
    result[i] = {below + e.upper_share * (above - below), e.slope * (above - below)};
  }
  return result;
}

}  // namespace vegard::sim
