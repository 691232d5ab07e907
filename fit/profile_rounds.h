// Free-form profiles take a few descents: how smooth they are follows from how well they fit, and how well
// they fit from how smooth they are.
#pragma once

#include "fit/descent.h"
#include "fit/journal.h"

namespace vegard::fit {

struct SettledProfiles {
  Descent descent;          ///< the last
  SplinePrior prior;        ///< with the smoothness in force
  double inflation = 1.0;   ///< with which the prior's rows are weighted (see append_rows)
  double determined = 0.0;  ///< how many of the free numbers the data determine
};

/// Weight of the prior's rows for a first descent, before any residuals are known.
inline constexpr double kFirstPriorWeight = 10.0;

/// Smoothness for a first descent: the user's, or one that lets second differences be about 1.
double first_smoothness(const sim::Scene& scene);

/// Descents from `from`, with smoothness (unless fit.profile_smoothness says) and inflation taken anew before
/// each, until neither changes by more than a tenth, or five times. Every round is a step of `journal`.
SettledProfiles settle_profiles(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                                const std::vector<CostTerm>& terms, const Descent& from, EvaluationLog& log,
                                std::vector<TraceRow>& trace, Journal* journal = nullptr);

}  // namespace vegard::fit
