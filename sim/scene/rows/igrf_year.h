// When the field of a scene is that of the International Geomagnetic Reference Field.
#pragma once

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

inline constexpr double kFirstIgrfYear = 1900.0, kLastIgrfYear = 2030.0;

/// The year of the site's time, with its fraction. Throws Error(scene), which names field.model, if there is
/// none or it lies outside of these years.
double igrf_year(const Scene& scene);

}  // namespace vegard::sim
