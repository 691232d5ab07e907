// The air that the electrons light up: temperature and densities against altitude.
//
// Source: U.S. Standard Atmosphere, 1976, data/atmosphere/us76.csv. It stands for moderate solar activity and
// mid-latitudes; a disturbed thermosphere is hotter and denser.
#pragma once

namespace vegard::sim {

struct Air {
  double temperature_k = 0.0;
  double n2_cm3 = 0.0, o2_cm3 = 0.0, o_cm3 = 0.0;
};

/// The air at an altitude: temperature and the logarithms of the densities are straight lines between the
/// table's rows. Below 80 km and above 640 km it is that of the table's end.
Air standard_air(double altitude_km);

}  // namespace vegard::sim
