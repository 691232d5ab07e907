// The cost function that Ceres minimises: differences between the statistics of photographs and of a model,
// in units of sigma.
#pragma once

#include <ceres/cost_function.h>

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "fit/compare/comparison.h"
#include "fit/compare/radars.h"
#include "fit/parameters/free_parameters.h"
#include "fit/parameters/parameter_map.h"
#include "fit/parameters/phase_anchor.h"
#include "fit/parameters/prior_rows.h"
#include "fit/parameters/spline_prior.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

// Robust losses reduce the weight of outliers among the residuals.

/// Residuals r become sign(r) sqrt(rho(r^2)), whose squares add up to the robust chi2. Huber (1964,
/// doi:10.1214/aoms/1177703732): rho = r^2 up to d, then 2 d |r| - d^2; Cauchy: rho = d^2 ln(1 + r^2 / d^2);
/// d is fit.loss_sigma. Gains and sky are solved for without it.
class RobustLoss {
 public:
  explicit RobustLoss(const sim::Fit& fit);

  bool any() const { return kind_ != sim::ResidualLoss::none; }
  double residual(double r) const;
  double slope(double r) const;  ///< d residual(r) / d r, above 0

 private:
  sim::ResidualLoss kind_;
  double d_;
};

/// Number of evaluations and the best point so far, over all descents of a fit.
struct EvaluationLog {
  int residuals = 0, jacobians = 0;
  int limit = std::numeric_limits<int>::max();
  const std::atomic<bool>* stop = nullptr;
  double best_chi2 = std::numeric_limits<double>::infinity();
  bool best_is_full = false;
  std::vector<double> best_values;
  bool exhausted() const { return residuals >= limit || (stop != nullptr && stop->load()); }
};

/// The part of a cost that belongs to one photograph.
struct CostTerm {
  sim::Scene scene;  ///< gives the values of all that is not free
  ParameterMap map;
  Comparison* comparison = nullptr;             ///< must outlive the cost
  std::shared_ptr<const RadarTerm> radar = {};  ///< of the whole fit; only the first term may have one
};

/// The cost as a function of some of a fit's free numbers; the others are held. Residuals: those of each
/// photograph in turn, then the rows of the priors, to which those of radars belong: their errors are their
/// own, whatever those of the photographs are multiplied by. The Jacobian is exact: tangents through the
/// renderer, variable projection for the linear part, and the derivatives of the parameter map and of the
/// transforms.
class ProfileCost : public ceres::CostFunction {
 public:
  struct Options {
    /// Indices of the free numbers that vary; empty: all.
    std::vector<int> moved;
    /// Values of all free numbers, of which the ones that do not vary are used; may be empty if all vary.
    std::vector<double> held;
    /// Prior rows of free-form profiles (fit/parameters/spline_prior.h), in addition to the numbers' own
    /// priors. All prior rows are multiplied by `prior_weight`. Where the data's chi2 is divided by an
    /// inflation squared only later, the weight must be the inflation: then the sum of both is right.
    SplinePrior prior;
    double prior_weight = 1.0;
    /// Anchors of phases among the numbers that vary. The solver's coordinate of such a phase is that of the
    /// phase in view.
    std::vector<PhaseAnchor> anchors = {};
  };

  /// The log and the comparisons must outlive the cost.
  ProfileCost(const std::vector<FreeNumber>& free, const std::vector<CostTerm>& terms, EvaluationLog& log,
              const Options& options);
  ProfileCost(const std::vector<FreeNumber>& free, const std::vector<CostTerm>& terms, EvaluationLog& log);

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

  /// The free numbers that vary, in the order of the coordinates.
  const std::vector<FreeNumber>& moved() const { return moved_; }
  const std::vector<CostTerm>& terms() const { return terms_; }
  const std::vector<PhaseAnchor>& anchors() const { return anchors_; }
  double prior_weight() const { return prior_weight_; }
  /// Number of residuals of the photographs alone.
  int data_residuals() const { return data_residuals_; }

  /// Converts the solver's coordinates to values of the varying numbers, and back.
  std::vector<double> values(double const* coordinates) const;
  std::vector<double> coordinates(const std::vector<double>& values) const;

  /// The intermediate results of an evaluation, for callers that need more than residuals.
  struct Point {
    std::vector<double> values;  ///< of the varying numbers
    std::vector<Comparison::Point> by_photo;
    double chi2 = 0.0;  ///< priors included; infinite where a tied number is beyond its limits
  };
  Point at(const std::vector<double>& values, bool with_derivatives) const;

  /// d residual / d value of the photographs, row-major [residual][moved], at a point with derivatives.
  void data_jacobian(const Point& point, std::vector<double>& out) const;
  /// Converts rows of derivatives by values to derivatives by the solver's coordinates.
  void by_coordinates(const std::vector<double>& values, std::vector<double>& jacobian) const;
  /// Residuals of each photograph in turn, with the robust loss fit.loss applied.
  std::vector<double> data_residual(const Point& point) const;
  /// Rows of the priors and the radars, and d residual / d value, row-major [row][moved].
  std::vector<double> prior_residual(const std::vector<double>& values) const;
  std::vector<double> prior_jacobian(const std::vector<double>& values) const;

 private:
  std::vector<double> all_values(const std::vector<double>& values) const;
  void evaluate_priors(const std::vector<double>& values, std::vector<double>& residuals,
                       std::vector<double>* jacobian) const;

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

/// Returns the inflation for all photographs together: the means of the squares of their own factors, and of
/// their numbers of correlated residuals, weighted with their numbers of residuals. `unknowns` is the number
/// of all unknowns that were found from the data.
Inflation joint_inflation(const ProfileCost& cost, const ProfileCost::Point& point, int unknowns);

}  // namespace vegard::fit
