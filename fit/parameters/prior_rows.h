// Priors as rows of residuals: each row is about one free number or a sum of several.
#pragma once

#include <cstddef>
#include <vector>

#include "fit/parameters/free_parameters.h"

namespace vegard::fit {

class PriorRows {
 public:
  /// (value - mean) / sigma of every number that has a normal prior of its own, (ln value - ln mean) / sigma
  /// of every one with a log-normal prior; a uniform prior is no row, since the transform keeps the limits;
  /// how far ln(wavelength / twice the amplitude) of a sheet lies outside of its range, over its spread
  /// (RatioPrior). All times `weight`.
  explicit PriorRows(const std::vector<FreeNumber>& free, double weight = 1.0);

  /// A row sum of factor * ln(value), of numbers above 0.
  struct LogTerm {
    int number = 0;
    double factor = 0.0;
  };
  void add_of_logarithms(const std::vector<LogTerm>& terms);

  /// A row factor * (ln(constant + sum of weights * values) - target).
  struct Weight {
    int number = 0;
    double weight = 0.0;
  };
  void add_of_sum(double factor, double target, double constant, const std::vector<Weight>& weights);

  std::size_t count() const { return rows_.size(); }

  /// Residuals, and d residual / d value, row-major [row][number], where wanted.
  void evaluate(const std::vector<double>& values, std::vector<double>& residuals,
                std::vector<double>* jacobian) const;

 private:
  void add_ratio(const std::vector<FreeNumber>& free, std::size_t j, double weight);

  struct Row {
    enum class Kind { of_number, of_logarithms, of_sum, of_range } kind = Kind::of_number;
    double factor = 0.0, target = 0.0, constant = 0.0;
    double least = 0.0, most = 0.0;  // of a range of the sum of logarithms and the constant
    std::vector<LogTerm> terms;
  };
  std::vector<Row> rows_;
};

}  // namespace vegard::fit
