// The outcome of the search, and its form in a journal.
#pragma once

#include <vector>

#include "fit/search/journal.h"

namespace vegard::fit {

struct SearchOutcome {
  Descent best;                 ///< with the full model
  std::vector<Descent> others;  ///< the other polished descents, best first; for the verdict
  double chi2_initial = 0.0;    ///< of the full model at the user's start
};

/// Convert an outcome to a step's output, and back.
StepOutput output_of(const SearchOutcome& outcome);
SearchOutcome search_outcome_of(const StepOutput& output, std::size_t free);

}  // namespace vegard::fit
