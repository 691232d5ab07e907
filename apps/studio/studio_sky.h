// The catalogue's stars where a camera sees them, for the studio's page to name by hand.
#pragma once

#include <string>

namespace vegard::sim {
struct Scene;
}

namespace vegard::apps {

/// Returns JSON: the site and time of a scene whose camera it is, and the catalogue's stars in its picture,
/// the brightest first, as [label, magnitude, x_px, y_px]. Throws Error(scene) if the scene has no time.
std::string studio_sky_json(const sim::Scene& scene);

}  // namespace vegard::apps
