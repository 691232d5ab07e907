// Depth pictures: the distance of opaque objects in each pixel, as other renderers write them.
//
// Source: the depth buffer of a screen-space march (rays stop at objects in front of the volume). Such a
// depth is along the camera's axis; the distance along a ray is longer by 1 / cosine of the angle to the
// axis.
#pragma once

#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

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

}  // namespace vegard::sim
