// Finds a camera to start from if nothing but the stars is known.
//
// A lens with a scale and a centre turns the pixels of two stars into two directions in the camera, and one
// rotation takes these to the stars' directions in the sky. All pairs of well separated stars, scales around
// the pair's own ratio of pixels to angle, and centres around the frame's middle are tried in a fixed order;
// the cameras that map the most stars to their places are refined with a robust loss.
#pragma once

#include <vector>

#include "fit/photo/pointing/camera_fit.h"

namespace vegard::fit {

/// Returns the best camera with this lens model without any terms, mirrored or not; CameraFit::good is false
/// if no star is near its place.
CameraFit starting_camera(sim::LensModel model, bool mirrored, const std::vector<StarSighting>& stars,
                          const Frame& frame);

/// Returns the sum over stars of min(r^2, (a twentieth of the stars' extent)^2) in px^2, by which starts are
/// compared.
double truncated_sum(const SkyCamera& camera, const std::vector<StarSighting>& stars);

}  // namespace vegard::fit
