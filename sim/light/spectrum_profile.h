// The light of electrons of one energy, or of energies about one: what an acceleration by an electric field
// along the field lines leaves, where a Maxwellian is the plasma's own heat.
#pragma once

#include <vector>

#include "sim/light/height_profile.h"

namespace vegard::sim {

/// The profile of mono-energetic electrons (sim/light/tables/mono_table.h). The slope is by ln(energy) or the
/// oxygen factor.
HeightProfile mono_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                           double energy_kev, SlopeBy by = SlopeBy::log_energy);

/// The profile of electrons whose number flux is a Gaussian, cut at 0:
///
///     phi(E) = exp(-(E - Ec)^2/(2 s^2)),  E > 0,     s = spread Ec,
///
/// so that their energy flux goes by E phi(E), which begins at 0 without a step. The integral over E is a sum
/// over fixed values of tau, evenly spaced, E = Ec exp(spread tau): smooth in Ec and spread, and of
/// trapezoids over a curve that is level at both ends, so that it converges like one of higher order.
/// Relative spread: above 0, up to 1. The slope is by anything but the energy flux.
HeightProfile gaussian_profile(const EmissionSource& source, const std::vector<double>& wavelengths_nm,
                               double energy_kev, double spread, SlopeBy by = SlopeBy::log_energy);

/// Energies of a Gaussian's pieces, their share of the energy flux, and how its logarithm grows with the
/// spread at the same tau (d ln(energy) / d spread is tau).
struct GaussianPiece {
  double energy_kev = 0.0;
  double share = 0.0;
  double tau = 0.0;
  double d_log_share_d_spread = 0.0;
};
std::vector<GaussianPiece> gaussian_pieces(double energy_kev, double spread);

/// Mean energy of the electrons of such a Gaussian, by number: that of a normal distribution cut at 0, which
/// is Ec to 1e-5 up to a spread of 0.25, 2.8 % above it at 0.5 and 29 % at 1.
double gaussian_mean_energy_kev(double energy_kev, double spread);

}  // namespace vegard::sim
