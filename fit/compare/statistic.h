// A statistic is a quantity other than mean light itself that is computed of a photograph and of a model,
// and compared.
//
// Intensity in bins (profiles, a coarse image) is linear in the gains and the sky, and takes part in solving
// for them (fit/compare/linear_part.h). A statistic takes what was solved: the gains and the sky are those
// that minimise the chi2 of the linear ones at the same parameters, and its Jacobian has their change in it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::fit {

/// Light in the bins of the profile, indexed as in Profile; slopes [value index * free + parameter], empty if
/// not asked for.
struct SolvedLight {
  std::vector<double> aurora;  ///< gain times the model's aurora
  std::vector<double> behind;  ///< the solved sky and the night sky's known lights
  int free = 0;
  std::vector<double> aurora_slope, behind_slope;
};

/// What a statistic is of. `numbers` are the scene's that move, for what follows from no bin: which they
/// are and, row-major [number][parameter], d number / d parameter (empty: the identity).
struct StatisticInput {
  const SolvedLight& light;
  const sim::Scene& scene;
  const std::vector<sim::ParameterId>& numbers;
  const std::vector<double>& slopes;
};

class Statistic {
 public:
  virtual ~Statistic() = default;
  virtual std::string name() const = 0;
  /// How many; which ones is the photograph's matter, never the model's.
  virtual std::size_t residuals() const = 0;
  /// Writes (data - model) / sigma, of a standard deviation of 1 where the model is right. If `jacobian` is
  /// not null, also d residual / d parameter, row-major [residual][parameter], and `light` must have slopes.
  virtual void evaluate(const StatisticInput& input, double* residual, double* jacobian) const = 0;

  /// Whether its residuals go up and down together as far as the profile's do, whose bins it is made of.
  virtual bool is_of_the_profile() const { return true; }

  /// What a statistic has solved for by itself, with its standard deviation for a scene that is right; 0:
  /// none.
  struct Solved {
    std::string name;
    double value = 0.0, sigma = 0.0;
  };
  virtual std::vector<Solved> solved(const sim::Scene& /*scene*/) const { return {}; }
};

}  // namespace vegard::fit
