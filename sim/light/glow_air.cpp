#include "sim/light/glow_air.h"

#include <cmath>
#include <cstddef>

#include "sim/base/file/csv_table.h"
#include "sim/base/number/constants.h"

namespace vegard::sim {
namespace {

constexpr double kUnitG = 1.66053907e-24;  // of atomic mass
constexpr double kBoltzmannErgK = 1.380649e-16;
constexpr double kGravityCmS2 = 980.665;  // at sea level
constexpr double kO = 15.999, kO2 = 31.998, kN2 = 28.014;

std::vector<StoppingAir> read_air() {
  const CsvTable table = embedded_csv_table("atmosphere.csv");
  const auto &altitude = table.column("altitude_km"), &temperature = table.column("T_K");
  const auto &o = table.column("nO"), &o2 = table.column("nO2"), &n2 = table.column("nN2");
  std::vector<StoppingAir> air;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    const double density = kUnitG * (kO * o[r] + kO2 * o2[r] + kN2 * n2[r]);
    const double mass = density / (o[r] + o2[r] + n2[r]);
    const double out = 1.0 + altitude[r] / kEarthRadiusKm;
    const double height = kBoltzmannErgK * temperature[r] * out * out / (mass * kGravityCmS2);
    air.push_back({density * height, height});
  }
  return air;
}

}  // namespace

const std::vector<StoppingAir>& glow_air() {
  static const std::vector<StoppingAir> air = read_air();
  return air;
}

}  // namespace vegard::sim
