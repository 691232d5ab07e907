// A preview in a window: keys and mouse in, pictures out, until it is closed.
#pragma once

#include "apps/preview_options.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Returns the exit code. Throws Error(usage) if no window can be opened, Error otherwise as render does.
int run_preview_window(const sim::Scene& scene, const PreviewOptions& options);

}  // namespace vegard::apps
