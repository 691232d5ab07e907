// Maps of directions in files.
#pragma once

#include <string>

#include "sim/base/image.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::fit {

/// The bytes of an EXR of channels "azimuth_deg", "elevation_deg"; NaN where a pixel looks nowhere. `name`:
/// of the file, for messages.
std::string encode_direction_map(const sim::DirectionMap& map, const std::string& name = {});

/// The bytes of a FITS file for each, as imager teams have them: 32-bit floats in degrees, NaN where a pixel
/// looks nowhere.
struct FitsMaps {
  std::string azimuth, elevation;
};
FitsMaps encode_fits_maps(const sim::DirectionMap& map);

/// One image of angles: of an EXR the channel of that name or its only one; of FITS (.fits, .fit, .fts) and
/// of a TIFF of floats the first plane. Throws Error(unreadable_input).
sim::Image read_angles(const std::string& file, const std::string& channel);

/// From a file for each, which may be the same. Throws Error(unreadable_input).
sim::DirectionMap read_direction_map(const std::string& azimuth_file, const std::string& elevation_file);

}  // namespace vegard::fit
