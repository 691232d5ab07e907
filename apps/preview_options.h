// What the command line says of a preview.
#pragma once

#include <string>

#include "apps/scene_options.h"
#include "sim/render/reduced_scene.h"

namespace vegard::apps {

struct PreviewOptions {
  SceneOptions scene;
  sim::Reduction reduction;
  bool keeps_pace = true;  ///< a window's cost follows `frames_per_second`; frames never do
  double frames_per_second = 20.0;
  int threads = 0;
  bool overwrite = false;

  // Of frames.
  int frames = 60;
  double turn_deg = 30.0;  ///< of the camera, from the first frame to the last
  bool run_time = false;   ///< the scene's clock runs, at frames_per_second
  std::string output;      ///< a folder; empty: nothing is written

  // Of a window.
  std::string save;  ///< the scene file to write on request; empty: none
};

}  // namespace vegard::apps
