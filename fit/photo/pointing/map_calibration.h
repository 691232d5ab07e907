// A camera from maps of azimuth and elevation: what the simulator needs, where imager teams publish the
// direction of every pixel. The pixels of a regular grid are taken for stars that were seen at their centres,
// and pointing and lens are fitted and chosen as for stars; then every pixel of the maps is looked at.
#pragma once

#include <string>

#include "fit/photo/pointing/calibration.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::fit {

/// About so many pixels of the grid along the longer side of the maps.
inline constexpr int kGridAcross = 20;

/// A camera that is farther off anywhere gets a warning.
inline constexpr double kStandsFor_px = 0.1;

/// Pixels of the grid that look somewhere, at their centres; names are empty, `line` is 0.
std::vector<StarSighting> map_points(const sim::DirectionMap& map);

/// Every pixel of the maps that looks somewhere against the camera: the distance from its centre to where the
/// camera sees its direction.
MapAgreement map_agreement(const SkyCamera& camera, const sim::DirectionMap& map);

/// As calibrate(); `name` is that of the maps. There are no fits without each point. Throws
/// sim::Error(unreadable_input) if the maps look nowhere in too many places to tell a camera from.
Calibration calibrate_maps(const LensSettings& settings, const sim::DirectionMap& map,
                           const std::string& name);

}  // namespace vegard::fit
