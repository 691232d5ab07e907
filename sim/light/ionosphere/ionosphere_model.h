// The ionosphere of electrons of one kind in one air, and how uncertain the numbers of physics leave it.
//
// The uncertainty is that of draws of the numbers (sim/light/chemistry/physics_draw.h): rate coefficients,
// the air, nitric oxide, temperatures, how long the electrons have fallen, total ionisation; besides, the
// collision frequencies of ions and of electrons, each with a standard deviation of the logarithm of 0.2
// (ESTIMATED: published values of O+ in O alone differ by up to 1.7; Schunk and Nagy 2009, chapter 4), and
// the ions of the night before, within a factor of 3. How far collisions turn electrons is not drawn.
#pragma once

#include <cstdint>
#include <optional>

#include "sim/light/chemistry/physics_draw.h"
#include "sim/light/ionosphere/ionosphere.h"

namespace vegard::sim {

/// Returns the air that tables of light were made for. Throws Error(unreadable_input) if it is no table of
/// read_air_table().
AirTable air_of_tables(const EmissionTables& tables);

/// Returns the reactions and the ionisation of the gases by a draw of the numbers, in a steady state.
IonospherePhysics drawn_physics(const PhysicsDraw& numbers);

struct IonosphereRequest {
  ElectronSpectrum spectrum;
  double oxygen_factor = 1.0;   ///< of atomic oxygen over the tables', as EmissionSource has it
  std::optional<AirTable> air;  ///< none: that of the tables
  FieldPlace place;
  double seconds = std::numeric_limits<double>::infinity();  ///< since the electrons have begun to fall
};

class IonosphereModel {
 public:
  /// `tables` must outlive the model. Throws Error(unreadable_input) for a folder whose air is no table of
  /// read_air_table(), or without the column ionisation_electron.
  IonosphereModel(const EmissionTables& tables, const IonosphereRequest& request);

  const std::vector<double>& altitudes_km() const { return altitudes_km_; }
  bool is_steady() const;
  double least_kev() const { return least_kev_; }
  double most_kev() const { return most_kev_; }

  /// Returns the ionosphere of electrons of E0, within the tables' range, and an energy flux.
  Ionosphere at(double energy_kev, double energy_flux_mw_m2) const;

  /// Returns one by a draw of the numbers, at every `stride`th altitude.
  Ionosphere drawn(double energy_kev, double energy_flux_mw_m2, std::uint64_t seed, std::uint32_t draw,
                   std::size_t stride) const;

  /// Returns every `stride`th altitude.
  std::vector<double> altitudes_of_draws_km(std::size_t stride) const;

 private:
  std::vector<double> pairs_at(double energy_kev, double energy_flux_mw_m2) const;

  const EmissionTables& tables_;
  IonosphereRequest request_;
  std::vector<double> altitudes_km_;
  AirTable table_;           ///< of the request, or the tables'
  IonosphereAir own_, air_;  ///< of the tables; of the request
  double least_kev_ = 0.0, most_kev_ = 0.0;
};

}  // namespace vegard::sim
