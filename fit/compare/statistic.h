// The interface of statistics: quantities other than mean light itself that are computed from the photograph
// and from the model, and compared.
//
// Intensity in bins (profiles, a coarse image) is linear in the gains and the sky, which are solved from it
// (fit/compare/linear_part.h). A statistic uses the gains and the sky that minimise the chi2 of the linear
// residuals at the same parameters, and its Jacobian includes their change.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::fit {

/// Light in the bins of the profile, indexed as in Profile; slopes are indexed [value index * free +
/// parameter], and empty if not requested.
struct SolvedLight {
  std::vector<double> aurora;  ///< gain times the model's aurora
  std::vector<double> behind;  ///< the solved sky and the night sky's known lights
  int free = 0;
  std::vector<double> aurora_slope, behind_slope;
};

/// The input of a statistic. For statistics that are not computed from bins, `numbers` are the scene's
/// numbers that vary, and `slopes` their derivatives d number / d parameter, row-major [number][parameter]
/// (empty: the identity).
struct StatisticInput {
  const SolvedLight& light;
  const sim::Scene& scene;
  const std::vector<sim::ParameterId>& numbers;
  const std::vector<double>& slopes;
};

class Statistic {
 public:
  virtual ~Statistic() = default;
  /// Number of residuals. It depends on the photograph only, never on the model.
  virtual std::size_t residuals() const = 0;
  /// Writes (data - model) / sigma, which has a standard deviation of 1 where the model is right. If
  /// `jacobian` is not null, `light` must have slopes, and d residual / d parameter is written too, row-major
  /// [residual][parameter].
  virtual void evaluate(const StatisticInput& input, double* residual, double* jacobian) const = 0;

  /// Whether it is computed from the bins of the profile, so that its residuals are correlated over as many
  /// rows and bands as the profile's.
  virtual bool is_of_the_profile() const { return true; }

  /// A number that a statistic has solved by itself, with its standard deviation if the scene is right; 0: no
  /// standard deviation.
  struct Solved {
    std::string name;
    double value = 0.0, sigma = 0.0;
  };
  virtual std::vector<Solved> solved(const sim::Scene& /*scene*/) const { return {}; }
};

}  // namespace vegard::fit
