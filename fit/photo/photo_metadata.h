// The metadata of a photograph: a file of its own with EXIF or FITS keywords, or a frame of an imager's file
// with its own comments.
#pragma once

#include <string>

#include "fit/photo/frames/picture_bytes.h"
#include "sim/base/picture/picture_metadata.h"

namespace vegard::fit {

/// Of a picture's name (fit/photo/frames/frame_name.h). Where the file is an imager's by its name, what that
/// says is taken for what the file leaves out, and where both have a time that cannot be one it is said.
/// Throws sim::Error as read_picture_bytes() does.
sim::PictureMetadata photo_metadata(const std::string& name);

/// Of a frame.
sim::PictureMetadata frame_metadata(const FrameHead& head, const ImagerWords& words, const std::string& file);

}  // namespace vegard::fit
