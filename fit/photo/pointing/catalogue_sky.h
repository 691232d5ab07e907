// The catalogue's stars in the sky of a picture.
#pragma once

#include <vector>

#include "fit/photo/pointing/star_sighting.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {

/// Returns the stars up to a magnitude and above an elevation, the brightest first; x_px and y_px are 0.
/// Stars nearer than `apart_deg` to a brighter one are left out: in the picture they are one.
std::vector<StarSighting> catalogue_sky(const sim::Observer& observer, double julian_date, double faintest,
                                        double min_elevation_deg = 5.0, double apart_deg = 0.3);

}  // namespace vegard::fit
