// Compares fits of the same photograph by different scenes: which of them it favours.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fit/answer/information_criteria.h"

namespace vegard::fit {

/// The part of a run's result.json that is needed to compare models.
struct RunSummary {
  struct Parameter {
    double value = 0.0;
    std::optional<double> sigma;
    std::string unit;
  };

  std::string name;     ///< the run's directory, as the user gave it
  std::string verdict;  ///< verdict_name()
  std::map<std::string, Parameter> parameters;
  std::vector<std::string> paths;  ///< of the parameters, in the run's order
  double chi2 = 0.0;
  int dof = 0;
  double correlated_residuals = 1.0;

  /// Role and SHA-256 of the photographs and masks, in the run's order.
  std::vector<std::array<std::string, 2>> pictures;
  std::string decoding;
  std::vector<std::array<int, 4>> regions_px;
  int values = 0;  ///< number of compared values
  double sum_of_weights = 0.0;
  double sampling_error = 0.0;  ///< sampling noise of the model, as a fraction of the brightness
  int unknowns = 0;             ///< number of free and solved parameters
};

/// Reads DIRECTORY/result.json. Throws sim::Error(unreadable_input) if it is missing, is not JSON, or lacks
/// needed values (a run of an older version, a fit without a result).
RunSummary read_run(const std::string& directory);

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
