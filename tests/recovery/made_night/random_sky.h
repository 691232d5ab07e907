// A sky that is drawn at random, for a camera that is drawn at random: pictures of which it is known what
// kind of sky they show. A pure function of seed and number.
#pragma once

#include <cstdint>
#include <string>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::made_night {

/// What was put into the picture and can be seen in it.
struct RandomSkyTruth {
  bool black = false, aurora = false, arc = false, several = false, rayed = false, overhead = false,
       cloud = false, twilight = false, moon = false, lamp = false;
  bool fisheye = false, mono = false;
};

struct RandomSky {
  std::string jpeg;
  RandomSkyTruth truth;
  sim::Scene scene;  ///< with the camera that took it
  /// Without noise, in the units of a rendering: "aurora", the green light of aurora as it were without
  /// clouds; "left", the share of it that clouds, trees and ground leave; "sky", the green light of all
  /// else. 0 below the horizon.
  sim::Image light;
};

/// Half of the skies have an aurora. The camera is a fisheye that looks up or a lens of 45 to 100 degrees
/// that looks above the horizon; exposure, balance of colours, noise and JPEG quality are drawn too, and one
/// picture in five is grey. With `trails` it is exposed for an hour and a half on a tripod, in which the
/// stars draw trails.
RandomSky random_sky(std::uint64_t seed, std::uint32_t number, bool trails = false);

}  // namespace vegard::made_night
