// The part of a run's result.json that is needed to compare models.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vegard::fit {

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

}  // namespace vegard::fit
