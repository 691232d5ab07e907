// Calibrates a camera by maps of azimuth and elevation, which imager teams publish instead of a lens. The
// pixels of a regular grid are taken for stars that were seen at the pixels' centres, and pointing and lens
// are chosen and fitted as for stars; then the camera is compared with every pixel of the maps.
#pragma once

#include <string>

#include "fit/photo/pointing/calibration.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::fit {

/// The approximate number of the grid's pixels along the longer side of the maps.
inline constexpr int kGridAcross = 20;

/// A camera that is farther off than this in any pixel gets a warning.
inline constexpr double kStandsFor_px = 0.1;

/// Returns the centres of the grid's pixels that have a direction; names are empty, `line` is 0.
std::vector<StarSighting> map_points(const sim::DirectionMap& map);

/// Compares the camera with every pixel of the maps that has a direction: the distance from the pixel's
/// centre to the camera's image of that direction.
MapAgreement map_agreement(const SkyCamera& camera, const sim::DirectionMap& map);

/// Calibrates as calibrate() does, without fits without each point; `name` is that of the maps. Throws
/// sim::Error(unreadable_input) if too few pixels of the maps have a direction.
Calibration calibrate_maps(const LensSettings& settings, const sim::DirectionMap& map,
                           const std::string& name);

}  // namespace vegard::fit
