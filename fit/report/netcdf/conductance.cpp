#include "fit/report/netcdf/conductance.h"

#include <cmath>

#include "sim/base/number/constants.h"

namespace vegard::fit {

Conductances conductances(double energy_flux_mw_m2, double energy_kev, double relative_flux_error,
                          double ln_energy_error) {
  // To first order an error of no flux is infinite: it is not known.
  if (energy_flux_mw_m2 == 0.0) return {0.0, 0.0, sim::kNaN, sim::kNaN};
  const double mean_kev = 2.0 * energy_kev, square = mean_kev * mean_kev;
  constexpr double kHallPower = 0.85;
  Conductances conductances;
  conductances.pedersen_s = 40.0 * mean_kev / (16.0 + square) * std::sqrt(energy_flux_mw_m2);
  conductances.hall_s = 0.45 * std::pow(mean_kev, kHallPower) * conductances.pedersen_s;
  const double by_ln_energy = (16.0 - square) / (16.0 + square);
  conductances.relative_pedersen_error =
      std::hypot(0.5 * relative_flux_error, by_ln_energy * ln_energy_error);
  conductances.relative_hall_error =
      std::hypot(0.5 * relative_flux_error, (by_ln_energy + kHallPower) * ln_energy_error);
  return conductances;
}

}  // namespace vegard::fit
