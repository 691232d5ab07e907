// What electrons of each energy ionise at a radar's altitudes, and how fast their electrons are lost again.
//
// Ion pairs are those of the emission tables for electrons of one energy (sim/light/ionosphere/ionosphere.h),
// moved to another air where that is asked for. The uncertainty of physics is that of draws of its numbers
// (sim/light/chemistry/physics_draw.h): reactions, ionisation, air.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/light/ionosphere/recombination.h"
#include "sim/light/tables/emission_tables.h"

namespace vegard::fit {

/// Even steps of ln(energy); a bin has one energy flux per ln(energy).
struct EnergyBins {
  std::vector<double> edge_kev;
  std::size_t count() const { return edge_kev.size() - 1; }
  double middle_kev(std::size_t bin) const;
};

/// Returns the bins of all inversions: 0.1 to 100 keV, 12 to a factor of 10.
EnergyBins usual_energy_bins();

class DensityPhysics {
 public:
  /// `air`: none for that of the tables, which must outlive this object. Throws Error(unreadable_input) for
  /// tables without ion pairs, or whose air cannot be read.
  DensityPhysics(const sim::EmissionTables& tables, const std::optional<sim::AirTable>& air,
                 sim::RecombinationLaw law, const std::vector<double>& altitudes_km);

  const EnergyBins& bins() const { return bins_; }
  const std::vector<double>& altitudes_km() const { return altitudes_km_; }

  /// Ion pairs cm^-3 s^-1 per mW m^-2: [altitude, bin].
  const Eigen::MatrixXd& pairs() const { return pairs_; }

  /// Returns the altitude at which a bin's electrons ionise most, in the air of this object; NaN beyond the
  /// energies of the tables.
  double peak_km(std::size_t bin) const { return peak_km_[bin]; }

  sim::Recombination recombination(std::size_t place, double electrons_cm3) const;

  /// What a draw of the numbers changes, by altitude.
  struct Change {
    Eigen::VectorXd ln_pairs, ln_recombination;
  };
  /// `flux_mw_m2`: by bin; `electrons_cm3`: by altitude, above 0.
  Change drawn(std::uint64_t seed, std::uint32_t draw, const Eigen::VectorXd& flux_mw_m2,
               const Eigen::VectorXd& electrons_cm3) const;

 private:
  sim::RecombinationLaw law_;
  std::vector<double> altitudes_km_;
  EnergyBins bins_;
  sim::AirTable table_;           ///< of the air that is ionised
  sim::IonosphereAir of_tables_;  ///< at the tables' altitudes
  sim::IonosphereAir air_;        ///< at the radar's
  Eigen::MatrixXd table_pairs_;   ///< [the tables' altitude, bin]
  Eigen::MatrixXd pairs_;
  std::vector<double> peak_km_;
};

}  // namespace vegard::fit
