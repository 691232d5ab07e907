// The table of what is seen where in several pictures: what `vegard triangulate` reads.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "fit/triangulation/matched_curves.h"
#include "fit/triangulation/triangulated_point.h"

namespace vegard::fit {

/// A point or a curve, as cameras show it.
struct SightedFeature {
  std::string name;
  int line = 0;                      ///< of the table
  std::vector<Sight> sights;         ///< of a point: one for each camera
  std::vector<PictureCurve> curves;  ///< one for each camera; empty: it is a point
};

struct SightTableFormat {
  double first_pixel = 0.5;  ///< coordinate of the first pixel's centre
  double error_px = 1.0;     ///< of rows without sigma_px
};

/// Reads a table with commas, semicolons or tabs and a line of column names: name, camera, x_px, y_px and, if
/// the pixels' errors are known, sigma_px. `camera` is the number of a camera from 1, or one of `cameras`,
/// its name. A name with one row for each of its cameras is a point; one with two or more rows for each is a
/// curve, whose rows are in the order along it. Other columns are ignored. Throws Error(unreadable_input).
std::vector<SightedFeature> read_sights(std::string_view text, const std::string& name,
                                        const std::vector<std::string>& cameras,
                                        const SightTableFormat& format);

}  // namespace vegard::fit
