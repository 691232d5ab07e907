// Priors as rows of residuals: each row is about one free number or a sum of several.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/parameters/free_parameters.h"

namespace vegard::fit {

class PriorRows {
 public:
  /// Makes a row of (value - mean) / sigma for every number that has a normal prior of its own, of (ln value
  /// - ln mean) / sigma for a log-normal prior, and for the ratio prior of a sheet (RatioPrior) of the
  /// distance of ln(wavelength / twice the amplitude) from its range, over the spread. A uniform prior gives
  /// no row, since the transform keeps the limits. All rows are multiplied by `weight`.
  explicit PriorRows(const std::vector<FreeNumber>& free, double weight = 1.0);

  /// A row: the sum of factor * ln(value) over numbers above 0.
  struct LogTerm {
    int number = 0;
    double factor = 0.0;
  };
  void add_of_logarithms(const std::vector<LogTerm>& terms);

  /// A row: factor * (ln(constant + sum of weights * values) - target).
  struct Weight {
    int number = 0;
    double weight = 0.0;
  };
  void add_of_sum(double factor, double target, double constant, const std::vector<Weight>& weights);

  std::size_t count() const { return rows_.size(); }

  /// Computes the residuals and, if `jacobian` is not null, d residual / d value, row-major [row][number].
  void evaluate(const std::vector<double>& values, std::vector<double>& residuals,
                std::vector<double>* jacobian) const;

 private:
  void add_ratio(const std::vector<FreeNumber>& free, std::size_t j, double weight);

  struct Row {
    enum class Kind { of_number, of_logarithms, of_sum, of_range } kind = Kind::of_number;
    double factor = 0.0, target = 0.0, constant = 0.0;
    double least = 0.0, most = 0.0;  // limits of the sum of logarithms and the constant (of_range)
    std::vector<LogTerm> terms;
  };
  std::vector<Row> rows_;
};

}  // namespace vegard::fit
