// The derivative doctor: a cost's exact Jacobian beside central differences over a range of steps.
//
// Exact derivatives have no step and so nothing to compare with but differences, which have: long ones see
// curvature and kinks, short ones the rounding of the film. Between both there is a stretch on which the two
// agree, if the derivative is right. If it is wrong, none of the steps agrees.
#pragma once

#include <ceres/cost_function.h>

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

enum class DerivativeVerdict {
  agree,
  differ,
  no_effect,  ///< neither derivative nor differences: the gains take it up, or it is out of view
};

/// "agree", "differ", "no effect".
const char* derivative_verdict_name(DerivativeVerdict verdict);

/// One coordinate of a cost, to be checked.
struct CheckedCoordinate {
  std::string name;
  double at = 0.0;
  double natural_step = 1.0;  ///< of the coordinate, of the order of what would be called a change
};

struct DerivativeCheck {
  std::string name;
  double effect =
      0.0;  ///< length of the Jacobian's column, per natural step: a change of residuals, in sigmas
  /// |difference - column| / the longer of both, for every one of derivative_steps(); NaN where the cost
  /// could not be evaluated.
  std::vector<double> differences;
  double best_step = 0.0;        ///< the one of derivative_steps() with the least
  double best_difference = 0.0;  ///< there
  DerivativeVerdict verdict = DerivativeVerdict::differ;
};

/// Shares of a natural step, longest first: 1e-1 to 1e-5, two to a decade.
const std::vector<double>& derivative_steps();

/// One by one. `told`, if any, hears the finished share, 0 to 1; a `stop` that is raised ends with what there
/// is.
std::vector<DerivativeCheck> check_derivatives(const ceres::CostFunction& cost,
                                               const std::vector<CheckedCoordinate>& coordinates,
                                               const std::function<void(double share)>& told = nullptr,
                                               const std::atomic<bool>* stop = nullptr);

/// Of the whole cost of a scene's fit at its start and full resolution: transforms, priors, gains and sky
/// included. The natural step is the parameter itself where its scale is logarithmic, else one of its unit.
/// Throws as fit_photo() does.
std::vector<DerivativeCheck> check_derivatives(const sim::Scene& scene, const Photo& photo, int threads,
                                               const std::function<void(double share)>& told = nullptr,
                                               const std::atomic<bool>* stop = nullptr);

}  // namespace vegard::fit
