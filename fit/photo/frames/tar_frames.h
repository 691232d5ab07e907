// Pictures in a tar, as TREx's cameras write a minute of colour frames (*.png.tar): PNGs whose names tell
// time, site, camera and exposure (imager_name.h). They are taken in the order of their times, those without
// one before all others, by their names.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "fit/photo/frames/frame_store.h"

namespace vegard::fit {

/// As frame_store() has it. What ends with .png is a frame, and all else is passed over. Throws
/// sim::Error(unreadable_input) for a tar that is damaged or has no PNG in it; of a PNG no more is looked at
/// than its size, until its picture is asked for.
std::unique_ptr<FrameStore> tar_frames(const std::string& name, std::string_view bytes = {});

}  // namespace vegard::fit
