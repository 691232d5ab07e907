#include "fit/map/conductance.h"

#include <cmath>

namespace vegard::fit {

Conductances conductances(double energy_flux_mw_m2, double energy_kev, double relative_flux_error,
                          double ln_energy_error) {
  if (energy_flux_mw_m2 == 0.0) return {};
  const double mean_kev = 2.0 * energy_kev, square = mean_kev * mean_kev;
  constexpr double kHallPower = 0.85;
  Conductances of;
  of.pedersen_s = 40.0 * mean_kev / (16.0 + square) * std::sqrt(energy_flux_mw_m2);
  of.hall_s = 0.45 * std::pow(mean_kev, kHallPower) * of.pedersen_s;
  const double by_ln_energy = (16.0 - square) / (16.0 + square);
  of.relative_pedersen_error = std::hypot(0.5 * relative_flux_error, by_ln_energy * ln_energy_error);
  of.relative_hall_error =
      std::hypot(0.5 * relative_flux_error, (by_ln_energy + kHallPower) * ln_energy_error);
  return of;
}

}  // namespace vegard::fit
