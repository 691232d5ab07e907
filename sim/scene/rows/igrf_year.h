// The time for which a scene takes the International Geomagnetic Reference Field (IGRF).
#pragma once

namespace vegard::sim {

struct Scene;

inline constexpr double kFirstIgrfYear = 1900.0, kLastIgrfYear = 2030.0;

/// Returns the decimal year of the site's time. Throws Error(scene), which names field.model, if the site has
/// no time or it is outside of these years.
double igrf_year(const Scene& scene);

}  // namespace vegard::sim
