// Opens the kind of FrameStore that fits a file's first bytes.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "fit/photo/frames/frame_store.h"

namespace vegard::fit {

/// Opens a file, or bytes in memory, which must outlive the store (`name` is then for messages only). Returns
/// null for a file of another kind, or one that cannot be read. Throws sim::Error(unreadable_input) for a
/// file that is damaged or has no frames.
std::unique_ptr<FrameStore> frame_store(const std::string& name, std::string_view bytes = {});

/// True if the file is of a kind that frame_store() opens.
bool has_frame_store(const std::string& file);

}  // namespace vegard::fit
