// The air that the electrons light up: temperature and densities against altitude.
//
// Source: U.S. Standard Atmosphere, 1976, data/atmosphere/us76.csv. It represents moderate solar activity and
// mid-latitudes; a disturbed thermosphere is hotter and denser.
#pragma once

namespace vegard::sim {

struct Air {
  double temperature_k = 0.0;
  double n2_cm3 = 0.0, o2_cm3 = 0.0, o_cm3 = 0.0;
};

/// Returns the air at an altitude: temperature and the logarithms of the densities are interpolated linearly
/// between the table's rows. Below 80 km and above 640 km it returns the table's first or last row.
Air standard_air(double altitude_km);

}  // namespace vegard::sim
