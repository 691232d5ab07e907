// Scenes that move: each number with keys is a curve of time, constant before its first and after its last
// key.
//
// Between two keys it is a cubic in Hermite's form. "monotone" takes the slopes of Fritsch and Butland (1984,
// SIAM J. Sci. Stat. Comput. 5, 300, with the weights of Brodlie for uneven steps), 0 at a turning point, and
// rests at its first and last key; it never leaves the range of two neighbouring keys. "catmull-rom" takes
// the slope between the neighbours (Catmull and Rom 1974), at the ends that of the only one; "smooth" takes 0
// at both keys. The ease of a key is that of the way on from it.
//
// A key may move the observer's latitude and longitude: sheets and volumes, which are placed about the site,
// then stay where the scene's own site has them (sim/scene/table/photo_scene.h).
#pragma once

#include <utility>
#include <vector>

#include "sim/scene/rows/declaration.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The keys of one number, in order of time.
struct KeyTrack {
  ParameterPath path;
  std::vector<double> time_s, value;
  std::vector<KeyEase> ease;
  std::vector<int> line;

  double at(double seconds) const;
  /// Returns the least and the largest value on the way on from a key.
  std::pair<double, double> range(std::size_t key) const;
};

/// Returns a track for each number that has keys. Throws Error(scene) with the key's line for a path that
/// names none, for a wrong number of values, and for times that do not rise.
std::vector<KeyTrack> key_tracks(const Scene& scene);

/// Returns the scene as it is at an instant of its clock, without keys; time.start_s stays. Throws
/// Error(scene) where the observer has gone too far from what is carried along.
Scene scene_at(const Scene& scene, double seconds);

/// The same at time.start_s; a scene without keys as it is.
Scene still_scene(const Scene& scene);

}  // namespace vegard::sim
