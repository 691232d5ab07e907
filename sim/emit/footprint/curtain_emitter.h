// The emitter of a footprint as curtains: upright walls of no thickness along its spline, a fast preview.
//
// A wall is visible from both sides. It represents a Gaussian of standard deviation `width_km` across it,
// measured horizontally; a ray collects flux * width_km * sqrt(2 pi) * rate(altitude), times the cosine of
// the angle between the wall's normal and the horizontal, over the cosine of incidence. At less than 3
// degrees from the wall's plane the path is limited to that at 3 degrees, since a real wall bends before the
// path becomes longer.
#pragma once

#include <memory>

#include "sim/light/emitter.h"
#include "sim/light/profile_table.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Position and brightness of a footprint at an instant.
struct FootprintAt {
  EastNorth drifted_km{};   ///< drift of a box since the clock's zero
  double turned_deg = 0.0;  ///< rotation of a shell to the east
  double share = 1.0;       ///< factor on its light
};

/// Makes the emitter of a footprint with model "curtain". `changes` is as for plane_footprint_emitter(). T is
/// double or FreeDual.
template <class T>
std::unique_ptr<Emitter<T>> curtain_emitter(const Scene& scene, const Footprint& footprint,
                                            const ProfileTable& profiles, const ProfileChanges& changes,
                                            const NumberAs<T>& number, const FootprintAt& at = {});

}  // namespace vegard::sim
