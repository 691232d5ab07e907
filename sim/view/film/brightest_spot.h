// Finds the brightest pixel of a picture.
#pragma once

#include <vector>

#include "sim/base/image.h"
#include "sim/scene/structs/camera.h"

namespace vegard::sim {

struct Camera;

/// A pixel, by column and row from 0, and the direction of its centre.
struct BrightSpot {
  int x = 0, y = 0;
  double azimuth_deg = 0.0, elevation_deg = 0.0;
  double value = 0.0;            ///< weighted sum of the lines
  std::vector<double> rayleigh;  ///< of every line there
};

/// Returns the pixel with the largest weighted sum of the lines' rayleighs, the first of equals, row by row.
/// One weight per channel.
BrightSpot brightest_spot(const Image& rayleigh, const std::vector<double>& weights, const Camera& camera);

}  // namespace vegard::sim
