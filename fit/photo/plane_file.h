// Reads one plane of numbers from an image file: angles of pixels, brightnesses of a line.
#pragma once

#include <string>
#include <vector>

#include "sim/base/image.h"

namespace vegard::fit {

/// Returns one channel of an image.
sim::Image one_channel(const sim::Image& image, int channel);

/// Reads from an EXR the first of `channels` that it has, or its only channel; from FITS (.fits, .fit, .fts)
/// and from a TIFF of floats the first plane. Undefined values of FITS become NaN. Throws
/// Error(unreadable_input), whose message calls the numbers `what`, such as "angles".
sim::Image read_plane(const std::string& file, const std::vector<std::string>& channels,
                      const std::string& what);

}  // namespace vegard::fit
