// The tables of a report, as HTML.
#pragma once

#include <string>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

/// Cards with the derived numbers for publication; empty if there are none.
std::string derived_cards(const FitResult& result);

/// The most important numbers in a sentence: up to three that are good, else up to three that are doubtful.
/// If the fit is not good and determines none, the sentence says so.
std::string answer_sentence(const FitResult& result);

/// Derived numbers without a card: details, and unconstrained ones with the reason; empty if there are none.
std::string derived_table(const FitResult& result);

/// A sentence for each correction after a line of words; empty if there are none.
std::string corrections_list(const std::vector<TablesCorrection>& corrections, const std::string& before);

/// The same of FitResult::tables.
std::string tables_list(const FitResult& result);

/// Path, meaning, value ± sigma, unit, 68 % interval, start, limits.
std::string parameter_table_html(const FitResult& result);

/// Path, meaning, value ± sigma, unit, what it equals; empty if nothing is tied.
std::string tied_table(const FitResult& result);

/// Gains and sky of a photograph.
std::string solved_table(const FittedPhoto& fitted);

/// What each radar measured and what falls at its field line.
std::string radars_table(const FitResult& result);

/// chi2 and rms of each photograph, and how it was decoded.
std::string photos_table(const FitResult& result);

/// Coloured cells; empty for fewer than two parameters.
std::string correlation_table(const FitResult& result);

/// chi2 and the other statistics of the fit, each with a sentence that explains it.
std::string statistics_table(const FitResult& result);

/// Version, seed, command, inputs with their hashes, decoding.
std::string provenance_table(const FitResult& result);

}  // namespace vegard::fit
