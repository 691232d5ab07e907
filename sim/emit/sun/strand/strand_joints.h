// A strand cut into straight segments: the joints between them.
//
// The number of segments depends on values only, not on T: a chord is nowhere farther from its curve than a
// twentieth of the strand's radius, by the bound max |B''| / (8 m²) on the error of m chords at equal steps
// of u, where max |B''| = 6 max(|P0 - 2 P1 + P2|, |P1 - 2 P2 + P3|). There is a joint at every number of
// `along`, so that density is linear within a segment; and a segment's radius changes by at most a quarter.
#pragma once

#include <vector>

#include "sim/base/number/vec3.h"
#include "sim/emit/sun/strand/strand.h"
#include "sim/light/sample.h"

namespace vegard::sim {

template <class T>
struct StrandJoint {
  Vec3<T> place;
  Vec3<T> normal;  ///< unit normal, along the strand, of the plane that bisects the angle between the two
                   ///< segments; at the chain's ends, the curve's tangent
  T radius;
  T along;  ///< density on the axis
};

/// Adds the joints of a strand, at least two, from its start to its end.
template <class T>
void add_joints(const Strand<T>& strand, std::vector<StrandJoint<T>>& joints);

extern template void add_joints(const Strand<double>&, std::vector<StrandJoint<double>>&);
extern template void add_joints(const Strand<FreeDual>&, std::vector<StrandJoint<FreeDual>>&);

}  // namespace vegard::sim
