// One plane of numbers out of a file: angles of pixels, brightnesses of a line.
#pragma once

#include <string>
#include <vector>

#include "sim/base/image.h"

namespace vegard::fit {

/// One channel of an image.
sim::Image one_channel(const sim::Image& image, int channel);

/// Of an EXR the first of `channels` that it has, or its only channel; of FITS (.fits, .fit, .fts) and of a
/// TIFF of floats the first plane. NaN where FITS knows no number. Throws Error(unreadable_input), which
/// calls the numbers `what`: "angles".
sim::Image read_plane(const std::string& file, const std::vector<std::string>& channels,
                      const std::string& what);

}  // namespace vegard::fit
