// The neutral air along a field line that electrons come down.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/light/tables/ionisation.h"
#include "sim/light/transport/collisions.h"

namespace vegard::sim {

/// From the bottom up. `path_cm` is the length along the field from the bottom.
struct FieldAir {
  std::vector<double> altitude_km, path_cm, temperature_k;
  std::array<std::vector<double>, kGases> density_cm3;  ///< in the order of Gas
  std::vector<double> no_cm3, n_cm3;                    ///< nitric oxide, atomic nitrogen
  std::vector<double> electron_temperature_k;
  /// Thermal electrons, which slow the others down; empty: none.
  std::vector<double> electrons_cm3;

  std::size_t size() const { return altitude_km.size(); }
};

/// The table that a column is made of: rows from the bottom up. Between them temperature and the logarithms
/// of the densities are interpolated linearly.
struct AirTable {
  std::vector<double> altitude_km, temperature_k;
  std::array<std::vector<double>, kGases> density_cm3;
  /// Empty where the table does not have them: then nitric_oxide_cm3(), no atomic nitrogen and
  /// electron_temperature_k() stand for them.
  std::vector<double> no_cm3, n_cm3, electron_temperature_k;
};

/// Returns the density of nitric oxide in the auroral zone: 1.5e8 cm^-3 at 107 km, ESTIMATED within a factor
/// of 2 after the measurements of SNOE (Barth et al. 2003, J. Geophys. Res. 108, 1027: means of 1e8 to 3e8
/// there).
double nitric_oxide_cm3(double altitude_km);

/// Returns the temperature of thermal electrons in an aurora: as warm as the air up to 115 km, 1000 K more at
/// 250 km, 1500 K more far up. ESTIMATED +-30 % of the difference after radar measurements, such as Schunk
/// and Nagy 1978, Rev. Geophys. 16, 355.
double electron_temperature_k(double altitude_km, double temperature_k);

/// Returns the U.S. Standard Atmosphere, 1976 (sim/light/atmosphere.h), from 80 to 640 km.
AirTable standard_air_table();

/// Reads a user's table with the columns altitude_km, T_K, nN2, nO2, nO (K and cm^-3; others may stand beside
/// them, as in what MSIS writes), and if it has them nNO, nN4S and Te_K. Throws Error(unreadable_input) if
/// one is missing, altitudes do not increase, a temperature is not above 0, a density is negative, there is
/// nothing in a row, or it does not reach from 100 km at most to 300 km at least, without which electrons
/// would not stop or begin in it.
AirTable read_air_table(const std::string& text, const std::string& name);

/// Returns the places of the transport: 0.2 km apart where the air's scale height is below 6 km, a thirtieth
/// of it elsewhere, each divided by `refinement`. `dip_deg`: the field's inclination to the horizontal, above
/// 0, up to 90.
FieldAir field_air(const AirTable& table, double dip_deg, double refinement = 1.0);

/// Returns the table at these altitudes, with what it lacks as field_air() has it.
AirTable air_at(const AirTable& table, const std::vector<double>& altitudes_km);

/// Returns the table with `factor` times the atomic oxygen.
AirTable with_oxygen_factor(AirTable table, double factor);

/// Returns the air at a place for Fang's formula: mean mass of the three gases, gravity falling with the
/// square of the distance from the Earth's centre. For a vertical field.
StoppingAir stopping_air(const FieldAir& column, std::size_t place);

}  // namespace vegard::sim
