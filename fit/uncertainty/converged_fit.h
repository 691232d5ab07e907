// A converged fit: the input of the validation of its error bars.
#pragma once

#include <vector>

#include "fit/compare/observation.h"
#include "fit/parameters/spline_prior.h"
#include "fit/uncertainty/uncertainty.h"

namespace vegard::fit {

/// The result of a fit and the inputs for its validation. The objects referred to must outlive it.
struct ConvergedFit {
  const sim::Scene& scene;
  const std::vector<FreeNumber>& free;
  const std::vector<Observation>& observations;
  const std::vector<double>& values;  ///< the answer, one for each of `free`
  const SplinePrior& prior;           ///< of free-form profiles
  double inflation = 1.0;
  const Uncertainty& uncertainty;  ///< in the numbers' own coordinates, without anchors (phase_anchor.h)

  /// Returns the answer in the numbers' own coordinates.
  std::vector<double> coordinates() const {
    std::vector<double> at;
    for (std::size_t j = 0; j < free.size(); ++j) at.push_back(free[j].coordinate(values[j]));
    return at;
  }
};

}  // namespace vegard::fit
