// Finds the lower end of the sky: a line across the picture, below which all pixels are masked.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/mask/pixel_set.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// The y at which the ground begins in every column of pixels, between 0 and the height.
struct Horizon {
  std::vector<double> y_px;
};

/// Returns the polyline through the points, in the order of their x, with its first and last piece continued
/// to the picture's edges. Throws sim::Error(usage) about `key` for fewer than two points, or two at one x.
Horizon drawn_horizon(std::vector<PicturePoint> points, int width, const std::string& key);

struct HorizonFound {
  Horizon horizon;
  double contrast = 0.0;  ///< median over the columns of the absolute contrast (see find_horizon())
  double seen = 0.0;      ///< share of the columns with a contrast of at least 0.1
};

/// Finds the skyline: a dark ground below a brighter sky or, if there is none, a bright ground (snow) below a
/// darker sky. In the binned picture (at most 1000 columns, stars removed by a median), dynamic programming
/// finds the path over the columns with the least sum of
///   − the contrast across the path, up to 0.5: (above − below) / (above + below) of the mean brightness
///     (fit/photo/mask/plane.h) of four rows, less the falls just above and just below, so that the soft
///     border of an arc has none; for a bright ground also half of (below − above) / (above + below);
///   + half of the excess over 0.2 of contrasts above the path: a sky has no edges;
///   + 0.02 per row of difference to the next column, at most 0.6: trees are steep.
/// Columns then climb to the tips of trees, as long as these are darker than halfway from ground to sky, and
/// the line is moved to the sharpest edge near it in the full picture. Returns nothing if less than half of
/// the columns (80 % for a bright ground) have a contrast of 0.1; if the path leaps more than twice by more
/// than thirty rows without an upright edge there, which walls and trunks have; or if the picture is a
/// fisheye's circle, whose rim is no skyline.
std::optional<HorizonFound> find_horizon(const Photo& photo);

/// Returns the pixels whose centres are below the horizon, moved up by the margin.
PixelSet below(const Horizon& horizon, int height, double margin_px);

/// Returns a table with a row "x_px,y_px" for the centre of each column.
std::string horizon_csv(const Horizon& horizon, const std::string& picture);

}  // namespace vegard::fit
