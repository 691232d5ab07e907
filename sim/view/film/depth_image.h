// Depth pictures: the distance of opaque objects in each pixel, as other renderers write them.
//
// Source: the depth buffer of a screen-space march (rays stop at objects in front of the volume). Such a
// depth is along the camera's axis; the distance along a ray is longer by 1 / cosine of the angle to the
// axis.
#pragma once

#include <cstddef>
#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/structs/volume.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// A depth picture of the camera's size; empty: no objects.
struct DepthImage {
  int width = 0, height = 0;
  bool along_axis = false;  ///< km along the camera's axis, not along the ray
  std::vector<float> km;    ///< [row][column]; infinity: no object

  bool empty() const { return km.empty(); }

  /// Returns the distance in km at which the ray through a point of the picture stops. `cosine` is that of
  /// the angle between the ray and the axis; with depths along the axis there are no objects behind the
  /// camera. The value is that of the nearest pixel, not interpolated between near and far objects; outside
  /// of the picture, that of the nearest pixel at its edge.
  double end_km(double x_px, double y_px, double cosine) const;
};

/// Converts values to kilometres by `march`: "distance" and "forward" are value x depth_gain; "log" is
///   value = log(C w + 1) / log(C depth_far_km + 1), C = 1 / depth_gain,
/// with w the depth along the axis in km, and no object where value >= 1, the initial value of such buffers.
/// `values` has them in its first channel, not negative.
DepthImage depth_image(const March& march, const Image& values);

// Joint bilateral upsampling of a coarse film, guided by the distances at which rays stop.
//
// Source: Kopf et al. 2007, doi:10.1145/1276377.1276497: weights by the distance on the coarse film, here
// bilinear, times weights by the difference of a guide that is known at full resolution. The guide here is
// the distance z at which a ray stops (infinity: nowhere), with the weights exp(-r^2 / (2 0.1^2)),
// r = 1 - min(z, z_i) / max(z, z_i).

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
