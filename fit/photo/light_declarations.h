// What a picture's file declares about its light and its frame, for people
// (fit/photo/codec/declared_light.h); nothing of camera raw files.
#pragma once

#include <string>
#include <vector>

namespace vegard::fit {

/// Returns what the picture with this name (fit/photo/frames/frame_name.h) declares, a line each, and why it
/// cannot be applied. Reads the file's beginning, and a TIFF as a whole. Throws sim::Error as
/// read_picture_bytes() does.
std::vector<std::string> light_declarations(const std::string& name);

}  // namespace vegard::fit
