// Repeated descents for fits with priors: the weight of a prior depends on the misfit of the data, and the
// misfit depends on the weight. The same holds for the smoothness of free-form profiles.
#pragma once

#include "fit/search/descent.h"
#include "fit/search/journal.h"

namespace vegard::fit {

struct Settled {
  Descent descent;          ///< the last
  SplinePrior prior;        ///< with the smoothness in force
  double inflation = 1.0;   ///< with which the prior's rows are weighted (see append_rows)
  double determined = 0.0;  ///< how many of the free numbers the data determine
};

/// Weight of the prior's rows for a first descent, before any residuals are known.
inline constexpr double kFirstPriorWeight = 10.0;

/// Smoothness for a first descent: the user's, or one that lets second differences be about 1.
double first_smoothness(const sim::Scene& scene);

/// Descents from `from`, with inflation and smoothness (unless fit.profile_smoothness says) taken again
/// before each, until neither changes by more than a tenth, or five times. For fits with priors or free-form
/// profiles. Every round is a step of `journal`.
Settled settle(const sim::Scene& scene, const std::vector<FreeNumber>& free,
               const std::vector<CostTerm>& terms, const Descent& from, EvaluationLog& log,
               std::vector<TraceRow>& trace, Journal* journal = nullptr);

}  // namespace vegard::fit
