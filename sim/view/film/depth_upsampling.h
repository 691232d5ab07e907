// From few rays to many cells: joint bilateral upsampling, guided by where rays are stopped.
//
// Source: Kopf et al. 2007, doi:10.1145/1276377.1276497: weights of the distance on the coarse film, here
// bilinear, times weights of the difference of a guide that is known at full resolution. The guide here is
// the distance at which a ray is stopped, z (infinity: nowhere): exp(-r^2 / (2 0.1^2)) with
// r = 1 - min(z, z_i) / max(z, z_i).
#pragma once

#include <cstddef>

#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// A film of the same place whose cells are `shrink` times as wide and high; it may reach past the other's
/// right and lower edges.
FilmGeometry coarse_film(const FilmGeometry& film, int shrink);

/// The coarse cells that a cell follows.
struct DepthTaps {
  std::size_t cell[4] = {};  ///< on the coarse film
  double weight[4] = {};     ///< sum to 1, or are 0 where `matched` is not so
  bool matched = false;      ///< false: no coarse ray around goes as far as this one; march it by itself

  /// Of values on the coarse film; a constant comes out as it is.
  float mean(const float* coarse) const;
  /// The cell that weighs most.
  std::size_t nearest() const;
};

/// The taps of the cell (row, column) of a film whose ray ends at `end_km`; coarse_end_km are the ends of
/// the coarse film's rays, NaN where the lens sees nothing.
DepthTaps depth_taps(const FilmGeometry& coarse, int shrink, const float* coarse_end_km, int row, int column,
                     float end_km);

}  // namespace vegard::sim
