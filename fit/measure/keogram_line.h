// The line of a picture whose light makes one column of a keogram.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "fit/measure/bin_grid.h"
#include "fit/photo/region.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::fit {

/// Bins along a line, from the top of the keogram down. The light at a place is the mean over its bin's
/// pixels.
struct KeogramLine {
  std::shared_ptr<const BinGrid> grid;  ///< one group; a position for each place
  std::vector<double> position;         ///< middle of each place: the row in px, or the angle in degrees
  double step = 1.0;                    ///< from place to place, without sign
  bool of_directions = false;
  double azimuth_deg = 0.0;  ///< of the horizon from which angles are counted, over the zenith to the other
  double width = 0.0;        ///< of the strip, in px or in degrees
};

/// Rows of a strip of columns in the middle of the region. `width_px` 0: all of it. Throws sim::Error(usage)
/// with key "--width" if the region is not as wide.
KeogramLine column_line(const Region& region, int width_px);

struct MeridianOptions {
  double azimuth_deg = 0.0;
  std::optional<double> width_deg;  ///< default: two steps
  std::optional<double> step_deg;   ///< default: a round number, at least 1.5 pixels and 1/200 of the whole
};

/// Along the plane through the zenith at an azimuth: pixels whose direction lies within half the width of the
/// plane, by their angle along it, which is the elevation from the horizon at that azimuth, and goes on
/// beyond the zenith to 180 degrees. Works for any lens. If all of it lies beyond the zenith, angles are
/// counted from the other horizon instead. Where much of both sides is seen, the horizon from which angles
/// are counted is at the keogram's top; else the highest is. Throws sim::Error(usage), with keys "--azimuth",
/// "--width" and
/// "--elevation-step", if the region shows nothing of the plane or the numbers are none.
KeogramLine meridian_line(const sim::DirectionMap& map, const Region& region, const MeridianOptions& options);

}  // namespace vegard::fit
