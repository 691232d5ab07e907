// A small map of a fit: the feet of the sheets with their errors, and the observers' sites.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// Returns a whole SVG document, north up at the site, in the projection of fit/report/plot/earth_map.h. It
/// shows latitude and longitude (relative to the site, where its longitude is not known; rings of distance,
/// where the site is not known at all), the sites of all photographs, the sky at 110 km altitude that their
/// pictures show, each arc's line of feet (with its sine if that is large enough to see), the 68 % band of
/// the line's position perpendicular to it, and a scale. Folds and curls are left out. Empty without sheets.
std::string foot_map_svg(const FitResult& result);

}  // namespace vegard::fit
