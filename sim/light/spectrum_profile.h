// Height profiles of electrons of one energy, or of a narrow range of energies. An electric field along the
// field lines accelerates electrons to such spectra; a Maxwellian is the thermal spectrum of the plasma.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"

namespace vegard::sim {

/// Returns the profile of mono-energetic electrons (sim/light/tables/mono_table.h). `by`: log_energy or
/// oxygen_factor.
HeightProfile mono_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                           double energy_kev, SlopeBy by = SlopeBy::log_energy);

/// Returns the profile of electrons whose number flux is a Gaussian, cut at 0:
///
///     phi(E) = exp(-(E - Ec)^2/(2 s^2)),  E > 0,     s = spread Ec,
///
/// so that their energy flux is proportional to E phi(E), which begins at 0 without a step. The integral over
/// E is a sum over fixed, evenly spaced values of tau, E = Ec exp(spread tau). So it is smooth in Ec and
/// spread; and since the integrand is flat at both ends, the trapezoidal rule converges fast. `spread`: above
/// 0, up to 1. `by`: all but energy_flux.
HeightProfile gaussian_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                               double energy_kev, double spread, SlopeBy by = SlopeBy::log_energy);

/// One term of the sum for a Gaussian: its energy, its share of the energy flux, and the derivative of the
/// share's logarithm by the spread at constant tau (d ln(energy) / d spread is tau).
struct GaussianPiece {
  double energy_kev = 0.0;
  double share = 0.0;
  double tau = 0.0;
  double d_log_share_d_spread = 0.0;
};
std::vector<GaussianPiece> gaussian_pieces(double energy_kev, double spread);

/// Returns the mean energy per electron of such a Gaussian: that of a normal distribution cut at 0, which is
/// Ec to 1e-5 up to a spread of 0.25, 2.8 % above it at 0.5 and 29 % at 1.
double gaussian_mean_energy_kev(double energy_kev, double spread);

}  // namespace vegard::sim
