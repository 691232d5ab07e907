// Rough cameras by a few stars that a person has named in a picture, where the stars are not recognised
// blindly. Two stars tell the rotation and the focal length, or of a known lens the rotation alone; which
// lens it is, and whether the picture is mirrored, is left open: each possibility is a camera to start from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/pointing/camera_fit.h"
#include "fit/photo/pointing/star_table.h"

namespace vegard::fit {

/// Reads stars that are written as "Vega=812,344": a name or designation as in a table, and the place in
/// pixels, the centre of the first at (0.5, 0.5). Throws sim::Error(usage) about `option` for what is written
/// otherwise and for fewer than two stars or twice the same; Error(unreadable_input) for an unknown name,
/// with the nearest one; Error(usage) if time or site are missing.
std::vector<StarSighting> stars_by_hand(const std::vector<std::string>& words, const SkyOfPicture& sky,
                                        const std::string& option);

/// Returns cameras in whose pictures at least two named stars are where they were marked, the best first.
/// `lens`: a camera whose lens is known. None if no lens brings the stars there to within a fiftieth of the
/// picture's larger side.
std::vector<SkyCamera> cameras_by_hand(const std::vector<StarSighting>& named, const Frame& frame,
                                       const std::optional<SkyCamera>& lens);

}  // namespace vegard::fit
