#include "sim/light/chemistry/physics_draw.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "sim/base/file/csv_table.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"

namespace vegard::sim {
namespace {

/// The numbers of the column `table`.
enum class Uncertain { reactions = 1, processes, air };

constexpr double kHeldKm = 100.0;  // where a change of the temperature leaves the densities

double factor_of(const std::map<UncertainAir, double>& factors, UncertainAir which) {
  const auto found = factors.find(which);
  return found == factors.end() ? 1.0 : found->second;
}

/// Stretches the logarithms of a density above kHeldKm by 1/`temperature`.
void stretch(const std::vector<double>& altitude_km, double temperature, std::vector<double>& density) {
  const auto held = std::lower_bound(altitude_km.begin(), altitude_km.end(), kHeldKm);
  if (held == altitude_km.end()) return;
  const auto first = static_cast<std::size_t>(held - altitude_km.begin());
  const double reference = density[first];
  if (reference <= 0.0) return;
  for (std::size_t i = first; i < density.size(); ++i)
    if (density[i] > 0.0) density[i] = reference * std::pow(density[i] / reference, 1.0 / temperature);
}

}  // namespace

PhysicsDraw draw_physics(std::uint64_t seed, std::uint32_t draw) {
  static const CsvTable table = embedded_csv_table("uncertainties.csv");
  const auto &tables = table.column("table"), &numbers = table.column("number"),
             &sigmas = table.column("ln_sigma");
  PhysicsDraw drawn;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    const auto which = static_cast<Uncertain>(static_cast<int>(tables[r]));
    const int number = static_cast<int>(numbers[r]);
    const Words words = random_words(seed, Stream::physics, draw, static_cast<std::uint32_t>(tables[r]),
                                     static_cast<std::uint32_t>(number));
    const double factor = std::exp(sigmas[r] * normal_quantile(uniform(words[0])));
    if (which == Uncertain::reactions)
      drawn.reactions[number] = factor;
    else if (which == Uncertain::processes)
      drawn.processes[number] = factor;
    else
      drawn.of_the_air[static_cast<UncertainAir>(number)] = factor;
  }
  return drawn;
}

AirTable changed_air(AirTable table, const std::map<UncertainAir, double>& factors) {
  const double temperature = factor_of(factors, UncertainAir::temperature),
               density = factor_of(factors, UncertainAir::density),
               oxygen = factor_of(factors, UncertainAir::oxygen),
               nitric_oxide = factor_of(factors, UncertainAir::nitric_oxide),
               excess = factor_of(factors, UncertainAir::electron_temperature);
  // What the table leaves to usual values is written down first, as these belong to the unchanged air.
  if (table.no_cm3.empty())
    for (const double altitude : table.altitude_km) table.no_cm3.push_back(nitric_oxide_cm3(altitude));
  if (table.electron_temperature_k.empty())
    for (std::size_t i = 0; i < table.altitude_km.size(); ++i)
      table.electron_temperature_k.push_back(
          electron_temperature_k(table.altitude_km[i], table.temperature_k[i]));
  for (std::size_t i = 0; i < table.altitude_km.size(); ++i) {
    const double above_air = table.electron_temperature_k[i] - table.temperature_k[i];
    if (table.altitude_km[i] >= kHeldKm) table.temperature_k[i] *= temperature;
    table.electron_temperature_k[i] = table.temperature_k[i] + excess * above_air;
    table.no_cm3[i] *= nitric_oxide;
  }
  for (std::vector<double>& gas : table.density_cm3) {
    stretch(table.altitude_km, temperature, gas);
    for (double& n : gas) n *= density;
  }
  return with_oxygen_factor(std::move(table), oxygen);
}

}  // namespace vegard::sim
