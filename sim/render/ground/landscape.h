// A made landscape around the observer: a snowed-in lake or mire with wind drifts, conifers on its shores and
// low hills, bare above the trees.
//
// Nothing here is a real place's. Heights are sums of gradient noise: drifts of 0.4 to 15 m, land of 300 m to
// 9 km. Sizes are ours, chosen to look like the north of Sweden: hills up to 0.4 km and trees of 4 to 13 m,
// none nearer than 0.15 km.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/number/noise.h"

namespace vegard::sim {

/// A place of the landscape that the observer sees.
struct LandscapePoint {
  float sine;         ///< of its elevation
  float distance_m;   ///< along the ground
  float slope_east;   ///< metres of height per metre
  float slope_north;  ///< the same
  float snow;         ///< share that snow covers; trees cover the rest
  float light;        ///< factor of what it reflects: older snow, thinner trees
};

class Landscape {
 public:
  static constexpr double kEye_m = 1.7;           ///< the observer's eye above the ground
  static constexpr double kHighestSine = 0.3;     ///< bound of a place's elevation
  static constexpr double kFarthest_m = 40000.0;  ///< where the landscape ends

  explicit Landscape(std::uint64_t seed);

  /// Puts into `seen` what is seen in a direction (clockwise from north), at and above an elevation, about
  /// one place per `step_rad` of elevation: each is higher than the one before. The Earth is round.
  void look(double azimuth_rad, double lowest_sine, double step_rad, std::vector<LandscapePoint>& seen) const;

 private:
  struct Surface {
    double height_m, slope_east, slope_north, snow, light;
  };
  Surface surface(double east_m, double north_m, double distance_m, double step_m, double hidden_m,
                  bool seen) const;
  double tree_m(double east_m, double north_m, double step_m, double& light) const;

  std::uint64_t seed_;
  NoiseLattice noise_;
};

}  // namespace vegard::sim
