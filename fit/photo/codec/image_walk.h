// Checks the structure of image files before they are decoded ("walks" them): one function per format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "fit/photo/codec/image_file.h"

namespace vegard::fit {

/// Recognises the format and checks the file. Throws sim::Error(unreadable_input) with the name `file` for
/// bytes that are empty, truncated, detectably damaged (a PNG's checksums), of an unknown format or of an
/// unsupported variant of a format, or for pictures larger than sim/base/picture/pixel_limit.h allows.
/// Allocates no memory according to the header's sizes.
ImageFile inspect_image_file(std::string_view bytes, const std::string& file);

ImageFile walk_jpeg(std::string_view bytes, const std::string& file);
ImageFile walk_png(std::string_view bytes, const std::string& file);
ImageFile walk_tiff(std::string_view bytes, const std::string& file);
ImageFile walk_pnm(std::string_view bytes, const std::string& file);
ImageFile walk_exr(std::string_view bytes, const std::string& file);
ImageFile walk_heif(std::string_view bytes, const std::string& file);
ImageFile walk_camera_raw(std::string_view bytes, const std::string& file);

/// True if the bytes begin with one of HEIF's brands.
bool is_heif(std::string_view bytes);

/// True if, by the file's header, one of the pictures in a HEIC has this size, upright or turned; or at least
/// this size, if the picture is cropped.
bool heif_promises(std::string_view bytes, int width, int height, const std::string& file);

/// True for camera raw files, which are recognised by their first bytes, or if they are TIFFs by their
/// directories.
bool is_camera_raw(std::string_view bytes);

/// Returns the orientation in EXIF data that begin with a TIFF header; 1 if they have none or are invalid.
int exif_orientation(std::string_view tiff);

}  // namespace vegard::fit
