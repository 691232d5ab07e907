#include "sim/light/electron_spectrum.h"

#include "sim/light/spectrum_profile.h"

namespace vegard::sim {

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
      break;
  }
  return std::nullopt;
}

}  // namespace vegard::sim
