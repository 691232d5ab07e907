// The words that travel with an image, in the shapes that formats have for them.
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

#include "sim/base/picture/image_io.h"

namespace vegard::sim {

/// EXIF's way to say that the time is unknown. Without a DateTime OpenImageIO stamps the clock's into EXR and
/// TIFF.
inline const char* const unknown_time = "    :  :     :  :  ";
inline const char* const own_prefix = "vegard:";

/// "2019-09-05T10:11:12Z" as EXIF has it; anything of another shape as it is; of nothing, unknown_time.
std::string exif_time(std::string time);

std::string value_or_empty(const ImageAttributes& attributes, const std::string& key);

/// All attributes but the time as lines of one text.
std::string description_of(const ImageAttributes& attributes);

/// Every attribute but the time under a key of its own.
void describe_in_own_keys(OIIO::ImageSpec& spec, const ImageAttributes& attributes);

/// The text as the image's description, if there is any.
void describe_in_one_text(OIIO::ImageSpec& spec, const std::string& text);

}  // namespace vegard::sim
