// Frames in a tar, in which TREx's cameras store a minute of colour frames (*.png.tar): PNGs whose names give
// time, site, camera and exposure (imager_words.h). Frames are ordered by time; those without a time come
// first, ordered by name.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "fit/photo/frames/frame_store.h"

namespace vegard::fit {

/// Opens a tar; the parameters are those of frame_store(). Files whose names end with .png are frames, all
/// others are ignored. Throws sim::Error(unreadable_input) for a tar that is damaged or has no PNG. Only the
/// sizes of the PNGs are read before picture() is called.
std::unique_ptr<FrameStore> tar_frames(const std::string& name, std::string_view bytes = {});

}  // namespace vegard::fit
