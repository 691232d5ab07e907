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

}  // namespace vegard::sim
