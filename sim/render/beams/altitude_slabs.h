// A slow line's light in slabs of altitude, within each of which its atoms come about equally far before they
// shine (sim/light/excited_atom.h): so that light which is seen by direction alone, whatever it comes from,
// can be spread by how far away and how high it is.
//
// Slabs overlap: at every altitude the shares of two neighbours add up to 1, and the mean of their variances
// is that of the atoms there.
#pragma once

#include <memory>
#include <vector>

#include "sim/light/excited_atom.h"
#include "sim/light/height_profile.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

struct AltitudeSlab {
  double altitude_km = 0.0;        ///< where its variance is the atoms' own
  double variance_km2 = 0.0;       ///< along one axis; 0 of the lowest slab, whose light stays where it is
  double calm_variance_km2 = 0.0;  ///< the same without what a wind spreads
  double lifetime_s = 0.0;         ///< after which the light is carried by the wind; 0 of the lowest slab
  std::shared_ptr<const std::vector<float>> share;  ///< [altitude of a HeightProfile], 0 to 1
};

/// From the ground up to `top_km`, above which all counts as there. `min_km2`: the variance below which
/// light is shared with a slab that is not spread at all; `max_km2`: above which it makes no difference.
/// From slab to slab the variance doubles at most, and the altitude grows by 2/5. `calm` is the same line's
/// without a wind.
std::vector<AltitudeSlab> altitude_slabs(const SpreadProfile& spread, const SpreadProfile& calm,
                                         double min_km2, double max_km2, double top_km);

/// Leaves of a profile what emission.altitude_share has of its lines, with its derivative; a line without one
/// is dark. Nothing is touched where there are none.
void take_altitude_share(const Emission& emission, HeightProfile& profile);

}  // namespace vegard::sim
