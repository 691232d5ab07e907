// Which pixels belong together: the bins in which a photograph and a model are compared.
//
// A grid is drawn once, with the camera and the field of the scene at the fit's start, and stays where it is
// while parameters move: data and model are averaged over the same pixels, whatever the pixels show.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fit/photo/region.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// What the positions or the groups of a grid are, where they are not rows of the picture and strips of its
/// columns: equal steps of a quantity.
struct BinAxis {
  std::string name;  ///< "distance across the loop"; empty: rows, or columns
  std::string unit;  ///< "px"
  double first = 0.0, step = 1.0;
  bool is_given() const { return !name.empty(); }
  double edge(double which) const { return first + which * step; }
};

/// Groups of bins in a line: bands of vertical positions, strips of horizontal ones, rows of a coarse image's
/// cells. A pixel belongs to one bin or to none, by its centre.
struct BinGrid {
  /// Pixels begin to end - 1 of a row of the picture.
  struct Run {
    int y = 0, begin = 0, end = 0;
  };

  Region region;
  int groups = 0, positions = 0;
  std::vector<Run> runs;               ///< bin after bin, from the top and the left
  std::vector<std::size_t> first_run;  ///< [bin], and the end of the last one's
  std::vector<int> band;               ///< [bin]: whose gain it has, the band that its centre lies in
  std::vector<double> row;             ///< [bin]: mean row of its pixels, counted from the region's top
  int pooled = 0;            ///< positions to either side whose pixels tell a bin's noise along with its own
  double position_px = 1.0;  ///< from position to position; 0: neighbours are not to be smoothed together
  int narrowest_px = 1;      ///< width of the narrowest bin
  BinAxis along, across;     ///< what positions are, and what groups are

  std::size_t bins() const { return static_cast<std::size_t>(groups) * positions; }
  std::size_t bin(int group, int position) const {
    return static_cast<std::size_t>(group) * positions + position;
  }
};

/// Vertical profiles along the picture's columns: a bin is a row of a band. Throws sim::Error(scene) with key
/// "fit.bands" unless 1 <= bands <= the region's width.
BinGrid column_bins(const Region& region, int bands);

/// Along elevation: bands are those of columns; a pixel's position is the row at which the curve of its
/// elevation crosses the region's middle column, wherever in the picture the horizon is. What crosses it
/// outside of the region, or beyond its highest point there, belongs to no bin.
BinGrid elevation_bins(const Region& region, int bands, const sim::Camera& camera);

/// Along the field line's projection: a pixel's position is its row; its band is that in which the picture of
/// the field line through it crosses the region's middle row. The pictures of a uniform field's lines are
/// straight and meet in the magnetic zenith, so bands are sheared, and fan out from there. Pixels beyond the
/// magnetic zenith, or whose line crosses outside of the region, belong to no bin.
BinGrid field_bins(const Region& region, int bands, const sim::Camera& camera, const sim::Field& field);

/// By fit.profile_along; of the Sun's, fit/measure/loop_bins.h and fit/measure/limb_bins.h. Throws
/// sim::Error(scene) with key "fit.profile_along" if that is "field" and the field is not uniform.
BinGrid profile_bins(const sim::Scene& scene, const Region& region);

/// Horizontal profiles in `strips` equal strips of rows (at most one per row). The columns of each band are
/// shared out evenly to bins of about eight pixels. `profiles`: for the bands.
BinGrid horizontal_bins(const BinGrid& profiles, int strips);

/// A coarse image: square cells from the region's upper left corner; what is left over at the right and the
/// bottom belongs to no bin, unless the region is smaller than a cell.
BinGrid image_bins(const BinGrid& profiles, int cell_px);

}  // namespace vegard::fit
