// The light of the sky's cells as the search for borders sees it: smoothed, without the sky, and with its
// noise.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "fit/border/border_air.h"
#include "fit/border/sky_cells.h"

namespace vegard::fit {

/// The noise of the smoothed cells as a function of the picture's brightness there, measured in the picture.
struct BorderNoise {
  std::vector<double> brightness, sigma;

  double at(double value) const {
    const auto above = std::upper_bound(brightness.begin(), brightness.end(), value);
    if (above == brightness.begin()) return sigma.front();
    return sigma[static_cast<std::size_t>(above - brightness.begin()) - 1];
  }
};

/// What the search in a column needs.
struct BorderLight {
  const SkyCells& cells;
  BorderAir air;
  std::vector<double> whole;   ///< smoothed
  std::vector<double> smooth;  ///< the same without the sky
  BorderNoise noise;
  std::vector<double> floor;  ///< of each column: what is dark there
  double least = 0.0;         ///< of a peak above its foot, anywhere
  double dark_sky = 0.0;      ///< less light than this is no sky's

  double at(int column, int row) const { return smooth[cells.index(column, row)]; }
};

/// The light of cells, which must outlive it, seen through this air; none if there is too little of it for a
/// noise.
std::optional<BorderLight> border_light(const SkyCells& cells, BorderAir air);

}  // namespace vegard::fit
