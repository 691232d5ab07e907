// The position of a sheet's straight line in the picture.
#pragma once

#include <optional>

#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct SheetInView {
  double km_per_px = 0.0;  ///< along the sheet, from column to column
  /// Variance along the sheet, km^2, of what is averaged into one pixel: by the blur of 557.7 nm (of the
  /// first line, where that is missing), by the pixel itself, and by the depth of the sheet: the layers'
  /// width and their distance from each other, on average along the sine, projected at the angle of the line
  /// of sight.
  double smear_km2 = 0.0;
};

/// Returns the scale at a point of the picture, with the sheet's first arc taken as a straight line in the
/// tangent plane. None where the line of sight does not meet that line in front of the observer.
std::optional<SheetInView> sheet_in_view(const sim::Scene& scene, const sim::Sheet& sheet, double x_px,
                                         double y_px);

}  // namespace vegard::fit
