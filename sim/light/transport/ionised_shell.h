// How often electrons ionise a shell of a molecule, and what energy the second electron gets.
//
// Source: the relativistic binary-encounter-Bethe formula, Kim, Santos and Parente 2000, Phys. Rev. A 62,
// 052710, equations (20) and (22); below some keV that of Kim and Rudd 1994, Phys. Rev. A 50, 3954. With
// w = W/B, t = T/B, t' = T/mc^2, b' = B/mc^2, beta of the energies T, B and U:
//
//     dsigma/dw = 4 pi a0^2 alpha^4 N / ((beta_t^2 + beta_u^2 + beta_b^2) 2 b') {
//         (1/(w+1)^2 + 1/(t-w)^2) - (1/(w+1) + 1/(t-w)) (1 + 2t')/((t+1) (1 + t'/2)^2) + b'^2/(1 + t'/2)^2
//       + (1/(w+1)^3 + 1/(t-w)^3) (ln(beta_t^2/(1 - beta_t^2)) - beta_t^2 - ln(2b')) },   w <= (t-1)/2.
#pragma once

#include <string>

namespace vegard::sim {

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

}  // namespace vegard::sim
