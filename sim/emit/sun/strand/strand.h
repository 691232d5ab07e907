// A strand: a thin tube of density along a chain of cubic Bézier curves.
//
// Loops, bundles and flux ropes are made of strands; strand_grid.h puts them on grids, strand_emitter.h
// computes their light along rays. At a place with the distance d to the nearest point of the chain, the
// density is
//   along(t) falloff(d / radius(t)),
// where t is the parameter of the nearest point. Beyond the ends of the chain, in the half-spaces to which
// its end tangents point, the density is 0: tubes have flat ends.
//   B(u) = (1 - u)³ P0 + 3 (1 - u)² u P1 + 3 (1 - u) u² P2 + u³ P3
// (row C7 of the source). Lengths are in units of the Sun's frame, in which the points are.
#pragma once

#include <array>
#include <vector>

#include "sim/base/number/vec3.h"
#include "sim/light/sample.h"
#include "sim/scene/structs/sun.h"

namespace vegard::sim {

template <class T>
struct Strand {
  std::vector<std::array<T, 3>> points;  ///< 3 n + 1 control points of n pieces
  T radius_first, radius_last;           ///< linear in t from the chain's start to its end
  std::vector<T> along;  ///< density on the axis, at >= 2 equal steps of t from 0 to 1, linear in between
  std::vector<T> line_gain{};  ///< factor on its light per emission line; empty: 1
  int pieces() const { return static_cast<int>(points.size() / 3); }
};

/// The strands of one loop, bundle or rope.
template <class T>
struct Strands {
  RadialFalloff falloff = RadialFalloff::smooth;
  std::vector<Strand<T>> all;
};

// A strand cut into straight segments: the joints between them.
//
// The number of segments depends on values only, not on T: a chord is nowhere farther from its curve than a
// twentieth of the strand's radius, by the bound max |B''| / (8 m²) on the error of m chords at equal steps
// of u, where max |B''| = 6 max(|P0 - 2 P1 + P2|, |P1 - 2 P2 + P3|). There is a joint at every number of
// `along`, so that density is linear within a segment; and a segment's radius changes by at most a quarter.

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
