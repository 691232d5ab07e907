// Finds the lower end of the sky: a line across the picture, below which all pixels are masked.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// Of every column of pixels: the y at which the ground begins, between 0 and the height.
struct Horizon {
  std::vector<double> y_px;
};

/// The polyline through the points, in the order of their x; its first and last piece are continued to the
/// picture's edges. At least two points, no two at one x; throws sim::Error(usage) about `key`.
Horizon drawn_horizon(std::vector<PicturePoint> points, int width, const std::string& key);

struct HorizonFound {
  Horizon horizon;
  double contrast = 0.0;  ///< median over the columns, of the contrast below, without its sign
  double seen = 0.0;      ///< share of the columns with a contrast of at least 0.1
};

/// The skyline: a dark ground below a brighter sky, or where none such is found a bright ground below a
/// darker sky (snow). Of the binned picture (at most 1000 columns, stars taken away by a median), the path
/// over the columns is found by dynamic programming that has the least sum of
///   − contrast across the path, as far as it is below 0.5: (above − below) / (above + below) of the mean
///     brightness (fit/photo/mask/plane.h) of four rows, less what the picture falls by just above and just
///     below, so that an arc's soft border has none; for a bright ground also half of (below − above) /
///     (above + below);
///   + half of what contrasts above the path exceed 0.2 by: a sky has no edges;
///   + 0.02 a row of difference to the next column, at most 0.6: trees are steep.
/// Columns then climb to the tips of trees, as long as they are darker than halfway from ground to sky,
/// and the line is moved to the sharpest edge near it in the full picture. None if less than half of the
/// columns (of a bright ground 80 %) have a contrast of 0.1; if the path leaps by more than thirty rows more
/// than twice with no upright edge there, as walls and trunks have one (no ground); or if the picture is a
/// fisheye's circle, whose rim is no skyline.
std::optional<HorizonFound> find_horizon(const Photo& photo);

/// Pixels whose centres are below the horizon, moved up by the margin.
PixelSet below(const Horizon& horizon, int height, double margin_px);

/// "x_px,y_px" per column, of its centre.
std::string horizon_csv(const Horizon& horizon, const std::string& picture);

}  // namespace vegard::fit
