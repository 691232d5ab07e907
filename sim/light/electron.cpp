#include "sim/light/electron.h"

#include "sim/light/spectrum_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {
namespace {

constexpr double kCollisionsPerKev = 300.0 / 10.0;

}  // namespace

double mean_collisions(double energy_kev) { return kCollisionsPerKev * energy_kev; }

double path_step_of(double energy_kev) { return 1.0 / mean_collisions(energy_kev); }

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
    case ProfileKind::line:
    case ProfileKind::proton:
      break;
  }
  return std::nullopt;
}

}  // namespace vegard::sim
