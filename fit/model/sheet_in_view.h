// The position of a sheet's straight line in the picture.
#pragma once

#include <optional>

#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct SheetInView {
  double km_per_px = 0.0;  ///< along the sheet, from column to column
  /// Variance along the sheet, km^2, over which a pixel smears: the blur of 557.7 nm (of the first line,
  /// where that is missing), the pixel itself, and what stands before and behind: the layers' width and their
  /// distance from each other, on average along the sine, seen at the angle of the line of sight.
  double smear_km2 = 0.0;
};

/// At a place of the picture, of the sheet's first arc as a straight line in the tangent plane. None where
/// the line of sight does not meet it before the observer.
std::optional<SheetInView> sheet_in_view(const sim::Scene& scene, const sim::Sheet& sheet, double x_px,
                                         double y_px);

}  // namespace vegard::fit
