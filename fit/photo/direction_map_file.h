// Reads and writes direction maps (the azimuth and elevation of every pixel) as files, and reads other planes
// of numbers from image files: brightnesses of a line.
#pragma once

#include <string>
#include <vector>

#include "sim/base/declared_unit.h"
#include "sim/base/image.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::fit {

/// Returns the bytes of an EXR with channels "azimuth_deg" and "elevation_deg"; NaN for pixels without a
/// direction. `name`: of the file, for messages.
std::string encode_direction_map(const sim::DirectionMap& map, const std::string& name = {});

/// The bytes of a FITS file for each angle, the form that imager teams use: 32-bit floats in degrees, NaN for
/// pixels without a direction.
struct FitsMaps {
  std::string azimuth, elevation;
};
FitsMaps encode_fits_maps(const sim::DirectionMap& map);

/// Reads one image of angles: from an EXR the channel of that name or its only one; from FITS (.fits, .fit,
/// .fts) and from a TIFF of floats the first plane. Throws Error(unreadable_input).
sim::Image read_angles(const std::string& file, const std::string& channel);

/// Reads a map from one file for each angle; both may be the same file. Throws Error(unreadable_input).
sim::DirectionMap read_direction_map(const std::string& azimuth_file, const std::string& elevation_file);

/// Returns one channel of an image.
sim::Image one_channel(const sim::Image& image, int channel);

/// Reads from an EXR the first of `channels` that it has, or its only channel; from FITS (.fits, .fit, .fts)
/// and from a TIFF of floats the first plane. Undefined values of FITS become NaN. Values of a declared unit
/// (BUNIT; the attribute unit, units or BUNIT of an EXR) are converted to that of `quantity`. Throws
/// Error(unreadable_input), whose message calls the numbers `what`, such as "angles", and for a unit that is
/// none of the quantity.
sim::Image read_plane(const std::string& file, const std::vector<std::string>& channels,
                      const std::string& what, sim::Quantity quantity);

}  // namespace vegard::fit
