// HEIC and HEIF pictures, through libheif.
#pragma once

#include <string>
#include <string_view>

#include "sim/base/picture/coded_picture.h"

namespace vegard::sim {

/// The main picture, 8 bits (deeper ones are rounded), encoded for display. It is turned and mirrored as its
/// own properties say; EXIF's orientation, which says the same once more, is not followed. An alpha is
/// dropped. The decoder's sizes have limits of their own, but it decodes as soon as it opens: who cannot
/// trust the file looks at its header first. Throws Error(unreadable_input) about the file `name`.
CodedPicture read_heif(std::string_view bytes, const std::string& name);

}  // namespace vegard::sim
