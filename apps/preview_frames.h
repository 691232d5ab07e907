// A preview without a display: frames of a camera that turns, in files or against the clock alone.
#pragma once

#include "apps/preview_options.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// The scene of a frame of a preview.
sim::Scene scene_of_preview_frame(const sim::Scene& scene, const PreviewOptions& options, int frame);

/// Writes the frames, if the options name a folder, and prints the median time that one took, its writing
/// left out. Returns the exit code. Throws Error.
int run_preview_frames(const sim::Scene& scene, const PreviewOptions& options);

}  // namespace vegard::apps
