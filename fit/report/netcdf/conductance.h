// Height-integrated conductances of the ionosphere due to precipitating electrons:
//
//   Sigma_P = 40 E / (16 + E^2) sqrt(Q),   Sigma_H = 0.45 E^0.85 Sigma_P
//
// in siemens, with the mean energy E in keV and the energy flux Q in mW m^-2 (R. M. Robinson, R. R. Vondrak,
// K. Miller, T. Dabbs, D. Hardy, "On calculating ionospheric conductances from the flux and energy of
// precipitating electrons", J. Geophys. Res. 92, 2565-2569, 1987, equations 3 and 4). Ionisation by sunlight
// is not included.
#pragma once

namespace vegard::fit {

struct Conductances {
  double pedersen_s = 0.0, hall_s = 0.0;
  /// Relative standard errors, to first order, with flux and energy taken as independent; the error of the
  /// formula itself is not included.
  double relative_pedersen_error = 0.0, relative_hall_error = 0.0;
};

/// Returns the conductances for Maxwellian electrons, whose mean energy is twice their characteristic energy
/// E0 = `energy_kev`. NaN where flux or energy is; 0 where there is no flux, whatever the energy, with
/// unknown errors (NaN).
Conductances conductances(double energy_flux_mw_m2, double energy_kev, double relative_flux_error,
                          double ln_energy_error);

}  // namespace vegard::fit
