// A star that has been recognised in a picture.
#pragma once

#include <array>
#include <limits>
#include <string>

namespace vegard::fit {

struct StarSighting {
  std::string name;               ///< for tables and pictures; may be empty
  std::array<double, 3> enu;      ///< its direction in the observer's sky: east, north, up, of length 1
  double x_px = 0.0, y_px = 0.0;  ///< the centre of the picture's first pixel is at (0.5, 0.5)
  double magnitude = std::numeric_limits<double>::quiet_NaN();  ///< V, if it is known
  int line = 0;                                                 ///< line in its table
  bool is_direction_given = false;  ///< its table says its azimuth: no time was needed for it
};

/// The size of the picture. `known` is false if it was only estimated from the places of the stars.
struct Frame {
  int width_px = 0, height_px = 0;
  bool known = false;
};

}  // namespace vegard::fit
