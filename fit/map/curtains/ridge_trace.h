// Ridges of a raster as lines: points where it has its maximum along the direction of its strongest curvature
// (Steger 1998, doi:10.1109/34.659930), joined at right angles to that direction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fit/map/curtains/ridge_evidence.h"
#include "fit/map/raster_grid.h"

namespace vegard::fit {

/// The ridge points of a smoothed raster.
struct RidgeField {
  RasterGrid raster;
  std::vector<double> smooth;
  std::vector<std::uint8_t> is_ridge;
  std::vector<double> along_x, along_y, at_x, at_y;  ///< direction along the ridge; its place in pixels

  RidgeField(const RasterGrid& raster, std::vector<double> smooth);

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * raster.columns + x; }

 private:
  void test(int x, int y);
};

/// Joins ridge points to both sides of a first one, as long as they are not below `low`. What it passes is
/// marked as used.
RidgeLine followed_ridge(const RidgeField& field, std::vector<std::uint8_t>& used, int x0, int y0,
                         double low);

/// Points of a line, smoothed a little, at equal distances of about `step_km` along it.
RidgeLine evenly_spaced(const RidgeLine& line, double step_km, double& length_km);

}  // namespace vegard::fit
