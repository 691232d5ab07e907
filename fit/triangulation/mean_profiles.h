// The mean light of two pictures along the field lines through a border, and where it is brightest.
#pragma once

#include <vector>

#include "fit/triangulation/curtain_light.h"

namespace vegard::fit {

struct MeanProfiles {
  std::vector<double> above_km;  ///< the border
  /// The mean of the border's pieces, each from 0 to 1, in the order of the cameras.
  std::vector<double> light[2];
  /// The brightest place above the border, the median of the pieces, and its standard error by their scatter
  /// and the difference of the pictures; NaN where too few pieces have one.
  double peak_above_km, peak_above_error_km;

  MeanProfiles();
};

/// Returns the profiles of both cameras, with the border at this height.
MeanProfiles mean_profiles(const CurtainLight& curtain, const CurtainSupposition& supposed, double border_km);

}  // namespace vegard::fit
