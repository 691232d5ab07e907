// Opens the kind of FrameStore that fits a file's first bytes.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "fit/photo/frames/frame_store.h"

namespace vegard::fit {

/// Of a file by what it begins with, or of bytes that outlive it (`name` is for messages then); nothing for a
/// file of another kind, or one that cannot be read. Throws sim::Error(unreadable_input) for one that is
/// damaged or has no frames in it.
std::unique_ptr<FrameStore> frame_store(const std::string& name, std::string_view bytes = {});

/// Whether frame_store() would look into the file.
bool has_frame_store(const std::string& file);

}  // namespace vegard::fit
