// A footprint's aurora as curtains: upright walls without thickness along its spline, a cheap preview.
//
// A ray sees a wall from both sides. The volume across a wall is a Gaussian of standard deviation `width_km`,
// measured level with the ground; what a ray has of it is flux * width_km * sqrt(2 pi) * rate(altitude),
// times the cosine between that level and the wall's normal, over the cosine of incidence. Under 3 degrees
// from the wall's own plane the path is that at 3 degrees: the wall bends sooner than it would be longer.
#pragma once

#include <memory>

#include "sim/light/emitter.h"
#include "sim/light/profile_table.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// A footprint at an instant.
struct FootprintAt {
  EastNorth drifted_km{};   ///< of a box, since the clock's zero
  double turned_deg = 0.0;  ///< of a shell, to the east
  double share = 1.0;       ///< times its light
};

/// Of a footprint with model "curtain". `changes` as of plane_footprint_emitter(). T is double or FreeDual.
template <class T>
std::unique_ptr<Emitter<T>> curtain_emitter(const Scene& scene, const Footprint& footprint,
                                            const ProfileTable& profiles, const ProfileChanges& changes,
                                            const NumberAs<T>& number, const FootprintAt& at = {});

}  // namespace vegard::sim
