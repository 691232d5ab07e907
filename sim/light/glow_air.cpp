#include "sim/light/glow_air.h"

#include <cstddef>

#include "sim/base/file/csv_table.h"

namespace vegard::sim {
namespace {

std::vector<StoppingAir> read_air() {
  const CsvTable table = embedded_csv_table("atmosphere.csv");
  const auto &altitude = table.column("altitude_km"), &temperature = table.column("T_K");
  const auto &o = table.column("nO"), &o2 = table.column("nO2"), &n2 = table.column("nN2");
  std::vector<StoppingAir> air;
  for (std::size_t r = 0; r < table.rows(); ++r)
    air.push_back(stopping_air(altitude[r], temperature[r], n2[r], o2[r], o[r]));
  return air;
}

}  // namespace

const std::vector<StoppingAir>& glow_air() {
  static const std::vector<StoppingAir> air = read_air();
  return air;
}

}  // namespace vegard::sim
