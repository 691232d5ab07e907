// Converts image attributes (ImageAttributes) to the forms of the file formats.
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

#include "sim/base/picture/image_io.h"

namespace vegard::sim {

/// EXIF's value for an unknown time. Without a DateTime, OpenImageIO writes the computer's time into EXR and
/// TIFF.
inline const char* const unknown_time = "    :  :     :  :  ";
inline const char* const own_prefix = "vegard:";

/// Converts "2019-09-05T10:11:12Z" to EXIF's form; returns other text unchanged, and unknown_time for an
/// empty text.
std::string exif_time(std::string time);

std::string value_or_empty(const ImageAttributes& attributes, const std::string& key);

/// Returns all attributes except the time as lines of one text.
std::string description_of(const ImageAttributes& attributes);

/// Adds every attribute except the time with its own key.
void describe_in_own_keys(OIIO::ImageSpec& spec, const ImageAttributes& attributes);

/// Sets the image's description, if the text is not empty.
void describe_in_one_text(OIIO::ImageSpec& spec, const std::string& text);

}  // namespace vegard::sim
