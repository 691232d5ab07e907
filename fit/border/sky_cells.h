// The picture's light by azimuth and elevation: what borders are traced in.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/border/border_trace.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/camera.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {

/// The directions of columns and rows: azimuth and elevation about the zenith, or about a pole that is tilted
/// from it. About the zenith azimuths crowd, and light that crosses it runs along them; about a tilted pole
/// it crosses the columns. Column 0 then lies opposite to where the pole is tilted.
struct SkyFrame {
  double tilt_deg = 0.0, towards_deg = 0.0;

  bool is_upright() const { return tilt_deg == 0.0; }
  sim::Direction direction(double column_deg, double row_deg) const;
  /// The cosine of the angle between downwards to the horizon and downwards in the frame, across a line of
  /// this slope (in degrees of row to degree of column).
  double downwards(double column_deg, double row_deg, double slope) const;
};

/// Means of the picture over azimuth and elevation, of the frame.
struct SkyCells {
  int columns = 0, rows = 0;  ///< columns by azimuth from north, rows upwards
  double azimuth_step_deg = 1.0, lowest_deg = 0.0, elevation_step_deg = 1.0;
  std::vector<double> light;       ///< [column * rows + row]; NaN where nothing usable is
  std::vector<BorderLimit> limit;  ///< the reason; BorderLimit::none where there is light
  SkyFrame frame;

  std::size_t index(int column, int row) const { return static_cast<std::size_t>(column) * rows + row; }
  double azimuth_deg(int column) const { return column * azimuth_step_deg; }
  double elevation_deg(double row) const { return lowest_deg + (row + 0.5) * elevation_step_deg; }
};

/// Averages the picture over cells of azimuth and elevation. About a tilted pole only the sky above 40
/// degrees is looked at: below it the upright frame sees the same.
SkyCells sky_cells(const Photo& photo, const sim::Camera& camera, const BorderSettings& settings,
                   const SkyFrame& frame = {});

/// Fills small holes of each column, of a star's mask or a hot pixel, by straight lines.
void bridge_holes(SkyCells& cells);

}  // namespace vegard::fit
