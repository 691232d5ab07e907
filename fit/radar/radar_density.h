// The density that electrons of known spectrum and energy flux make at a radar's altitudes, with derivatives.
//
// Ion pairs are those of the emission tables, in the tables' air, and density is that of the ions in balance
// or some time after the electrons have begun to fall (sim/light/ionosphere/ionosphere.h), as of `vegard
// ionosphere`. Density over pairs is tabulated by altitude in even steps of ln(pairs) and interpolated by
// Catmull and Rom's cubics of the logarithms, within 1e-4; below 1e-3 pairs cm^-3 s^-1 in a steady state it
// goes by the root.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "sim/light/ionosphere/ionosphere.h"
#include "sim/light/spectrum_profile.h"
#include "sim/light/tables/emission_tables.h"

namespace vegard::fit {

struct RadarDensityOptions {
  double oxygen_factor = 1.0;                                ///< of atomic oxygen over the tables'
  double seconds = std::numeric_limits<double>::infinity();  ///< since the electrons have begun to fall
};

class RadarDensity {
 public:
  /// `tables` must outlive this object. Throws Error(unreadable_input) for tables without ion pairs, or whose
  /// air cannot be read.
  RadarDensity(const sim::EmissionTables& tables, const std::vector<double>& altitudes_km,
               const RadarDensityOptions& options);

  std::size_t altitudes() const { return altitudes_km_.size(); }

  /// Ion pairs, cm^-3 s^-1 per mW m^-2, and their derivatives by ln(energy) and, of a Gaussian, by its
  /// spread, by altitude.
  struct Pairs {
    std::vector<double> value, by_ln_energy, by_spread;
  };
  /// Energies beyond the tables' ends are those of the ends, with derivatives of 0.
  Pairs pairs(const sim::ElectronSpectrum& spectrum, double energy_kev) const;

  /// The density at an altitude, cm^-3, and its derivative by the ion pairs, s.
  struct Density {
    double value = 0.0, by_pairs = 0.0;
  };
  Density density(std::size_t place, double pairs_cm3_s) const;

  /// Returns how the numbers of physics change ln(density) of such electrons, a column for each of a few
  /// principal components (98 % of the variance of 64 draws), in standard deviations: [altitude, mode].
  Eigen::MatrixXd physics_modes(const sim::ElectronSpectrum& spectrum, double energy_kev,
                                double energy_flux_mw_m2, std::uint64_t seed) const;

 private:
  std::vector<double> pairs_at(const sim::ElectronSpectrum& spectrum, double energy_kev) const;
  sim::IonospherePhysics physics() const;

  const sim::EmissionTables& tables_;
  RadarDensityOptions options_;
  std::vector<double> altitudes_km_;
  sim::IonosphereAir of_tables_, air_;   ///< at the tables' altitudes and at the radar's
  std::vector<std::vector<double>> ln_;  ///< ln(density) [altitude][node]
};

}  // namespace vegard::fit
