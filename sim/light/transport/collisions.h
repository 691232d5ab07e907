// What electrons of 0.3 eV to some 100 keV hit in the upper air: cross-sections of N2, O2 and O.
//
// Source: data/electrons/cross_sections.csv and data/electrons/shells.csv, which name the source of every
// number; docs/electrons.md rows T1 to T4. None of them is from GLOW.
#pragma once

#include <string>
#include <vector>

#include "sim/light/transport/ionised_shell.h"

namespace vegard::sim {

enum class Gas { n2, o2, o };
inline constexpr int kGases = 3;

/// How a cross-section goes on beyond its table.
enum class CollisionTail {
  allowed,    ///< ln(4 T/W)/T of Bethe's dipole transitions
  forbidden,  ///< 1/T: the spin stays, no dipole
  exchange,   ///< 1/T^3: the spin changes
};

/// One cross-section against energy: straight between the table's rows in logarithms, in the values where one
/// of them is 0; nothing below the first row and below the loss. T of the tail is m v^2/2.
struct CollisionCurve {
  std::vector<double> energy_ev, cm2;
  double loss_ev = 0.0;
  CollisionTail tail = CollisionTail::forbidden;

  double at(double energy_ev) const;
};

struct Excitation {
  std::string name;  ///< "N2 C3Pi"
  CollisionCurve curve;
};

struct GasCollisions {
  std::string name;             ///< "N2"
  double nuclear_charge = 0.0;  ///< of one of its nuclei
  std::vector<Excitation> excitations;
  std::vector<IonisedShell> shells;

  /// All elastic scattering.
  double elastic_cm2(double energy_ev) const;

  /// By what the formula of the shells is multiplied so that their sum is the observed total ionisation, as
  /// far as its table goes. From there to ten times that energy the factor returns to 1, where the formula
  /// has Bethe's limit.
  double shell_factor(double energy_ev) const;

  CollisionCurve elastic, ionisation;  ///< as in the tables
};

/// Read once.
const GasCollisions& gas_collisions(Gas gas);

/// Momentum transfer by elastic scattering over all elastic scattering, the mean of 1 - cos: that of N2,
/// which stands for all three gases. Above 0.97 keV it is the screened Rutherford one, times what makes it
/// continuous. Not above 1.
double elastic_transfer_ratio(double energy_ev);

/// m v^2/2 of an electron, relativistic.
double half_mv2_ev(double energy_ev);

/// Energy per path and density, eV cm^2, of all inelastic collisions.
double stopping_ev_cm2(Gas gas, double energy_ev);

}  // namespace vegard::sim
