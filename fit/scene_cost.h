// The cost of a scene's fit by itself, for whoever wants its residuals and their derivatives and has a
// solver, a sampler or a doctor of their own.
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

/// The cost that a fit's last descents go down, at full resolution: statistics whitened by the photographs'
/// and the model's noise, gains and sky solved at every point, then the rows of priors and of free-form
/// profiles with the weight of a first descent (kFirstPriorWeight). Not for use by two threads at once.
class SceneCost {
 public:
  /// `photos` are those of scene.fit.photos in their order, or the only one; they must outlive the cost.
  /// Throws as fit_photo() and fit_photos() do.
  SceneCost(const sim::Scene& scene, const std::vector<const Photo*>& photos, int threads);
  SceneCost(const SceneCost&) = delete;
  SceneCost& operator=(const SceneCost&) = delete;

  /// In the order of the columns of the Jacobian; ties and further places of a name are theirs.
  const std::vector<FreeNumber>& free() const { return free_; }
  const ProfileCost& cost() const { return *cost_; }
  int residuals() const { return cost_->num_residuals(); }
  /// Of them, those of the photographs, which come first.
  int data_residuals() const { return cost_->data_residuals(); }
  /// Where a fit would start.
  std::vector<double> start() const;

  /// What is wrong with values that no scene may have: "sheet.main.energy_kev = 25 is not within 0.05 to 20";
  /// empty if nothing is.
  std::string beyond_limits(const std::vector<double>& values) const;

  /// Residuals, in standard deviations, at values of free() in the scene's units, and, if `jacobian` is not
  /// null, their derivatives by the values, row-major [residual][free]. Both have their sizes already. False
  /// where the model has no value: a tie that leads beyond its parameter's limits. No value lies beyond its
  /// limits (beyond_limits()); one at a limit counts as one just inside (FreeNumber::coordinate()).
  bool evaluate(const std::vector<double>& values, double* residuals, double* jacobian) const;

 private:
  std::vector<FreeNumber> free_;
  std::vector<Observation> observations_;
  mutable EvaluationLog log_;
  std::unique_ptr<ProfileCost> cost_;
};

}  // namespace vegard::fit
