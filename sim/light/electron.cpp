#include "sim/light/electron.h"

#include <cmath>

#include "sim/light/spectrum_profile.h"

namespace vegard::sim {
namespace {

constexpr double kLightKmS = 299792.458;
constexpr double kRestEnergyKev = 510.99895;  // CODATA 2018
constexpr double kCollisionsPerKev = 300.0 / 10.0;

}  // namespace

double electron_speed_km_s(double energy_kev) {
  const double gamma = 1.0 + energy_kev / kRestEnergyKev;
  return kLightKmS * std::sqrt((gamma - 1.0) * (gamma + 1.0)) / gamma;
}

double mean_collisions(double energy_kev) { return kCollisionsPerKev * energy_kev; }

double path_step_of(double energy_kev) { return 1.0 / mean_collisions(energy_kev); }

double deflections_per_metre(double path_step, double path_km) {
  return 2.0 / (path_step * 1000.0 * path_km);
}

std::optional<double> mean_energy_kev(const Sheet& sheet) {
  switch (sheet.profile) {
    case ProfileKind::mono:
      return sheet.energy_kev;
    case ProfileKind::gaussian:
      return gaussian_mean_energy_kev(sheet.energy_kev, sheet.energy_spread);
    case ProfileKind::maxwellian:
    case ProfileKind::form:
      return 2.0 * sheet.energy_kev;
    case ProfileKind::file:
    case ProfileKind::spline:
    case ProfileKind::layer:
      break;
  }
  return std::nullopt;
}

}  // namespace vegard::sim
