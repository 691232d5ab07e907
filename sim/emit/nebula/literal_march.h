// The march of nebulae exactly as in its source, with the source's constants. It gives colours, not
// rayleighs.
//
// Source: the notes "Rendering volume aurorae and nebulae" on Gaia Sky's shaders; docs/nebulae.md lists its
// constants and the three corrections made here: the opacity is limited to [0, 1]; the colour of the light,
// which the source computes but does not use, multiplies its grey; and the depth is the distance along a unit
// vector.
#pragma once

#include <array>

#include "sim/emit/nebula/node_map.h"

namespace vegard::sim {

/// The parameters of a nebula that the march needs. `map` must outlive it.
struct LiteralCloud {
  const NodeMap<double>& map;
  int node;
  double bound;  ///< radius of the sphere around it: √8
  double edge;   ///< h: 0.1
  std::array<double, 3> colour_a, colour_b;
};

LiteralCloud literal_cloud(const NodeMap<double>& map, const Nebula& nebula);

/// Returns red, green and blue from 0 to 1, not multiplied by the opacity, which is the fourth number. The
/// ray starts at `origin` along the unit vector `direction` and is stopped at the distance `depth`, all in
/// the nebula's frame and unit.
std::array<double, 4> literal_march(const LiteralCloud& cloud, const std::array<double, 3>& origin,
                                    const std::array<double, 3>& direction, double depth);

}  // namespace vegard::sim
