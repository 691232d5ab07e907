// A strand in a grid's voxels, cut into nearly straight pieces.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/base/grid/sparse_grid.h"
#include "sim/emit/sun/strand/strand.h"

namespace vegard::sim {

/// A straight line in the place of a part of the curve.
struct StrandPiece {
  std::array<double, 3> from, way;  ///< begin, and end less begin
  double t, t_way;                  ///< the same of the chain's parameter
  std::uint32_t number;             ///< those of one cubic count up by one; between cubics, by two
};

/// Lengths are in voxels, and the centre of voxel (i, j, k) is at (i, j, k).
struct PiecesOfStrand {
  Strand<double> strand;
  double radius;  ///< the larger one
  double off;     ///< how far lines are from the curve, at most
  std::vector<StrandPiece> pieces;
};

PiecesOfStrand pieces_of(const Strand<double>& strand, const SparseGrid& grid);

/// Pieces `first` to before `last` of a strand that may reach into a brick.
struct ReachOfStrand {
  BrickCoordinate brick;
  std::uint32_t strand, first, last;
};

/// What of a brick is to be reached: the centres of its voxels, or any place in it.
enum class BrickPart { centres, whole };

/// Appends those of all bricks, ordered by them.
void find_bricks(const PiecesOfStrand& strand, std::uint32_t index, BrickPart part,
                 std::vector<ReachOfStrand>& to);

/// About how many find_bricks() looks at, without looking.
double bricks_about(const PiecesOfStrand& strand);

}  // namespace vegard::sim
