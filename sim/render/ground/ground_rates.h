// The rates of the light of a map's electrons, by bins of altitude, and how the modes of the emission tables'
// uncertainty (sim/light/tables/light_modes.h) change them.
#pragma once

#include <vector>

#include "sim/light/spectrum_profile.h"

namespace vegard::sim {

struct Scene;

/// Number of electron energies of a cell, side by side in a vector; if fewer are in use, the rest are 0.
inline constexpr int kGroundEnergies = 16;

/// Returns the mean rates in rayleighs per km of 1 mW m^-2 by altitude bin, line and energy: [(bin * lines +
/// line) * kGroundEnergies + energy]. The arguments are those of GroundLight
/// (sim/render/ground/ground_light.h).
std::vector<float> ground_rates(const Scene& scene, const std::vector<double>& energies_kev,
                                double flux_mw_m2, double altitude_scale, const ElectronSpectrum& spectrum);

/// Rates for any coefficients of the modes. The logarithm of the light is linear in them; that of the means
/// over bins of altitude is taken to be.
class ModeRates {
 public:
  /// The modes of the scene's tables; none if it takes its tables as exact.
  ModeRates(const Scene& scene, const std::vector<double>& energies_kev, double flux_mw_m2,
            double altitude_scale, const ElectronSpectrum& spectrum);

  /// The same modes of other rates where all coefficients are 0: those of other electrons at the same mean
  /// energies, whose light is taken to change as that of these.
  ModeRates of_other(std::vector<float> rates) const;

  int modes() const { return static_cast<int>(log_by_mode_.size()); }
  std::vector<float> at(const std::vector<double>& coefficients) const;
  /// Returns the derivatives of the rates by a coefficient, from the rates at the coefficients.
  std::vector<float> by_mode(int mode, const std::vector<float>& rates) const;

 private:
  ModeRates() = default;

  std::vector<float> rates_;  ///< where all coefficients are 0
  std::vector<std::vector<float>> log_by_mode_;
};

}  // namespace vegard::sim
