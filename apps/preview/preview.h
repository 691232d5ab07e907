// The options of a preview, and its two kinds: in a window, and without a display.
#pragma once

#include <string>

#include "apps/options/scene_options.h"
#include "sim/render/reduced_scene.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

struct PreviewOptions {
  SceneOptions scene;
  sim::Reduction reduction;
  bool keeps_pace = true;  ///< whether the resolution in a window follows `frames_per_second`
  double frames_per_second = 20.0;
  int threads = 0;
  bool overwrite = false;

  // For frames.
  int frames = 60;
  double turn_deg = 30.0;  ///< of the camera, from the first frame to the last
  bool run_time = false;   ///< the scene's clock runs, at frames_per_second
  std::string output;      ///< a folder; empty: nothing is written

  // For a window.
  std::string save;  ///< the scene file to write on request; empty: none
};

/// The scene of a frame of a preview.
sim::Scene scene_of_preview_frame(const sim::Scene& scene, const PreviewOptions& options, int frame);

/// Renders the frames, writes them if the options name a folder, and prints the median time per frame without
/// writing. Returns the exit code. Throws Error.
int run_preview_frames(const sim::Scene& scene, const PreviewOptions& options);

/// Runs the preview in a window. Returns the exit code. Throws Error(usage) if no window can be opened, Error
/// otherwise as render does.
int run_preview_window(const sim::Scene& scene, const PreviewOptions& options);

}  // namespace vegard::apps
