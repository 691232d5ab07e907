// The neutral air along a field line that electrons come down.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/light/ionisation.h"
#include "sim/light/transport/collisions.h"

namespace vegard::sim {

/// From the bottom up. `path_cm` is the length along the field from the bottom.
struct FieldAir {
  std::vector<double> altitude_km, path_cm, temperature_k;
  std::array<std::vector<double>, kGases> density_cm3;  ///< in the order of Gas

  std::size_t size() const { return altitude_km.size(); }
};

/// What the column is made of: rows of a table from the bottom up. Between them temperature and the
/// logarithms of the densities are straight lines.
struct AirTable {
  std::vector<double> altitude_km, temperature_k;
  std::array<std::vector<double>, kGases> density_cm3;
};

/// The U.S. Standard Atmosphere, 1976 (sim/light/atmosphere.h), 80 to 640 km.
AirTable standard_air_table();

/// A user's table of columns altitude_km, T_K, nN2, nO2, nO (K and cm^-3; others may stand beside them, as in
/// what MSIS writes). Throws Error(unreadable_input) if one is missing, altitudes do not increase, a
/// temperature is not above 0, a density is negative, there is nothing in a row, or it does not reach from
/// 100 km at most to 300 km at least, without which electrons would not stop or begin in it.
AirTable read_air_table(const std::string& text, const std::string& name);

/// Places of the transport: 0.2 km apart where the air's scale height is below 6 km, a thirtieth of it
/// elsewhere, each divided by `refinement`. `dip_deg`: the field's inclination to the horizontal, above 0, up
/// to 90.
FieldAir field_air(const AirTable& table, double dip_deg, double refinement = 1.0);

/// The air at a place as Fang's formula needs it: mean mass of the three gases, gravity falling with the
/// square of the distance from the Earth's centre. For a vertical field.
StoppingAir stopping_air(const FieldAir& column, std::size_t place);

}  // namespace vegard::sim
