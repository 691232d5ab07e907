// The transport of electrons down a field line through the air: where they ionise and excite it, and which
// electrons come back.
//
// In steady state, for electrons psi per cosine mu of the pitch angle at every energy of a grid, at the path
// s along the field (from the bottom up),
//
//     mu dpsi/ds = -K psi + sum over streams of (elastic turns) + q,
//
// K the density times the cross-sections, q what electrons of higher energies leave at this one
// (degradation.h). Energies are marched from the highest downwards, each solved exactly in all streams at
// once: along a path between two places the source over K is a straight line in optical depth (short
// characteristics; Olson and Kunasz 1987, J. Quant. Spectrosc. Radiat. Transfer 38, 325), and the streams of
// all places are one block tridiagonal system. The discrete ordinates are those of Lummerzheim and Lilensten
// 1994, Ann. Geophys. 12, 1039.
//
// Thermal electrons, where the column has them, slow the others down without turning them: an energy passes
// electrons on to the next lower one as often as it takes to lose the energy between them. The loss per path
// is that of Swartz, Nisbet and Green 1971, J. Geophys. Res. 76, 8425,
//
//     3.37e-12 n^0.97 E^-0.94 ((E - kT)/(E - 0.53 kT))^2.36 eV cm^-1,    E above kT.
//
// Left out: the mirror force (mean free paths are short against the field's scale), electric fields along the
// line, and recombination.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/light/transport/degradation.h"
#include "sim/light/transport/electron_grid.h"
#include "sim/light/transport/field_air.h"
#include "sim/light/transport/incident_electrons.h"

namespace vegard::sim {

/// The budget of energy and number per second and cm^2 of a plane across the field; energies are in eV.
struct ElectronBudget {
  double incident_ev = 0.0, incident_number = 0.0;
  double back_ev = 0.0, back_number = 0.0;        ///< up through the top
  double through_ev = 0.0, through_number = 0.0;  ///< down through the bottom
  double excitation_ev = 0.0;                     ///< in excited molecules and atoms
  double ionisation_ev = 0.0;                     ///< in ions, Auger electrons taken off
  double thermal_ev = 0.0;                        ///< in electrons below the lowest energy
  double heating_ev = 0.0;                        ///< of thermal electrons, by those that pass
  double ion_pairs = 0.0;

  double deposited_ev() const { return excitation_ev + ionisation_ev + thermal_ev + heating_ev; }
  /// Returns the missing share of the incident energy: the error of the grids.
  double missing_share() const {
    return incident_ev > 0.0 ? 1.0 - (deposited_ev() + back_ev + through_ev) / incident_ev : 0.0;
  }
  double ev_per_ion_pair() const { return ion_pairs > 0.0 ? deposited_ev() / ion_pairs : 0.0; }
};

/// Largest missing share of a valid run. A larger one means that the density of the air jumps or is high
/// where the electrons begin, for which the places are not made.
inline constexpr double kMaxMissingShare = 0.03;

struct ElectronRates {
  std::array<std::vector<double>, kGases> ion_pairs_cm3_s;                ///< [gas][place]
  std::array<std::vector<std::vector<double>>, kGases> excitation_cm3_s;  ///< [gas][excitation][place]
  std::array<std::vector<std::vector<double>>, kGases> shell_cm3_s;       ///< [gas][shell][place]
  std::vector<double> deposited_ev_cm3_s;                                 ///< [place]
  std::vector<std::vector<double>> flux;         ///< [energy][place]: all directions, cm^-2 s^-1
  std::vector<std::vector<double>> top, bottom;  ///< [energy][stream]: per cosine, cm^-2 s^-1
  /// [energy][place * streams + stream], per cosine, cm^-2 s^-1; only where asked for.
  std::vector<std::vector<double>> streams;
  ElectronBudget budget;

  double all_ion_pairs(std::size_t place) const;
};

struct TransportOptions {
  int half_streams = 4;  ///< 4 or 8 in each half
  bool keep_streams = false;
};

/// `flux`: electrons cm^-2 s^-1 at each energy of the degradation's grid, down through a plane across the
/// field at the column's top. Deterministic, on one thread; memory 8 bytes times energies, places and
/// streams.
ElectronRates electron_transport(const Degradation& degradation, const FieldAir& column,
                                 const std::vector<double>& flux, PitchAngles angles,
                                 const TransportOptions& options = {});

/// Returns the energy that an electron loses to thermal ones, per path.
double loss_to_electrons_ev_cm(double energy_ev, double electrons_cm3, double electron_temperature_k);

/// Returns the integral over the path of a rate that is exponential between places.
double path_integral(const FieldAir& column, const std::vector<double>& rate);

}  // namespace vegard::sim
