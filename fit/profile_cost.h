// The cost that Ceres minimises: whitened differences between the photograph's profiles and the model's.
#pragma once

#include <ceres/cost_function.h>

#include <atomic>
#include <functional>
#include <limits>
#include <vector>

#include "fit/free_parameters.h"
#include "fit/linear_part.h"
#include "fit/prior_rows.h"
#include "fit/profile_model.h"
#include "fit/spline_prior.h"

namespace vegard::fit {

/// Counts and the best point met, over all descents of a fit.
struct EvaluationLog {
  int residuals = 0, jacobians = 0;
  int limit = std::numeric_limits<int>::max();
  const std::atomic<bool>* stop = nullptr;
  double best_chi2 = std::numeric_limits<double>::infinity();
  bool best_is_full = false;
  std::vector<double> best_values;
  bool exhausted() const { return residuals >= limit || (stop != nullptr && stop->load()); }
};

/// Some of a fit's parameters, the others held where the scene has them. Residuals: the profile's, then the
/// priors' rows. The Jacobian is exact: tangents through the renderer, the linear part by variable
/// projection, the transform's slope.
class ProfileCost : public ceres::CostFunction {
 public:
  /// All references must outlive the cost. `base` holds the values of what is not free here.
  /// The rows of `prior` (fit/spline_prior.h) are taken times `prior_weight`.
  ProfileCost(const sim::Scene& base, const std::vector<FreeNumber>& free, ProfileModel& model,
              const LinearPart& linear, EvaluationLog& log, const SplinePrior& prior = {},
              double prior_weight = 1.0);

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

  /// The pieces behind an evaluation, for whoever needs more than residuals.
  struct Point {
    std::vector<double> values;
    ModelProfile aurora;
    LinearSolution solution;
    double chi2 = 0.0;  ///< priors included
  };
  Point at(const std::vector<double>& values, bool with_derivatives) const;

 private:
  sim::Scene base_;
  const std::vector<FreeNumber>& free_;
  ProfileModel& model_;
  const LinearPart& linear_;
  EvaluationLog& log_;
  PriorRows priors_;
};

}  // namespace vegard::fit
