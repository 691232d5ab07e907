#include "sim/light/transport/ionised_shell.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"

namespace vegard::sim {
namespace {

constexpr double kBohrCm = 0.529177211e-8;
constexpr double kFineStructure = 7.2973525693e-3;

double beta2_of(double energy_ev) {
  const double gamma = 1.0 + energy_ev / kElectronRestEv;
  return (gamma - 1.0) * (gamma + 1.0) / (gamma * gamma);
}

}  // namespace

ShellSpectrum::ShellSpectrum(const IonisedShell& shell, double energy_ev) : binding_ev_(shell.binding_ev) {
  if (energy_ev <= shell.binding_ev || energy_ev <= shell.loss_ev) return;
  max_ev_ = 0.5 * (energy_ev - shell.binding_ev);
  t_ = energy_ev / binding_ev_;
  const double rest = energy_ev / kElectronRestEv, b = binding_ev_ / kElectronRestEv;
  const double beta2 = beta2_of(energy_ev);
  const double speeds = beta2 + beta2_of(shell.kinetic_ev) + beta2_of(binding_ev_);
  prefactor_cm2_ =
      4.0 * kPi * kBohrCm * kBohrCm * std::pow(kFineStructure, 4) * shell.electrons / (speeds * 2.0 * b);
  const double recoil = (1.0 + 0.5 * rest) * (1.0 + 0.5 * rest);
  exchange_ = (1.0 + 2.0 * rest) / (recoil * (t_ + 1.0));
  constant_ = b * b / recoil;
  dipole_ = std::log(beta2 / (1.0 - beta2)) - beta2 - std::log(2.0 * b);
  at_zero_ = integral(0.0);
}

double ShellSpectrum::integral(double w) const {
  const double near = w + 1.0, far = t_ - w;
  return 1.0 / far - 1.0 / near - exchange_ * std::log(near / far) + constant_ * w +
         0.5 * dipole_ * (1.0 / (far * far) - 1.0 / (near * near));
}

double ShellSpectrum::cm2_below(double secondary_ev) const {
  if (max_ev_ <= 0.0 || secondary_ev <= 0.0) return 0.0;
  const double w = std::min(secondary_ev, max_ev_) / binding_ev_;
  return prefactor_cm2_ * (integral(w) - at_zero_);
}

}  // namespace vegard::sim
