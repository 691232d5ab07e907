// The metadata of a photograph: EXIF or FITS keywords of a file with one picture, or the comments of a frame
// in an imager's file.
#pragma once

#include <string>

#include "fit/photo/frames/picture_bytes.h"
#include "sim/base/picture/picture_metadata.h"

namespace vegard::fit {

/// Returns the metadata of the picture with this name (fit/photo/frames/frame_name.h). If the file name is
/// one of a known imager, it provides what the file does not give, and a name that tells a time with its zone
/// provides the time; if the times of the name and of the file contradict each other,
/// PictureMetadata::contradictions says so. Throws sim::Error as read_picture_bytes()
/// does.
sim::PictureMetadata photo_metadata(const std::string& name);

/// Returns the metadata of a frame in the file `file`, completed from the file's name in the same way.
sim::PictureMetadata frame_metadata(const FrameHead& head, const ImagerWords& words, const std::string& file);

}  // namespace vegard::fit
