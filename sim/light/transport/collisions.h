// Cross-sections of N2, O2 and O for electrons of 0.3 eV to some 100 keV.
//
// Source: data/electrons/cross_sections.csv and data/electrons/shells.csv, which name the source of every
// number; docs/electrons.md rows T1 to T4. None of them is from GLOW.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace vegard::sim {

// The ionisation of a shell of a molecule by electrons, and the energy of the second electron.
//
// Source: the relativistic binary-encounter-Bethe formula, Kim, Santos and Parente 2000, Phys. Rev. A 62,
// 052710, equations (20) and (22); below some keV that of Kim and Rudd 1994, Phys. Rev. A 50, 3954. With
// w = W/B, t = T/B, t' = T/mc^2, b' = B/mc^2, beta of the energies T, B and U:
//
//     dsigma/dw = 4 pi a0^2 alpha^4 N / ((beta_t^2 + beta_u^2 + beta_b^2) 2 b') {
//         (1/(w+1)^2 + 1/(t-w)^2) - (1/(w+1) + 1/(t-w)) (1 + 2t')/((t+1) (1 + t'/2)^2) + b'^2/(1 + t'/2)^2
//       + (1/(w+1)^3 + 1/(t-w)^3) (ln(beta_t^2/(1 - beta_t^2)) - beta_t^2 - ln(2b')) },   w <= (t-1)/2.

inline constexpr double kElectronRestEv = 510998.95;  ///< m c^2, CODATA 2018

struct IonisedShell {
  std::string name;         ///< of the ion that is left: "N2+ X"
  double loss_ev = 0.0;     ///< energy that stays in the ion
  double binding_ev = 0.0;  ///< B
  double kinetic_ev = 0.0;  ///< U
  double electrons = 0.0;   ///< N
  double auger_ev = 0.0;    ///< of the electron that the ion ejects afterwards; 0: none
  int ion_pairs() const { return auger_ev > 0.0 ? 2 : 1; }
};

/// The spectrum of second electrons for primaries of one energy.
class ShellSpectrum {
 public:
  ShellSpectrum(const IonisedShell& shell, double energy_ev);

  /// Largest energy of the slower electron, (T - B)/2; 0 if it cannot ionise.
  double max_ev() const { return max_ev_; }

  /// Cross-section for second electrons up to this energy, in closed form; all of it beyond max_ev().
  double cm2_below(double secondary_ev) const;

  double cm2() const { return max_ev_ > 0.0 ? cm2_below(max_ev_) : 0.0; }

 private:
  double integral(double w) const;

  double binding_ev_, max_ev_ = 0.0;
  double t_ = 0.0, prefactor_cm2_ = 0.0, exchange_ = 0.0, constant_ = 0.0, dipole_ = 0.0, at_zero_ = 0.0;
};

enum class Gas { n2, o2, o };
inline constexpr int kGases = 3;

/// The continuation of a cross-section beyond its table.
enum class CollisionTail {
  allowed,    ///< ln(4 T/W)/T of Bethe's dipole transitions
  forbidden,  ///< 1/T: the spin stays, no dipole
  exchange,   ///< 1/T^3: the spin changes
};

/// One cross-section against energy: linear between the table's rows in logarithms, or in the values where
/// one of them is 0; 0 below the first row and below the loss. T of the tail is m v^2/2.
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

  /// Returns the cross-section of all elastic scattering.
  double elastic_cm2(double energy_ev) const;

  /// Returns the factor on the formula of the shells with which their sum is the observed total ionisation,
  /// as far as its table goes. From there to ten times that energy the factor returns to 1, where the formula
  /// has Bethe's limit.
  double shell_factor(double energy_ev) const;

  CollisionCurve elastic, ionisation;  ///< as in the tables
};

/// Returns the cross-sections of a gas, which are read once.
const GasCollisions& gas_collisions(Gas gas);

/// Returns those of all gases with the curves of some processes of cross_sections.csv times a factor. Shells
/// follow the total ionisation (110, 210, 310), as shell_factor() says; 101 is a ratio and stays.
std::array<GasCollisions, kGases> scaled_collisions(const std::map<int, double>& factor_of_process);

/// Returns the momentum transfer by elastic scattering over all elastic scattering, the mean of 1 - cos, at
/// most 1: that of N2, which is used for all three gases. Above 0.97 keV it is that of screened Rutherford
/// scattering, times the factor that makes it continuous.
double elastic_transfer_ratio(double energy_ev);

/// Returns the energy loss per path and density, eV cm^2, by all inelastic collisions.
double stopping_ev_cm2(Gas gas, double energy_ev);

}  // namespace vegard::sim
