// The outcome of the search, and its form in a journal.
#pragma once

#include <vector>

#include "fit/search/journal.h"

namespace vegard::fit {

struct SearchOutcome {
  Descent best;                 ///< of the full model
  std::vector<Descent> others;  ///< ends of the other polished descents, best first; for the verdict
  double chi2_initial = 0.0;    ///< of the full model at the user's start
};

/// As the output of a step, and back.
StepOutput output_of(const SearchOutcome& outcome);
SearchOutcome search_outcome_of(const StepOutput& output, std::size_t free);

}  // namespace vegard::fit
