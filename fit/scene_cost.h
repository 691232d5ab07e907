// The cost function of a scene's fit, for callers that need its residuals and their derivatives for a solver,
// a sampler or a check of their own.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fit/compare/observation.h"
#include "fit/compare/profile_cost.h"
#include "fit/parameters/free_parameters.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// The cost that the last descents of a fit minimise, at full resolution: statistics divided by the noise of
/// the photographs and of the model, with gains and sky solved at every point, then the rows of priors and of
/// free-form profiles with the weight of a first descent (kFirstPriorWeight). Not for use by two threads at
/// once.
class SceneCost {
 public:
  /// `photos` are those of scene.fit.photos in their order, or the only one; they must outlive the cost.
  /// Throws as fit_photo() and fit_photos() do.
  SceneCost(const sim::Scene& scene, const std::vector<const Photo*>& photos, int threads);
  SceneCost(const SceneCost&) = delete;
  SceneCost& operator=(const SceneCost&) = delete;

  /// The free numbers in the order of the columns of the Jacobian. A column includes the effect of numbers
  /// that are tied to its free number, and of all places that share its name.
  const std::vector<FreeNumber>& free() const { return free_; }
  const ProfileCost& cost() const { return *cost_; }
  int residuals() const { return cost_->num_residuals(); }
  /// How many of the residuals are of the photographs; these come first.
  int data_residuals() const { return cost_->data_residuals(); }
  /// The values from which a fit would start.
  std::vector<double> start() const;

  /// Says which value is outside its limits: "sheet.main.energy_kev = 25 is not within 0.05 to 20"; empty if
  /// none is.
  std::string beyond_limits(const std::vector<double>& values) const;

  /// Computes the residuals, in standard deviations, at `values` of free() in the scene's units and, if
  /// `jacobian` is not null, their derivatives by the values, row-major [residual][free]. Both arrays must
  /// have their sizes already. Returns false where the model has no value: a tied number is beyond its
  /// limits. The values must be within their limits (beyond_limits()); a value at a limit is treated as one
  /// just inside (FreeNumber::coordinate()).
  bool evaluate(const std::vector<double>& values, double* residuals, double* jacobian) const;

 private:
  std::vector<FreeNumber> free_;
  std::vector<Observation> observations_;
  mutable EvaluationLog log_;
  std::unique_ptr<ProfileCost> cost_;
};

}  // namespace vegard::fit
