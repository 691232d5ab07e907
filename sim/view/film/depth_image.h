// How far the things that stand in a scene are, pixel by pixel, as other renderers write it.
//
// Source: the depth buffer of a screen-space march (rays are stopped at what is before the volume). Its
// depth is along the camera's axis; along a ray it is longer by 1 / cosine, the length of the ray whose
// forward component is 1. A ray made to length 1 beforehand has lost that factor.
#pragma once

#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Of the camera's size; empty: nothing stands anywhere.
struct DepthImage {
  int width = 0, height = 0;
  bool along_axis = false;  ///< km along the camera's axis, not along the ray
  std::vector<float> km;    ///< [row][column]; infinity where nothing stands

  bool empty() const { return km.empty(); }

  /// Where the ray through a place of the picture is stopped, in km along it. `cosine` is of the angle
  /// between the ray and the axis; behind the camera nothing stands in a picture of depths along the axis.
  /// Of the nearest pixel, since means of a near and a far thing are neither; outside the picture, of the
  /// nearest at its edge.
  double end_km(double x_px, double y_px, double cosine) const;
};

/// Kilometres by `march`: "distance" and "forward" are value depth_gain; "log" is
///   value = log(C w + 1) / log(C depth_far_km + 1), C = 1 / depth_gain,
/// with w the depth along the axis in km, and nothing where value >= 1, to which such buffers are cleared.
/// Values of the first channel, not negative.
DepthImage depth_image(const March& march, const Image& values);

}  // namespace vegard::sim
