// The walk through an image file that checks it before anything decodes it: one per format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "fit/photo/codec/image_file.h"

namespace vegard::fit {

/// Throws sim::Error(unreadable_input) naming `file` for bytes that are empty, truncated, damaged where the
/// format allows to tell (a PNG's checksums), of no format that is read, larger than
/// sim/base/picture/pixel_limit.h allows, or of a kind that is not read. It asks for no memory by what the
/// header promises.
ImageFile inspect_image_file(std::string_view bytes, const std::string& file);

ImageFile walk_jpeg(std::string_view bytes, const std::string& file);
ImageFile walk_png(std::string_view bytes, const std::string& file);
ImageFile walk_tiff(std::string_view bytes, const std::string& file);
ImageFile walk_pnm(std::string_view bytes, const std::string& file);
ImageFile walk_exr(std::string_view bytes, const std::string& file);
ImageFile walk_heif(std::string_view bytes, const std::string& file);
ImageFile walk_camera_raw(std::string_view bytes, const std::string& file);

/// By the brand that it begins with.
bool is_heif(std::string_view bytes);

/// Whether one of the pictures in a HEIC is of this size by its header, upright or turned; where something is
/// cut out of what is stored, at least of it.
bool heif_promises(std::string_view bytes, int width, int height, const std::string& file);

/// By its first bytes, or of a TIFF by what its directories hold.
bool is_camera_raw(std::string_view bytes);

/// The orientation of EXIF data that begin with a TIFF header; 1 if they say none or make no sense.
int exif_orientation(std::string_view tiff);

}  // namespace vegard::fit
