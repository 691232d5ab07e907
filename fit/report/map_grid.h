// A map's frame, its lines of latitude and longitude with their numbers, and its scale.
#pragma once

#include <string>
#include <vector>

#include "fit/report/plot/earth_map.h"
#include "fit/report/plot/plot_canvas.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Which part of the ground is drawn, and where.
struct MapFrame {
  PlotRectangle area_px;
  GroundPoint center_km;
  double km_per_px = 1.0;

  PlotPoint pixel(GroundPoint p) const {
    return {area_px.x + 0.5 * area_px.width + (p.x - center_km.x) / km_per_px,
            area_px.y + 0.5 * area_px.height - (p.y - center_km.y) / km_per_px};
  }
  /// Of those that are somewhere.
  std::vector<PlotPoint> pixels(const std::vector<GroundPoint>& points) const;
  bool contains(PlotPoint pixel) const;
};

/// One line of the grid, in pixels, and its number.
struct GridLine {
  std::vector<PlotPoint> points;
  std::string label;
  bool is_meridian = false;  ///< its number stands below the map, others' to the left
};

struct MapGrid {
  std::vector<GridLine> lines;
  std::string note;  ///< what the lines are
};

/// Latitudes and longitudes on the sphere about the scene's site, in steps of 1, 2 or 5 times a power of ten
/// degrees, finer than a fifth of the map. Longitudes count from the site where its own is not given; where
/// not even its latitude is, there are rings of distance on the ground instead.
MapGrid map_grid(const MapFrame& frame, const sim::Scene& scene);

void draw_grid_lines(const MapFrame& frame, const MapGrid& grid, PlotCanvas& canvas);

/// The frame and the numbers where lines leave it, but none upon another.
void draw_grid_labels(const MapFrame& frame, const MapGrid& grid, PlotCanvas& canvas);

/// A bar of a round number of kilometres, and north.
void draw_scale(const MapFrame& frame, PlotCanvas& canvas);

}  // namespace vegard::fit
