#include "sim/light/air/msis_coefficients.h"

#include <cstddef>

#include "sim/base/file/csv_table.h"

namespace vegard::sim {
namespace {

constexpr std::array<const char*, kMsisGases> kDensityColumns = {"N2", "O2", "O", "He", "Ar", "H", "N"};
constexpr std::array<const char*, 4> kNodeColumns = {"T_110", "T_100", "T_90", "T_72"};

MsisParameters parameters_of(const CsvTable& table, const char* column) {
  MsisParameters all{};
  const std::vector<double>&number = table.column("parameter"), &value = table.column(column);
  for (std::size_t r = 0; r < table.rows(); ++r) all[static_cast<std::size_t>(number[r])] = value[r];
  return all;
}

MsisCoefficients read_coefficients() {
  const CsvTable constants = embedded_csv_table("msis_constants.csv"),
                 gases = embedded_csv_table("msis_gases.csv"),
                 thermosphere = embedded_csv_table("msis_thermosphere.csv"),
                 nodes = embedded_csv_table("msis_nodes.csv");
  const auto constant = [&](const char* name) { return constants.column(name).front(); };
  MsisCoefficients all;
  all.t_inf_k = constant("T_inf_K");
  all.t_lb_k = constant("T_lb_K");
  all.gradient_k_km = constant("gradient_K_km");
  all.node_k = {constant("T_110_K"), constant("T_100_K"), constant("T_90_K"), constant("T_72_K")};
  all.node_slope_k_km = constant("gradient_72_K_km");
  all.boundary_km = constant("boundary_km");
  all.join_km = constant("join_km");
  all.mean_mass = constant("mean_mass");
  all.turbopause_season = constant("turbopause_season");
  all.transition = constant("transition");
  all.hot_o_cm3 = constant("hot_O_cm3");
  all.hot_o_k = constant("hot_O_temperature_K");
  all.hot_o_km = constant("hot_O_km");
  all.hot_o_length_km = constant("hot_O_length_km");
  all.t_inf = parameters_of(thermosphere, "T_inf");
  all.t_lb = parameters_of(thermosphere, "T_lb");
  all.gradient = parameters_of(thermosphere, "gradient");
  all.hot_o = parameters_of(thermosphere, "hot_O");
  for (std::size_t n = 0; n < all.node.size(); ++n) all.node[n] = parameters_of(nodes, kNodeColumns[n]);
  all.node_slope = parameters_of(nodes, "gradient_72");
  for (std::size_t g = 0; g < kMsisGases; ++g) {
    const auto number = [&](const char* name) { return gases.column(name)[g]; };
    MsisGasNumbers& gas = all.gas[g];
    gas.mass_number = number("mass_number");
    gas.thermal_diffusion = number("thermal_diffusion");
    gas.boundary_cm3 = number("boundary_cm3");
    gas.turbopause_km = number("turbopause_km");
    gas.mixed_below_km = number("mixed_below_km");
    gas.mixing_ratio = number("mixing_ratio");
    gas.bottom = {number("bottom_log"), number("bottom_solar"), number("bottom_km"),
                  number("bottom_length_km"), number("bottom_length_2_km")};
    gas.departure = {number("departure_log"), number("departure_solar"), number("departure_km"),
                     number("departure_length_km"), number("departure_length_2_km")};
    gas.departure_below_km = number("departure_below_km");
    gas.density = parameters_of(thermosphere, kDensityColumns[g]);
  }
  return all;
}

}  // namespace

const MsisCoefficients& msis_coefficients() {
  static const MsisCoefficients all = read_coefficients();
  return all;
}

}  // namespace vegard::sim
