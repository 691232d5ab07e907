// Divides a slow line's light into slabs of altitude, in each of which its atoms move about equally far
// before they emit (sim/light/excited_atom.h). So light of which only direction and slab are known, whatever
// its source, can be spread according to its distance and altitude.
//
// Slabs overlap: at every altitude the shares of two neighbours add up to 1, and the weighted mean of their
// variances is the atoms' variance there.
#pragma once

#include <memory>
#include <vector>

#include "sim/light/excited_atom.h"
#include "sim/light/height_profile.h"
#include "sim/scene/structs/light.h"

namespace vegard::sim {

struct AltitudeSlab {
  double altitude_km = 0.0;        ///< at which the slab's variance is that of the atoms
  double variance_km2 = 0.0;       ///< along one axis; 0 of the lowest slab, whose light stays where it is
  double calm_variance_km2 = 0.0;  ///< the variance without the spread by a wind
  double lifetime_s = 0.0;         ///< for which a wind moves the atoms; 0 of the lowest slab
  std::shared_ptr<const std::vector<float>> share;  ///< [altitude of a HeightProfile], 0 to 1
};

/// Returns slabs from the ground up to `top_km`; light above is treated as at `top_km`. Below the variance
/// `min_km2` light is shared with a slab that is not spread at all; variances above `max_km2` are not
/// distinguished. From slab to slab the variance at most doubles and the altitude grows by at most 2/5.
/// `calm`: the profile of the same line without a wind.
std::vector<AltitudeSlab> altitude_slabs(const SpreadProfile& spread, const SpreadProfile& calm,
                                         double min_km2, double max_km2, double top_km);

/// Multiplies a profile, and its derivative, by emission.altitude_share of its lines; a line without a share
/// becomes dark. Does nothing if emission.altitude_share is empty.
void take_altitude_share(const Emission& emission, HeightProfile& profile);

}  // namespace vegard::sim
