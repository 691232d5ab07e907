#include "fit/map/lower_border.h"

#include <algorithm>
#include <cmath>

#include "sim/light/tables/emission_tables.h"

namespace vegard::fit {
namespace lower_border_table {
namespace {

constexpr int kNodes = 34;
constexpr double kLeast = -1.9, kStep = 0.16;  // of ln(E0/keV): 0.15 to 29 keV

}  // namespace
}  // namespace lower_border_table

LowerBorder lower_border(const sim::Scene& scene, double energy_kev, const sim::ElectronSpectrum& spectrum) {
  std::size_t line = 0;
  for (std::size_t l = 0; l < scene.emission.lines.size(); ++l)
    if (std::abs(scene.emission.lines[l] - 557.7) < 0.5) line = l;
  const auto border = [&](double energy) {
    const sim::HeightProfile profile =
        sim::electron_profile(sim::emission_source(scene), {scene.emission.lines[line]}, spectrum, energy);
    int peak = 0;
    const auto rate = [&](int row) { return profile.rate[static_cast<std::size_t>(row) * profile.stride]; };
    for (int row = 1; row < sim::HeightProfile::kAltitudes; ++row)
      if (rate(row) > rate(peak)) peak = row;
    int row = peak;
    while (row > 0 && rate(row) > 0.5f * rate(peak)) --row;
    const double t = row < peak ? (0.5 * rate(peak) - rate(row)) / (rate(row + 1) - rate(row)) : 0.0;
    return sim::HeightProfile::altitude_km(row + t);
  };
  constexpr double kStep = 0.05;
  // Inside the tables of Maxwellian electrons, and others at their mean energies.
  const double scale = sim::mean_energy_over_e0({}) / sim::mean_energy_over_e0(spectrum);
  const double least = 0.11 * scale, most = 19.0 * scale;
  const double low = std::max(energy_kev * std::exp(-kStep), least),
               high = std::min(energy_kev * std::exp(kStep), most);
  return {border(std::clamp(energy_kev, least, most)), (border(high) - border(low)) / std::log(high / low)};
}

LowerBorderTable::LowerBorderTable(const sim::Scene& scene, const sim::ElectronSpectrum& spectrum) {
  using namespace lower_border_table;
  for (int k = 0; k < kNodes; ++k)
    border_km_.push_back(lower_border(scene, std::exp(kLeast + k * kStep), spectrum).altitude_km);
}

double LowerBorderTable::altitude_km(double energy_kev) const {
  using namespace lower_border_table;
  const double x = std::clamp((std::log(energy_kev) - kLeast) / kStep, 0.0, kNodes - 1.001);
  const auto i = static_cast<std::size_t>(x);
  return border_km_[i] + (x - static_cast<double>(i)) * (border_km_[i + 1] - border_km_[i]);
}

}  // namespace vegard::fit
