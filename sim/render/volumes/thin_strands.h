// How thin the strands on a scene's Sun are: voxels larger than their radius would miss some of them.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

struct ThinStrand {
  std::string what;  ///< "loop 'arcade'"; empty if there are no strands
  double radius;     ///< in the unit of the Sun's lengths; infinite if there are none
};

/// Of all loops, bundles and ropes that which has the thinnest strands. A bundle's line counts with the
/// thinner of its ends; a strand of a rope, whose feet may be points at age 0, with the larger radius of its
/// pieces.
ThinStrand thinnest_strand(const Scene& scene);

}  // namespace vegard::sim
