// A small map of a fit: the feet of the sheets with their errors, the observers' sites, and the outline on
// the ground of the sky that each camera sees at 110 km altitude.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/report/plot/earth_map.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Returns a whole SVG document, north up at the site, in the projection of fit/report/plot/earth_map.h. It
/// shows latitude and longitude (relative to the site, where its longitude is not known; rings of distance,
/// where the site is not known at all), the sites of all photographs, the sky at 110 km altitude that their
/// pictures show, each arc's line of feet (with its sine if that is large enough to see), the 68 % band of
/// the line's position perpendicular to it, and a scale. Folds and curls are left out. Empty without sheets.
std::string foot_map_svg(const FitResult& result);

/// Returns the closed outline of the camera's picture, or of the part of it that looks at that altitude. It
/// is searched outwards along straight lines from one such pixel: right for any lens whose picture of the sky
/// has no concave parts that such a line leaves and enters again. Empty if no pixel looks at that altitude.
std::vector<GroundPoint> camera_footprint(const sim::Scene& scene);

}  // namespace vegard::fit
