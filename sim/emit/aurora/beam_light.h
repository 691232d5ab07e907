// What differs from beam to beam inside an arc: rays, patches and the undulating lower border.
//
// Rays (row B10 of docs/physics.md; Baranoski et al. 2000, sections 2.2 and 2.3): light along the arc is
// exp(c g - c²/2), g a Gaussian process of unit variance, so that its mean is 1 whatever the contrast c. A
// ray stands through the sheet: the layers of an arc share it. A second process stretches the height profile
// above its peak in the same way: long and short rays. Patches are the same in two dimensions. The source
// draws on observations and gives no law for either; the log-normal one is ours.
//
// The lower border (row B17; section 3.2): three-dimensional correlated noise of place along, place across
// and time moves the whole height profile up and down. The source perturbs the start of the path, which with
// a height profile that contains the stopping would only cut it off.
#pragma once

#include <cstdint>
#include <optional>

#include "sim/base/number/gaussian_process.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

struct BeamLight {
  double factor = 1.0;             ///< of the flux
  double altitude_shift_km = 0.0;  ///< up
  double start_shift_km = 0.0;     ///< up, of where the beam starts and ends
  double stretch_above = 1.0;      ///< of the height profile above its peak
};

/// In the mean over all draws: every contrast has the mean 1, and `ray` is one of many values of the process
/// of long and short rays. Of an undulating border there is none.
BeamLight mean_light(const Sheet& sheet, double ray);

/// One arc at an instant. Looks are remembered, so one object serves one thread.
class ArcLight {
 public:
  /// `drifted_km` is how far the sheet has drifted along itself: all of this goes with it.
  ArcLight(const Sheet& sheet, std::uint32_t arc_address, std::uint64_t seed, double instant_s,
           double drifted_km);

  bool any() const { return rays_ || lengths_ || patches_ || sheet_.border_amplitude_km > 0.0; }
  bool reads_elsewhere() const {
    return lengths_ || (sheet_.border_amplitude_km > 0.0 && sheet_.border_rule == BorderRule::light);
  }

  /// The stretch along the sheet that will be asked for most.
  void remember(double first_km, double last_km);

  /// The light of the beam at a coordinate along the sheet, as StretchOfSheet counts it, and `aside_km` from
  /// the straight line.
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
