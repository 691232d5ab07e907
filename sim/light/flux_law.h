// How a line's light grows with the energy flux Q of Maxwellian electrons: nearly in proportion. The light
// per mW m^-2 relative to that at 1 mW m^-2 is
//
//     f(E0, Q) = (C(E0, Q) - B) / (Q (C(E0, 1) - B)),
//
// C the columns of data/glow/linearity_Q.csv (GLOW at Q = 0.1, 1 and 10) and B the column at zero flux, which
// those still contain: what they have at 10 keV and Q = 1 beyond data/glow/column_brightness.csv (57.3 R of
// 630.0, 11.1 R of 557.7, 2.4 R of 520.0, 0.8 R of 777.4 nm; 0 where the two agree to the five digits of the
// latter, as for the prompt lines, whose f is 1).
//
// ln f is a natural cubic spline in ln Q through the three fluxes, whose values are natural cubic splines in
// ln E0. Beyond 0.1 and 10 it goes on with the slope it has there and levels out, as slope * tanh(ln(Q/10)):
// what happens there is not known, and f changes by no more than that of one further factor of e. All
// derivatives are continuous. Only columns are known: how the height course changes with Q is left out.
#pragma once

#include <string>

namespace vegard::sim {

struct FluxFactor {
  double log_factor = 0.0;  ///< ln f
  double by_log_energy = 0.0;
  double by_log_flux = 0.0;  ///< 0 at a flux of 0
};

/// f of a column of the emission tables ("ver_5577"); E0 inside the tables, flux not negative.
FluxFactor flux_factor(const std::string& column, double energy_kev, double energy_flux_mw_m2);

/// B, in rayleighs.
double background_rayleigh(const std::string& column);

}  // namespace vegard::sim
