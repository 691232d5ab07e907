// The prior of free-form height profiles: they are smooth, and their scale is fixed where free gains leave
// it unconstrained.
#pragma once

#include <vector>

#include "fit/parameters/free_parameters.h"
#include "fit/parameters/prior_rows.h"

namespace vegard::fit {

/// How much steeper ln(c) rises above a knot than below it, times the mean of the two intervals: sum of
/// factor * ln(value). Without a bend, a profile is exponential in altitude.
struct Bend {
  int numbers[3];
  double factors[3];
};

/// Which of the free numbers are the coefficients of one line of one sheet, from the bottom up.
struct SplineLine {
  int sheet = 0, line = 0;
  std::vector<int> knots;    ///< which knots are free
  std::vector<int> numbers;  ///< their indices among the free numbers
  std::vector<Bend> bends;
};
std::vector<SplineLine> spline_lines(const sim::Scene& scene, const std::vector<FreeNumber>& free);

/// Prior rows of a fit's free-form profiles, for its whole duration or one round of it.
///
/// Smoothness: every bend of ln(c) against altitude is normal about 0 with a standard deviation of 1 /
/// smoothness. (Whittaker's graduation, 1922, doi:10.1017/S0013091500077853, of the logarithm: profiles that
/// fall exponentially, as light does high up, cost nothing.)
///
/// Scale: where gains are solved for, brighter coefficients with smaller gains are the same picture. Unless
/// something that is not free gives the scale, the column of 557.7 nm (of the scene's first line, if that is
/// not among them) stays at the start's, to kScaleError.
struct SplinePrior {
  static constexpr double kScaleError = 1e-3;

  std::vector<SplineLine> lines;
  std::vector<double> smoothness;  ///< per element of `lines`
  bool holds_scale = false;
  double log_column = 0.0;  ///< of the line that holds the scale, over all sheets, times their energy flux

  bool any() const { return !lines.empty(); }
};

/// `smoothness` for all lines. The start's values are those of `free`.
SplinePrior spline_prior(const sim::Scene& scene, const std::vector<FreeNumber>& free, double smoothness);

/// Appends the rows, times `weight`. Where the data's chi2 is to be divided by an inflation squared, rows
/// times the inflation make the sum of both right.
void append_rows(const SplinePrior& prior, const sim::Scene& scene, double weight, PriorRows& rows);

/// The smoothness that makes the data most probable, line by line, where the model is linear about the
/// optimum `at` under `prior`: expectation-maximisation (Dempster, Laird and Rubin 1977), in which 1 / s^2 is
/// the mean square of the bends, those of the optimum and what it leaves open. Coordinates are
/// ln(value) of coefficients and anything of the others. Information, row-major, of the data alone and of
/// priors other than this. `weight` is what append_rows() was given at the optimum, over the inflation by
/// whose square `information` is divided. `determined`, if any, receives how many coordinates the data
/// determine.
std::vector<double> most_probable_smoothness(const SplinePrior& prior, const std::vector<double>& information,
                                             const std::vector<double>& other_information,
                                             const std::vector<double>& at, double weight,
                                             double* determined);

}  // namespace vegard::fit
