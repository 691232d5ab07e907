// Cameras to start from when nothing is known of one but its stars.
//
// Of two stars whose pixels are known a lens with a scale and a centre gives two directions in the camera,
// and one rotation takes the one pair to the other. All pairs of well separated stars, scales about the
// pairs' own ratio of pixels to angle, and centres about the frame's middle are tried in a fixed order; the
// cameras under which the most stars come out where they were seen are refined with a robust loss.
#pragma once

#include <vector>

#include "fit/photo/pointing/camera_fit.h"

namespace vegard::fit {

/// The best of one lens model without any terms, mirrored or not. Not good if no star comes out near its
/// place.
CameraFit starting_camera(sim::LensModel model, bool mirrored, const std::vector<StarSighting>& stars,
                          const Frame& frame);

/// Sum over stars of min(r^2, (a twentieth of the stars' extent)^2), in px^2: what starts are compared by.
double truncated_sum(const SkyCamera& camera, const std::vector<StarSighting>& stars);

}  // namespace vegard::fit
