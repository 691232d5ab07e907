// Repeated descents for fits with priors: the weight of a prior depends on the misfit of the data, and the
// misfit depends on the weight. The same holds for the smoothness of free-form profiles.
#pragma once

#include "fit/search/descent.h"
#include "fit/search/journal.h"

namespace vegard::fit {

struct Settled {
  Descent descent;          ///< the last one
  SplinePrior prior;        ///< with the final smoothness
  double inflation = 1.0;   ///< error inflation by which the prior's rows are weighted (see append_rows)
  double determined = 0.0;  ///< effective number of free parameters that the data determine
};

/// Weight of the prior's rows for a first descent, before any residuals are known.
inline constexpr double kFirstPriorWeight = 10.0;

/// Returns the smoothness for a first descent: the user's, or one for which second differences are about 1.
double first_smoothness(const sim::Scene& scene);

/// Repeats descents from `from`, each with newly estimated inflation and smoothness (unless
/// fit.profile_smoothness gives it), until neither changes by more than a tenth, but at most five times. For
/// fits with priors or free-form profiles. Every descent is a step of `journal`.
Settled settle(const sim::Scene& scene, const std::vector<FreeNumber>& free,
               const std::vector<CostTerm>& terms, const Descent& from, EvaluationLog& log,
               std::vector<TraceRow>& trace, Journal* journal = nullptr);

}  // namespace vegard::fit
