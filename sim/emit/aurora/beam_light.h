// The light of a beam as it varies inside an arc: rays, patches and the undulating lower border.
//
// Rays (row B10 of docs/physics.md; Baranoski et al. 2000, sections 2.2 and 2.3): light along the arc is
// exp(c g - c²/2), g a Gaussian process of unit variance, so that its mean is 1 whatever the contrast c. A
// ray goes through the whole sheet: the layers of an arc share it. A second process stretches the height
// profile above its peak in the same way, for long and short rays. Patches follow the same law in two
// dimensions. The source relies on observations and gives no law for rays or patches; the log-normal law is
// ours.
//
// The lower border (row B17; section 3.2): correlated noise in three dimensions (along the sheet, across it,
// and time) moves the whole height profile up and down. The source perturbs the start of the path, which here
// would only cut the profile off, since the profile contains the stopping of the electrons.
#pragma once

#include <cstdint>
#include <optional>

#include "sim/base/number/gaussian_process.h"
#include "sim/scene/structs/sheet.h"

namespace vegard::sim {

struct BeamLight {
  double factor = 1.0;             ///< of the flux
  double altitude_shift_km = 0.0;  ///< up
  double start_shift_km = 0.0;     ///< up, of where the beam starts and ends
  double stretch_above = 1.0;      ///< of the height profile above its peak
};

/// Returns the light in the mean over all draws, where the factors of rays and patches are 1. `ray` is a
/// value of the Gaussian process of long and short rays. An undulating border is not included.
BeamLight mean_light(const Sheet& sheet, double ray);

/// The structures of one arc at an instant. Values are cached, so each thread needs its own object.
class ArcLight {
 public:
  /// `drifted_km` is how far the sheet has drifted along itself; all structures move with it.
  ArcLight(const Sheet& sheet, std::uint32_t arc_address, std::uint64_t seed, double instant_s,
           double drifted_km);

  bool any() const { return rays_ || lengths_ || patches_ || sheet_.border_amplitude_km > 0.0; }
  bool reads_elsewhere() const {
    return lengths_ || (sheet_.border_amplitude_km > 0.0 && sheet_.border_rule == BorderRule::light);
  }

  /// Caches the processes for the stretch along the sheet that at() will mostly be called for.
  void remember(double first_km, double last_km);

  /// Returns the light of the beam at a coordinate along the sheet, as defined by StretchOfSheet, and
  /// `aside_km` from the straight line.
  BeamLight at(double along_km, double aside_km);

 private:
  const Sheet& sheet_;
  std::uint32_t address_;
  std::uint64_t seed_;
  double drifted_km_, rays_moved_km_, border_lives_;
  std::optional<GaussianProcess> rays_, lengths_;
  std::optional<GaussianField> patches_;
};

}  // namespace vegard::sim
