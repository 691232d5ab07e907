// A strand in a grid's voxels, cut into nearly straight pieces.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
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

// The nearest point of a strand: first the nearest straight piece, then the point on the curve.

/// The nearest of the pieces with which a place has been compared.
struct NearestPiece {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double square = kNone;  ///< square of the distance; kNone if no piece is within reach
  double rival =
      kNone;  ///< square of the distance to the nearest piece that does not adjoin this one in its cubic
  double t = 0.0;
  std::uint32_t piece = 0;
};

/// Compares a place, in voxels (strand_pieces.h), with a piece. `inverse` is 1 over the square of the piece's
/// length.
inline void update_nearest(const PiecesOfStrand& cut_strand, std::uint32_t index, double inverse,
                           const double place[3], NearestPiece& nearest) {
  const StrandPiece& piece = cut_strand.pieces[index];
  const double to[3] = {place[0] - piece.from[0], place[1] - piece.from[1], place[2] - piece.from[2]};
  const double s =
      std::clamp((to[0] * piece.way[0] + to[1] * piece.way[1] + to[2] * piece.way[2]) * inverse, 0.0, 1.0);
  double square = 0.0;
  for (int a = 0; a < 3; ++a) square += (to[a] - s * piece.way[a]) * (to[a] - s * piece.way[a]);
  const double reach = cut_strand.radius + cut_strand.off;
  if (square > reach * reach) return;
  const std::uint32_t before = cut_strand.pieces[nearest.piece].number;
  const bool next = before == piece.number || before + 1 == piece.number;
  if (square < nearest.square) {
    if (!next) nearest.rival = std::min(nearest.rival, nearest.square);
    nearest.square = square;
    nearest.t = piece.t + s * piece.t_way;
    nearest.piece = index;
  } else if (!next) {
    nearest.rival = std::min(nearest.rival, square);
  }
}

/// Returns 1 over the square of a piece's length; 0 if the length is 0.
double inverse_square(const StrandPiece& piece);

/// Returns the strand's density at a place in voxels, after all pieces within reach have been compared with
/// the place, in their order. The density is accurate to a millionth of its value on the axis.
double density_from(const PiecesOfStrand& cut_strand, RadialFalloff falloff, const NearestPiece& nearest,
                    const std::array<double, 3>& place);

}  // namespace vegard::sim
