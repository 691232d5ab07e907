// Draws a map's frame, its labelled lines of latitude and longitude, and its scale.
#pragma once

#include <string>
#include <vector>

#include "fit/report/plot/earth_map.h"
#include "fit/report/plot/plot_canvas.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// The part of the ground that is drawn, and its place on the canvas.
struct MapFrame {
  PlotRectangle area_px;
  GroundPoint center_km;
  double km_per_px = 1.0;

  PlotPoint pixel(GroundPoint p) const {
    return {area_px.x + 0.5 * area_px.width + (p.x - center_km.x) / km_per_px,
            area_px.y + 0.5 * area_px.height - (p.y - center_km.y) / km_per_px};
  }
  /// The pixels of the points whose coordinates are finite.
  std::vector<PlotPoint> pixels(const std::vector<GroundPoint>& points) const;
  bool contains(PlotPoint pixel) const;
};

/// One line of the grid, in pixels, with its label.
struct GridLine {
  std::vector<PlotPoint> points;
  std::string label;
  bool is_meridian = false;  ///< its label is below the map; labels of others are to the left
};

struct MapGrid {
  std::vector<GridLine> lines;
  std::string note;  ///< what the lines are
};

/// Returns lines of latitude and longitude on the sphere, in steps of 1, 2 or 5 times a power of ten degrees,
/// smaller than a fifth of the map. Longitudes are relative to the site where its own is not given; where not
/// even its latitude is given, the lines are rings of distance on the ground.
MapGrid map_grid(const MapFrame& frame, const sim::Scene& scene);

void draw_grid_lines(const MapFrame& frame, const MapGrid& grid, PlotCanvas& canvas);

/// Draws the frame and the labels where lines leave it, without overlaps.
void draw_grid_labels(const MapFrame& frame, const MapGrid& grid, PlotCanvas& canvas);

/// Draws a scale bar of a round number of kilometres, and an arrow to the north.
void draw_scale(const MapFrame& frame, PlotCanvas& canvas);

}  // namespace vegard::fit
