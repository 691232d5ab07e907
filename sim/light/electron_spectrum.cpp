#include "sim/light/electron_spectrum.h"

#include "sim/light/spectrum_profile.h"

namespace vegard::sim {

std::optional<double> mean_energy_kev(const Sheet& sheet) {
  if (sheet.profile == "mono") return sheet.energy_kev;
  if (sheet.profile == "gaussian") return gaussian_mean_energy_kev(sheet.energy_kev, sheet.energy_spread);
  if (sheet.profile == "maxwellian" || sheet.profile == "form") return 2.0 * sheet.energy_kev;
  return std::nullopt;
}

}  // namespace vegard::sim
