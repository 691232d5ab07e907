// A corner plot: every parameter against every other, with their error ellipses and correlations.
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
  std::optional<double> sigma;  ///< none: the width is known from samples only, if there are any
};

struct CornerData {
  std::vector<CornerParameter> parameters;
  std::vector<std::vector<double>> correlation;  ///< by the covariance
  std::vector<double> samples;                   ///< of a chain, [sample][parameter]; may be empty
  std::vector<std::string> left_out;             ///< names of parameters with no width to show
};

/// Returns the data of a result: parameters with an error bar or a chain, without the coefficients of
/// free-form profiles (they are shown as curves). If the scene has only one sheet, the parameters' names omit
/// the sheet's name.
CornerData corner_data(const FitResult& result);

/// Returns the ascending indices of at most `most` parameters: those whose largest correlation with any other
/// is strongest.
std::vector<std::size_t> most_correlated(const CornerData& data, std::size_t most);

/// Returns an SVG document as plot_svg() does. Below the diagonal: ellipses on which chi2 has risen by 1 and
/// by 4 according to the covariance (they contain 39 % and 86 % of a normal distribution), the chain's
/// samples as dots, the correlation. On the diagonal: the normal distribution of that sigma, and the chain's
/// histogram, both of area 1. Of more than ten parameters, the ten with the strongest correlations are shown.
/// Empty for fewer than two.
std::string corner_plot_svg(const CornerData& data);

}  // namespace vegard::fit
