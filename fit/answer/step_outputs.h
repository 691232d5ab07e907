// What the larger steps of a fit find, as outputs of steps, and back.
#pragma once

#include "fit/search/journal.h"
#include "fit/search/search.h"
#include "fit/uncertainty/uncertainty.h"

namespace vegard::fit {

StepOutput output_of(const SearchOutcome& outcome);
SearchOutcome search_outcome_of(const StepOutput& output);

StepOutput output_of(const Uncertainty& uncertainty);
Uncertainty uncertainty_of(const StepOutput& output);

}  // namespace vegard::fit
