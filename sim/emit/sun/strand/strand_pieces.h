// A strand in a grid's voxels, cut into nearly straight pieces.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/base/grid/sparse_grid.h"
#include "sim/emit/sun/strand/strand.h"

namespace vegard::sim {

/// A straight line that replaces a part of the curve.
struct StrandPiece {
  std::array<double, 3> from, way;  ///< beginning, and end less beginning
  double t, t_way;                  ///< chain's parameter at the beginning, and its change
  std::uint32_t number;             ///< grows by one within a cubic and by two between cubics
};

/// A strand with its pieces. Lengths are in voxels, and the centre of voxel (i, j, k) is at (i, j, k).
struct PiecesOfStrand {
  Strand<double> strand;
  double radius;  ///< larger of both ends' radii
  double off;     ///< largest distance of the lines from the curve
  std::vector<StrandPiece> pieces;
};

PiecesOfStrand pieces_of(const Strand<double>& strand, const SparseGrid& grid);

/// Pieces `first` to before `last` of a strand that may reach into a brick.
struct ReachOfStrand {
  BrickCoordinate brick;
  std::uint32_t strand, first, last;
};

/// The part of a brick that a piece must reach: the centres of its voxels, or any place in it.
enum class BrickPart { centres, whole };

/// Appends the reaches of a strand into all bricks, sorted by brick.
void find_bricks(const PiecesOfStrand& strand, std::uint32_t index, BrickPart part,
                 std::vector<ReachOfStrand>& to);

/// Returns an estimate of the number of bricks that find_bricks() tests, without testing them.
double bricks_about(const PiecesOfStrand& strand);

}  // namespace vegard::sim
