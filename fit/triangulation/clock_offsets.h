// What the movement of the light between pictures says of their clocks, and what the clocks leave of the
// height.
//
// Each picture's clock is off by a normal number of seconds. The light drifts with one level velocity, normal
// in both directions, the same for all pictures. Of each pair is known by how much the light had moved across
// the base, and a border's height, which a movement along the base has made wrong. For a given velocity all
// of this is linear in the offsets and the height, so their means and covariances are exact; velocities are
// summed over a grid by their probabilities. The grid is made finer where the probability is, down to the
// width that the pairs tell it to; where that would be too many velocities, its steps count as errors. Where
// the light hardly moves, or the velocity can be anything, offsets remain as uncertain as they were.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace vegard::fit {

/// What two pictures say (fit/triangulation/curtain_profiles.h).
struct MovedPair {
  std::size_t first = 0, second = 0;
  double apart_s = 0.0;  ///< by the clocks: the second one's time minus the first one's
  double border_km = 0.0, across_km = 0.0;
  Eigen::Matrix2d covariance_km2 = Eigen::Matrix2d::Identity();  ///< of both
  double border_km_per_km = 0.0;  ///< border_km is too high by this for each km along the base
  Eigen::Vector3d along, across;  ///< unit vectors
};

struct ClockOffset {
  double s = 0.0;        ///< to be added to the picture's time
  double error_s = 0.0;  ///< standard error
  bool is_told = false;  ///< the pictures say something: the error is below 0.8 of what it was before
};

struct ClockSolution {
  std::vector<ClockOffset> offsets;   ///< of each picture
  double border_km, border_error_km;  ///< with the clocks' part; NaN without pairs

  ClockSolution();
};

/// `clock_error_s`: standard error of each clock, before. `drift_km_s`: standard deviation of each component
/// of the velocity. Pairs of the same pictures share their light: with more pairs than pictures less one,
/// their covariances count as larger in that proportion.
ClockSolution clock_solution(std::size_t pictures, const std::vector<MovedPair>& pairs, double clock_error_s,
                             double drift_km_s);

}  // namespace vegard::fit
