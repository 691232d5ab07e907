// Fainter stars for a calibration that bright ones have made certain.
//
// The camera says where the catalogue's fainter stars should be, within a pixel or two, so that few points
// are there by chance. Half a magnitude after another they are taken as long as a quarter of those expected
// have a point and at most a tenth of these is by chance. Left out are stars that another one, not much
// fainter, stands near, and points whose own noise is more than twice the calibration's residuals.
#pragma once

#include <vector>

#include "fit/photo/pointing/calibration.h"
#include "fit/photo/pointing/chance_agreement.h"
#include "fit/photo/pointing/star_finder.h"

namespace vegard::fit {

/// Returns the calibration's stars and the fainter ones. `sky`: the catalogue in that sky, the brightest
/// first, close pairs not left out; `smaller`: the factor by which the picture of the points was reduced.
std::vector<StarSighting> with_deeper_stars(const Calibration& calibration,
                                            const std::vector<StarSighting>& sky,
                                            const std::vector<FoundStar>& points, const SkyPixels& pixels,
                                            int smaller);

}  // namespace vegard::fit
