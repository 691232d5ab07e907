// Many measurements of one night, inverted together: the physics behind their light is the same, so that each
// tells something about it, and is better known by all the others.
//
// Each measurement i has its own electrons x_i. Of the variance of each coefficient of the tables' modes, the
// share kOwnShare belongs to the measurement (the air and how long the electrons have fallen change within a
// night), the rest to all of them. Errors of calibration are in common too: each line has a factor, of which
// the standard deviation is the line's usual relative error. Linear about each measurement's best electrons,
// with these eliminated, the measurements' information about what is common adds up; the solution is
// iterated.
#pragma once

#include <vector>

#include "fit/columns/column_chi2.h"

namespace vegard::fit {

/// ESTIMATED: chemistry and cross sections are most of the variance of the lines' light.
inline constexpr double kOwnShare = 0.2;

struct LearntPhysics {
  CommonLight common;                ///< for a further measurement of the night
  std::vector<CommonLight> without;  ///< by measurement: by what all the others tell
  std::size_t used = 0;              ///< measurements that contradict no tables, which alone count
  /// What they ask of the tables' light, at the median of their energies and fluxes.
  std::vector<LineCorrection> corrections;
};

/// `chi2` has a model with modes, without such knowledge. Measurements without a solution are left out.
LearntPhysics learn_physics(const ColumnChi2& chi2, const std::vector<ColumnData>& measurements, int threads);

}  // namespace vegard::fit
