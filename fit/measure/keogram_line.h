// The line of a picture whose light makes one column of a keogram.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "fit/measure/bin_grid.h"
#include "fit/photo/region.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::fit {

/// Bins along a line, from the top of the keogram down. The light at a position is the mean over its bin's
/// pixels.
struct KeogramLine {
  std::shared_ptr<const BinGrid> grid;  ///< one group
  std::vector<double> position;         ///< middle of each bin: the row in px, or the angle in degrees
  double step = 1.0;                    ///< absolute difference of neighbouring positions
  bool of_directions = false;           ///< positions are angles, not rows
  double azimuth_deg = 0.0;  ///< of the horizon at which angles begin; they increase over the zenith
  double width = 0.0;        ///< of the strip, in px or in degrees
};

/// Returns the line whose bins are the rows of a strip of columns in the middle of the region. `width_px` 0:
/// the strip is the whole region. Throws sim::Error(usage) with key "--width" if the region is narrower.
KeogramLine column_line(const Region& region, int width_px);

struct MeridianOptions {
  double azimuth_deg = 0.0;
  std::optional<double> width_deg;  ///< default: two steps
  std::optional<double> step_deg;   ///< default: a round number, at least 1.5 pixels and 1/200 of the whole
};

/// Returns the line along the vertical plane at an azimuth. A pixel belongs to the line if its direction is
/// within half the width of the plane. Its position is its angle in the plane: the elevation at that azimuth,
/// continued beyond the zenith up to 180 degrees. Works for any lens. If the region shows only the part
/// beyond the zenith, angles begin at the opposite horizon instead. If the region shows much of both sides,
/// the horizon at which angles begin is at the keogram's top; otherwise the largest elevation is. Throws
/// sim::Error(usage), with keys "--azimuth", "--width" and "--elevation-step", if the region shows nothing of
/// the plane or an option's number is not usable.
KeogramLine meridian_line(const sim::DirectionMap& map, const Region& region, const MeridianOptions& options);

}  // namespace vegard::fit
