// A JPEG that is averaged while it is decoded: one thread decodes some rows while another adds up those
// before.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/photo/averaging.h"
#include "fit/photo/codec/jpeg_rows.h"
#include "sim/base/image.h"

namespace vegard::fit {

/// Averages all rows of a JPEG at its beginning and turns the result upright, by EXIF's orientation (1 to 8).
/// The averaging is that of the upright picture. Throws as JpegRows does.
void average_jpeg(JpegRows& jpeg, const Averaging& averaging, int orientation, const CodeTable& table,
                  sim::Image& light, std::vector<std::uint8_t>& usable);

}  // namespace vegard::fit
