// The height of the lower border of the light of electrons: where, below its peak, the light of 557.7 nm (or
// of the scene's brightest line) is half of the peak.
#pragma once

#include <vector>

#include "sim/light/spectrum_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Lower border of the light of electrons of an energy E0, and its derivative by ln(energy), both in km.
struct LowerBorder {
  double altitude_km = 0.0, by_ln_energy = 0.0;
};
LowerBorder lower_border(const sim::Scene& scene, double energy_kev,
                         const sim::ElectronSpectrum& spectrum = {});

/// Lower borders of one spectrum at any energy, interpolated.
class LowerBorderTable {
 public:
  LowerBorderTable(const sim::Scene& scene, const sim::ElectronSpectrum& spectrum);

  double altitude_km(double energy_kev) const;

 private:
  std::vector<double> border_km_;
};

}  // namespace vegard::fit
