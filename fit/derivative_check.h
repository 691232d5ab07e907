// Checks a cost's exact Jacobian against central differences over a range of steps.
//
// Central differences depend on their step: long steps suffer from curvature and kinks, short ones from the
// rounding of the film. If the exact derivative is right, there are steps in between at which both agree. If
// it is wrong, no step gives agreement.
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
  no_effect,  ///< both are negligible: the gains absorb the change, or it is out of view
};

/// "agree", "differ", "no effect".
const char* derivative_verdict_name(DerivativeVerdict verdict);

/// One coordinate of a cost that is to be checked.
struct CheckedCoordinate {
  std::string name;
  double at = 0.0;
  double natural_step = 1.0;  ///< a typical change of the coordinate
};

struct DerivativeCheck {
  std::string name;
  double effect = 0.0;  ///< change of the residuals, in sigmas, by a natural step of the coordinate
  /// Relative difference |difference - column| / the longer of both, for each of derivative_steps(); NaN
  /// where the cost could not be evaluated.
  std::vector<double> differences;
  double best_step = 0.0;        ///< the one of derivative_steps() with the smallest difference
  double best_difference = 0.0;  ///< difference at best_step
  DerivativeVerdict verdict = DerivativeVerdict::differ;
};

/// The steps of the differences, as shares of a natural step, longest first: 1e-1 to 1e-5, two per decade.
const std::vector<double>& derivative_steps();

/// Checks the coordinates one after the other. `told`, if any, is called with the finished share, 0 to 1. If
/// `stop` is raised, returns the checks that are finished.
std::vector<DerivativeCheck> check_derivatives(const ceres::CostFunction& cost,
                                               const std::vector<CheckedCoordinate>& coordinates,
                                               const std::function<void(double share)>& told = nullptr,
                                               const std::atomic<bool>* stop = nullptr);

/// Checks the whole cost of a scene's fit at its start and at full resolution: transforms, priors, gains and
/// sky included. The natural step of a parameter is its value where its scale is logarithmic, else one of its
/// unit. Throws as fit_photo() does.
std::vector<DerivativeCheck> check_derivatives(const sim::Scene& scene, const Photo& photo, int threads,
                                               const std::function<void(double share)>& told = nullptr,
                                               const std::atomic<bool>* stop = nullptr);

}  // namespace vegard::fit
