// The same photograph fitted by different scenes: which of them it favours.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/information_criteria.h"
#include "fit/report/table/run_summary.h"

namespace vegard::fit {

struct ComparedRun {
  RunSummary run;
  InformationCriteria criteria;
  double bic_difference = 0.0;  ///< to the best; 0 for it
  double aic_difference = 0.0;  ///< to the least of all
};

struct RunComparison {
  std::vector<ComparedRun> runs;  ///< as they were given
  std::size_t best = 0;           ///< index of the least BIC
  double independent_values = 0;
  std::vector<std::string>
      sentences;  ///< the best against each of the others, in the scale of Kass and Raftery
};

/// Throws sim::Error(usage) unless all runs are of the same photographs, masks, decoding, regions, number of
/// values and noise: chi2 of different data cannot be compared. Errors are believed as far as the run with
/// most unknowns has it (fit/answer/information_criteria.h). At least two runs.
RunComparison compared(const std::vector<RunSummary>& runs);

}  // namespace vegard::fit
