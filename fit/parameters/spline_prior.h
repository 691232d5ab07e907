// The prior of free-form height profiles: profiles are smooth, and their scale is fixed where free gains
// leave it unconstrained.
#pragma once

#include <vector>

#include "fit/parameters/free_parameters.h"
#include "fit/parameters/prior_rows.h"

namespace vegard::fit {

/// The change of the slope of ln(c) at a knot, times the mean of the two intervals beside it: sum of factor *
/// ln(value). A profile without bends is exponential in altitude.
struct Bend {
  int numbers[3];
  double factors[3];
};

/// The free numbers that are the coefficients of one line of one sheet, from the bottom up.
struct SplineLine {
  int sheet = 0, line = 0;
  std::vector<int> knots;    ///< which knots are free
  std::vector<int> numbers;  ///< their indices among the free numbers
  std::vector<Bend> bends;
};
std::vector<SplineLine> spline_lines(const sim::Scene& scene, const std::vector<FreeNumber>& free);

/// The prior of a fit's free-form profiles, for the whole fit or one round of it.
///
/// Smoothness: every bend of ln(c) against altitude is normal about 0 with a standard deviation of 1 /
/// smoothness. (Whittaker's graduation, 1922, doi:10.1017/S0013091500077853, of the logarithm: profiles that
/// decrease exponentially, as light does at high altitude, are not penalised.)
///
/// Scale: where gains are solved for, brighter coefficients with smaller gains give the same picture. Unless
/// the scale is given by something that is not free, the column of 557.7 nm (of the scene's first line, if
/// 557.7 nm is not free) is held at its start value, to kScaleError.
struct SplinePrior {
  static constexpr double kScaleError = 1e-3;

  std::vector<SplineLine> lines;
  std::vector<double> smoothness;  ///< per element of `lines`
  bool holds_scale = false;
  double log_column = 0.0;  ///< of the line that fixes the scale, over all sheets, times their energy flux

  bool any() const { return !lines.empty(); }
};

/// Returns the prior with the same `smoothness` for all lines; the start values are those of `free`.
SplinePrior spline_prior(const sim::Scene& scene, const std::vector<FreeNumber>& free, double smoothness);

/// Appends the rows, times `weight`. Where the data's chi2 is divided by an inflation squared only later, the
/// weight must be the inflation: then the sum of both is right.
void append_rows(const SplinePrior& prior, const sim::Scene& scene, double weight, PriorRows& rows);

/// Returns for each line the smoothness that maximises the probability of the data, with the model linearised
/// about the optimum `at` under `prior`. Method: expectation-maximisation (Dempster, Laird and Rubin 1977),
/// in which 1 / smoothness^2 is the mean square of the bends at the optimum plus their remaining variance.
/// Coordinates must be ln(value) for coefficients; for the others any will do. The information matrices are
/// row-major: `information` of the data alone, `other_information` of priors other than this one. `weight` is
/// that of append_rows() at the optimum, divided by the inflation by whose square `information` is divided.
/// `determined`, if not null, receives the number of coordinates that the data determine.
std::vector<double> most_probable_smoothness(const SplinePrior& prior, const std::vector<double>& information,
                                             const std::vector<double>& other_information,
                                             const std::vector<double>& at, double weight,
                                             double* determined);

}  // namespace vegard::fit
