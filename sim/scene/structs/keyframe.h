// [[key]]: what a number of the scene is at an instant, between which it moves.
#pragma once

#include <string>
#include <vector>

namespace vegard::sim {

/// How a number goes on from one key to the next (sim/scene/freedom/keyframes.h).
enum class KeyEase {
  monotone,     ///< a spline that never goes beyond its keys
  catmull_rom,  ///< a rounder spline, which may
  linear,
  smooth,  ///< at rest at both keys
  hold     ///< jumps at the next key
};

struct Keyframe {
  double time_s = 0.0;  ///< on the scene's clock
  std::string path;     ///< a number or a vector of the scene
  std::vector<double> value;
  KeyEase ease = KeyEase::monotone;
  int line = 0;  ///< in the scene file, for messages
};

}  // namespace vegard::sim
