// The cost that Ceres minimises: whitened differences between photographs' statistics and a model's.
#pragma once

#include <ceres/cost_function.h>

#include <atomic>
#include <functional>
#include <limits>
#include <vector>

#include "fit/compare/comparison.h"
#include "fit/compare/robust_loss.h"
#include "fit/parameters/free_parameters.h"
#include "fit/parameters/parameter_map.h"
#include "fit/parameters/phase_anchor.h"
#include "fit/parameters/prior_rows.h"
#include "fit/parameters/spline_prior.h"

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

/// One photograph's share of a cost.
struct CostTerm {
  sim::Scene scene;  ///< with whatever is not free
  ParameterMap map;
  Comparison* comparison = nullptr;  ///< must outlive the cost
};

/// Some of a fit's free numbers, the others held. Residuals: the photographs' one after the other, then the
/// priors' rows. The Jacobian is exact: tangents through the renderer, the linear part by variable
/// projection, the map's and the transforms' slopes.
class ProfileCost : public ceres::CostFunction {
 public:
  struct Options {
    /// Indices of the free numbers that move; empty: all.
    std::vector<int> moved;
    /// Values of all free numbers, of which those that do not move stay; may be empty if all move.
    std::vector<double> held;
    /// Rows of free-form profiles (fit/parameters/spline_prior.h), beside the numbers' own priors. All are
    /// taken times `prior_weight`: where the data's chi2 is to be divided by an inflation squared, rows times
    /// the inflation make the sum of both right.
    SplinePrior prior;
    double prior_weight = 1.0;
    /// Of the numbers that move. The solver's coordinate of a phase then is that of the phase in view.
    std::vector<PhaseAnchor> anchors = {};
  };

  /// Log and comparisons must outlive the cost.
  ProfileCost(const std::vector<FreeNumber>& free, const std::vector<CostTerm>& terms, EvaluationLog& log,
              const Options& options);
  ProfileCost(const std::vector<FreeNumber>& free, const std::vector<CostTerm>& terms, EvaluationLog& log);

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

  /// The free numbers that move, in the order of the coordinates.
  const std::vector<FreeNumber>& moved() const { return moved_; }
  const std::vector<CostTerm>& terms() const { return terms_; }
  const std::vector<PhaseAnchor>& anchors() const { return anchors_; }
  double prior_weight() const { return prior_weight_; }
  /// Of the photographs alone.
  int data_residuals() const { return data_residuals_; }

  /// The values of what moves, from the solver's coordinates and back.
  std::vector<double> values(double const* coordinates) const;
  std::vector<double> coordinates(const std::vector<double>& values) const;

  /// The pieces behind an evaluation, for whoever needs more than residuals.
  struct Point {
    std::vector<double> values;  ///< of what moves
    std::vector<Comparison::Point> of_photo;
    double chi2 = 0.0;  ///< priors included; infinite where a tie leads beyond its parameter's limits
  };
  Point at(const std::vector<double>& values, bool with_derivatives) const;

  /// d residual / d value of the photographs, row-major [residual][moved], of a point with derivatives.
  void data_jacobian(const Point& point, std::vector<double>& out) const;
  /// Rows of derivatives by values become rows of derivatives by the solver's coordinates.
  void by_coordinates(const std::vector<double>& values, std::vector<double>& jacobian) const;
  /// Residuals of the photographs one after the other, as the scene's fit.loss has them.
  std::vector<double> data_residual(const Point& point) const;

 private:
  std::vector<double> all_values(const std::vector<double>& values) const;

  const std::vector<CostTerm> terms_;
  const RobustLoss loss_;
  EvaluationLog& log_;
  const std::vector<double> held_;
  const std::vector<PhaseAnchor> anchors_;
  const double prior_weight_;
  std::vector<int> which_;
  std::vector<FreeNumber> moved_;
  int data_residuals_ = 0;
  PriorRows priors_;
};

/// That of all photographs: the means of their own factors' squares and of their residuals that go together,
/// by their number of residuals. `unknowns` are all that were found from the data.
Inflation joint_inflation(const ProfileCost& cost, const ProfileCost::Point& point, int unknowns);

}  // namespace vegard::fit
