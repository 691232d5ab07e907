// Joint bilateral upsampling of a coarse film, guided by the distances at which rays stop.
//
// Source: Kopf et al. 2007, doi:10.1145/1276377.1276497: weights by the distance on the coarse film, here
// bilinear, times weights by the difference of a guide that is known at full resolution. The guide here is
// the distance z at which a ray stops (infinity: nowhere), with the weights exp(-r^2 / (2 0.1^2)),
// r = 1 - min(z, z_i) / max(z, z_i).
#pragma once

#include <cstddef>

#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// Returns a film at the same position with cells `shrink` times as wide and high; it may extend beyond the
/// right and lower edges of `film`.
FilmGeometry coarse_film(const FilmGeometry& film, int shrink);

/// The coarse cells from which a cell is interpolated.
struct DepthTaps {
  std::size_t cell[4] = {};  ///< on the coarse film
  double weight[4] = {};     ///< the sum is 1, or 0 if `matched` is false
  bool matched = false;      ///< false: no neighbouring coarse ray stops near this one; march this ray itself

  /// Returns the weighted mean of values on the coarse film, exact for a constant.
  float mean(const float* coarse) const;
  /// Returns the cell with the largest weight.
  std::size_t nearest() const;
};

/// Returns the taps of the cell (row, column) of a film whose ray ends at `end_km`; `coarse_end_km` are the
/// ends of the coarse film's rays, NaN outside of the lens's picture.
DepthTaps depth_taps(const FilmGeometry& coarse, int shrink, const float* coarse_end_km, int row, int column,
                     float end_km);

}  // namespace vegard::sim
