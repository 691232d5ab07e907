// Electrons that come down from above: how many of each energy, and at which angles to the field.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/light/transport/electron_grid.h"

namespace vegard::sim {

enum class SpectrumKind { mono, gaussian, maxwellian, kappa, accelerated, table };

/// Number flux per energy, up to a factor:
///
///     mono          all at E0
///     gaussian      exp(-(E - E0)^2/(2 (spread E0)^2)), E > 0
///     maxwellian    E exp(-E/E0)
///     kappa         E (1 + E/(kappa E0))^(-kappa - 1), kappa > 2: the mean energy is 2 E0 kappa/(kappa - 2)
///     accelerated   E exp(-(E - V)/E0), E >= V: a Maxwellian after a fall through the potential V, the
///                   particles in the loss cone far from the field's end (Evans 1974, J. Geophys. Res. 79,
///                   2853)
///     table         straight between its rows, nothing beyond
struct IncidentSpectrum {
  SpectrumKind kind = SpectrumKind::maxwellian;
  double energy_kev = 1.0;     ///< E0
  double spread = 0.1;         ///< gaussian
  double kappa = 5.0;          ///< kappa
  double potential_kev = 0.0;  ///< V of accelerated
  std::vector<double> table_energy_kev, table_flux;
};

/// The range of energies of the transport.
inline constexpr double kMinSpectrumKev = 0.02, kMaxSpectrumKev = 100.0;
/// The energy at which a spectrum is cut off.
inline constexpr double kHighestKev = 300.0;

/// Returns the energy that the grid has to reach: less than 1e-4 of the spectrum's energy is above it. At
/// most kHighestKev.
double highest_energy_kev(const IncidentSpectrum& spectrum);

/// Returns the electrons cm^-2 s^-1 at each energy of the grid whose energy flux through a plane across the
/// field is `energy_flux_mw_m2`.
std::vector<double> incident_flux(const IncidentSpectrum& spectrum, const EnergyGrid& grid,
                                  double energy_flux_mw_m2);

/// Returns the mean energy of the electrons of such a flux.
double mean_energy_ev(const EnergyGrid& grid, const std::vector<double>& flux);

enum class PitchAngles {
  isotropic,      ///< over the downward half
  field_aligned,  ///< all in the stream nearest to the field
};

/// Returns the electrons per cosine in each downward stream for a flux of 1 through a plane across the field;
/// 0 upwards.
std::vector<double> incident_angles(const Streams& streams, PitchAngles angles);

/// eV per erg; 1 mW m^-2 is 1 erg cm^-2 s^-1.
inline constexpr double kEvPerErg = 6.241509074e11;

}  // namespace vegard::sim
