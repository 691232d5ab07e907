// Compares fits of the same photograph by different scenes: which of them it favours.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/information_criteria.h"
#include "fit/report/table/run_summary.h"

namespace vegard::fit {

struct ComparedRun {
  RunSummary run;
  InformationCriteria criteria;
  double bic_difference = 0.0;  ///< BIC less that of the best; 0 for the best
  double aic_difference = 0.0;  ///< AIC less the lowest of all
};

struct RunComparison {
  std::vector<ComparedRun> runs;  ///< in the order given
  std::size_t best = 0;           ///< index of the lowest BIC
  double independent_values = 0;
  std::vector<std::string> sentences;  ///< the best against each of the others, in words of Kass and Raftery
};

/// Compares at least two runs. Throws sim::Error(usage) unless all are of the same photographs, masks,
/// decoding, regions, number of values and noise: chi2 of different data cannot be compared. chi2 is scaled
/// as for the run with most unknowns (fit/answer/information_criteria.h).
RunComparison compared(const std::vector<RunSummary>& runs);

}  // namespace vegard::fit
