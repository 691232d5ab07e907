// A small map of a fit: where the sheets' feet stand, from where they were seen, and how far off they may be.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// A whole SVG document, north up at the site, in the projection of fit/report/plot/earth_map.h: latitude and
/// longitude (from the site, where its longitude is not known; rings of distance, where the site is not known
/// at all), the sites of all photographs, what their pictures see at 110 km altitude, each arc's line of feet
/// with its sine where that can be seen, the 68 % band of the line across itself, and a scale. Folds and
/// curls are left out. Empty without sheets.
std::string foot_map_svg(const FitResult& result);

}  // namespace vegard::fit
