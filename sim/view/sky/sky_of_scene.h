// Where and when a scene's real sky is seen.
#pragma once

#include "sim/scene/structs/scene.h"
#include "sim/view/sky/star_place.h"

namespace vegard::sim {

/// The scene's place. The air refracts for whoever stands in it: below 80 km, where the lower air ends
/// (sim/view/sky/air.h).
Observer observer_of(const Scene& scene);

/// At an instant of the scene's own clock, whose zero is site.time_utc. Throws Error(scene) if that is no
/// time of the years 1900 to 2200.
double julian_date_at(const Scene& scene, double instant_s);

/// The twilight with its sun where twilight.sun says; not shown if that stands lower than twilight was
/// measured for. Throws Error(scene) if it stands higher.
Twilight twilight_at(const Scene& scene);

}  // namespace vegard::sim
