// A star that has been recognised in a picture.
#pragma once

#include <array>
#include <limits>
#include <string>

namespace vegard::fit {

struct StarSighting {
  std::string name;               ///< for tables and pictures; may be empty
  std::array<double, 3> enu;      ///< east, north, up of where it stands in the observer's sky, of length 1
  double x_px = 0.0, y_px = 0.0;  ///< the centre of the picture's first pixel is at (0.5, 0.5)
  double magnitude = std::numeric_limits<double>::quiet_NaN();  ///< V, if it is known
  int line = 0;                                                 ///< of the table it comes from
};

/// The size of the picture. `known` is false if it was only guessed from where the stars are.
struct Frame {
  int width_px = 0, height_px = 0;
  bool known = false;
};

}  // namespace vegard::fit
