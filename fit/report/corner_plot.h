// Every parameter against every other: where error bars come from, and what trades off against what.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fit/answer/fit_result.h"

namespace vegard::fit {

struct CornerParameter {
  std::string name;  ///< "energy_kev"
  std::string unit;
  double value = 0.0;
  std::optional<double> sigma;  ///< none: only the samples, where there are any, say how wide
};

struct CornerData {
  std::vector<CornerParameter> parameters;
  std::vector<std::vector<double>> correlation;  ///< of the covariance
  std::vector<double> samples;                   ///< of a chain, [sample][parameter]; may be empty
  std::vector<std::string> left_out;             ///< names of parameters with no width to show
};

/// What a result has to show: parameters with an error bar or a chain, coefficients of free-form profiles
/// left out (they are shown as curves). With one sheet in the scene its name is left out of the names.
CornerData corner_data(const FitResult& result);

/// Indices, ascending, of the at most `most` parameters whose strongest correlation with another is
/// strongest.
std::vector<std::size_t> most_correlated(const CornerData& data, std::size_t most);

/// An SVG document as plot_svg() makes it. Below the diagonal: ellipses on which chi2 has risen by 1 and by 4
/// as the covariance has it (they hold 39 % and 86 % of a normal distribution), dots of the chain, the
/// correlation. On the diagonal: the normal distribution of that sigma, and the chain's histogram, both of
/// area 1. Of more than ten parameters the ten of the strongest correlations. Empty for fewer than two.
std::string corner_plot_svg(const CornerData& data);

}  // namespace vegard::fit
