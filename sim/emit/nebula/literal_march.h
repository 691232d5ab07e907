// The march of nebulae as its source has it, with its constants: colours, not rayleighs.
//
// Source: the notes "Rendering volume aurorae and nebulae" on Gaia Sky's shaders; docs/nebulae.md lists its
// constants and the three places in which it is mended: the opacity is held to [0, 1], the colour of the
// light, which it works out and then leaves aside, multiplies its grey, and the depth is that of a ray of
// length 1.
#pragma once

#include <array>

#include "sim/emit/nebula/node_map.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// What the march asks of a nebula. `map` must outlive it.
struct LiteralCloud {
  const NodeMap<double>& map;
  int node;
  double bound;  ///< radius of the sphere about it: √8
  double edge;   ///< h: 0.1
  std::array<double, 3> colour_a, colour_b;
};

LiteralCloud literal_cloud(const NodeMap<double>& map, const Nebula& nebula);

/// Red, green, blue, from 0 to 1, not multiplied by the fourth, the opacity. Place, direction (of length 1)
/// and depth, at which the ray is stopped, in the nebula's frame and unit.
std::array<double, 4> literal_march(const LiteralCloud& cloud, const std::array<double, 3>& origin,
                                    const std::array<double, 3>& direction, double depth);

}  // namespace vegard::sim
