// False colours for grey pictures, as used for the Sun at one wavelength.
//
// The grey of a pixel is the mean of its channels in a display file, after the tone curve, 0 to 1. With r(x;
// a, b) = (x - a) / (b - a), limited to 0 to 1, the tables are
//
//   171   red r(x; 0, 0.69)   green x               blue r(x; 0.75, 1)     gold
//   195   red x²              green r(x; 0, 0.8)    blue r(x; 0.55, 1)     green
//   284   red r(x; 0, 0.75)   green r(x; 0, 0.85)   blue r(x; 0.6, 1)      yellow
//   304   red r(x; 0, 0.69)   green r(x; 0.47, 1)   blue r(x; 0.75, 1)     orange
//
// from black to white; no channel ever decreases. The formulas are ours and imitate customary tables: 171 and
// 304 those of the Atmospheric Imaging Assembly (K. Schrijver's aia_lct.pro of SolarSoft, 2010, whose 304 is
// the "red temperature" table of IDL and whose 171 has red and blue from that table and green equal to grey),
// 195 and 284 the green and the yellow of the Extreme ultraviolet Imaging Telescope.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/base/image.h"

namespace vegard::sim {

struct Scene;

class ColourTable {
 public:
  /// The scene's sensor.colour_table. Throws Error(unreadable_input), with file and line, for a CSV whose
  /// columns are not grey, from 0 to 1 and increasing, red, green and blue, within 0 to 1.
  explicit ColourTable(const Scene& scene);

  /// "none", "171", "195", "284" or "304".
  static ColourTable named(const std::string& name);

  bool is_none() const { return grey_.empty(); }  ///< no false colours

  /// Returns the display values of a grey, which is clamped to 0 to 1: linear between the rows of a table.
  std::array<double, 3> at(double grey) const;

  /// Colours an encoded picture of R, G, B. The table "none" does nothing.
  void colour(Image& shown) const;

 private:
  ColourTable() = default;
  std::vector<double> grey_;
  std::array<std::vector<double>, 3> rgb_;
};

}  // namespace vegard::sim
