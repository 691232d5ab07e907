// The place and time for which a scene's real sky (stars, planets, Moon, Sun) is computed.
#pragma once

#include "sim/view/sky/star_place.h"

namespace vegard::sim {

struct Scene;
struct Twilight;

/// Returns the scene's observer. The air refracts for observers below 80 km, where the lower air ends
/// (sim/view/sky/air.h).
Observer observer_of(const Scene& scene);

/// Returns the Julian date at an instant of the scene's clock, whose zero is site.time_utc. Throws
/// Error(scene) if site.time_utc is not a time in the years 1900 to 2200.
double julian_date_at(const Scene& scene, double instant_s);

/// Returns the twilight with the sun's position by twilight.sun; not shown if the sun is below the range in
/// which twilight was measured. Throws Error(scene) if it is above that range.
Twilight twilight_at(const Scene& scene);

}  // namespace vegard::sim
