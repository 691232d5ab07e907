// The height of light by laying two pictures on a thin shell: at the height of the light they show the same.
//
// At each height the brightness that each picture has at places of the shell becomes its rank among all of
// its places, so that gain, gamma and tone curves that only grow do not matter; smooth sky, a surface of
// second order, is taken off the ranks. The correlation r of what is left of both has, for n independent
// places and a true correlation rho, a probability in proportion to (1 - rho^2)^(n / 2) / (1 - rho r)^n (H.
// Jeffreys, "Theory of probability", 1961, section 3.9). n is counted in what the two pictures do not share.
// The heights' probabilities follow, with all heights and all rho from 0 to 1 alike before.
//
// Light fills some tens of kilometres of height, so the answer is that of its densest structure, which for
// 557.7 nm is near the peak; views along a curtain and across it see different parts of it.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/photo/photo.h"
#include "fit/triangulation/matched_curves.h"
#include "fit/triangulation/view_point.h"

namespace vegard::fit {

struct ShellSettings {
  HeightRange range{80.0, 250.0};
  double step_km = 3.0;
  double grid_km = 5.0;  ///< between places of the shell
  double lowest_elevation_deg =
      30.0;                    ///< of either view: lower down a curtain's height is taken for its width
  double farthest_km = 400.0;  ///< along the ground, from the middle of the two cameras
  int channel = 1;             ///< of Photo::linear
  double moved_km = 0.0;  ///< standard deviation of each horizontal component of what drift and clocks make
};

/// A height that the pictures allow.
struct ShellHeight {
  double km = 0.0, error_km = 0.0;  ///< of the peak's own width, pieces of the picture, pointing and clocks
  double correlation = 0.0;
  double weight = 0.0;  ///< of 1, among all
};

struct ShellCorrelation {
  std::vector<double> height_km, correlation;  ///< NaN where too few places are seen by both
  double independent_places = 0.0;
  std::size_t places = 0;            ///< at the best height
  std::vector<ShellHeight> heights;  ///< most probable first; none if no correlation is better than
                                     ///< chance, or it hardly depends on the height
};

/// `cameras` has the two, with their errors; the pictures must have their cameras' sizes. Pixels that are not
/// usable are left out. The same pictures give the same answer.
ShellCorrelation shell_correlation(const std::vector<ViewPoint>& cameras,
                                   const std::vector<const Photo*>& photos, const ShellSettings& settings);

}  // namespace vegard::fit
