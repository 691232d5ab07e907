// chi2 of line brightnesses about a point, with the light linear in the unknowns and in what the modes of the
// tables' uncertainty change of the lines: what the descents of ColumnChi2 go by.
//
// The number of lines is a constant of the templates, for loops that the compiler unrolls: a map makes dozens
// of these a pixel.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "fit/columns/column_model.h"

namespace vegard::fit {

using ColumnVector = Eigen::Matrix<double, kColumnUnknowns, 1>;
using LineVector = std::array<double, kMaxColumnLines>;
using LineSlopes = std::array<LineVector, kColumnUnknowns>;

/// Cholesky's factor of the covariance of the lines. Eigen's takes four times as long for three of them.
template <std::size_t kLines>
class LineCholesky {
 public:
  void factor(const LineMatrix& matrix) {
    for (std::size_t row = 0; row < kLines; ++row)
      for (std::size_t column = 0; column <= row; ++column) {
        double sum = matrix[row * kMaxColumnLines + column];
        for (std::size_t k = 0; k < column; ++k) sum -= at(row, k) * at(column, k);
        if (row == column)
          inverse_[row] = 1.0 / std::sqrt(sum);
        else
          at(row, column) = sum * inverse_[column];
      }
  }

  LineVector solve(LineVector x) const {
    for (std::size_t row = 0; row < kLines; ++row) {
      for (std::size_t k = 0; k < row; ++k) x[row] -= at(row, k) * x[k];
      x[row] *= inverse_[row];
    }
    for (std::size_t row = kLines; row-- > 0;) {
      for (std::size_t k = row + 1; k < kLines; ++k) x[row] -= at(k, row) * x[k];
      x[row] *= inverse_[row];
    }
    return x;
  }

 private:
  double& at(std::size_t row, std::size_t column) { return factor_[row * kMaxColumnLines + column]; }
  double at(std::size_t row, std::size_t column) const { return factor_[row * kMaxColumnLines + column]; }

  LineMatrix factor_;
  LineVector inverse_;  ///< of the factor's diagonal
};

struct ColumnGradient {
  ColumnVector slope = ColumnVector::Zero();  ///< half of chi2's
  ColumnMatrix information = ColumnMatrix::Zero();
};

/// chi2 about a point with given changes of the lines by the modes, and the light linear in both there.
///
/// The modes are taken together: u = M a is what they change of the lines' logarithms, K = M M^T its
/// covariance before the data. At the least chi2 u is K q with q = R (y - R)/sigma^2, R being the changed
/// light; so q stands for the coefficients, and their |a|^2 is q^T K q.
template <std::size_t kLines>
class ColumnLinearisation {
 public:
  ColumnLinearisation(const ColumnModel& model, const ColumnData& data, const ColumnPoint& point,
                      const LineVector& weight)
      : data_(data), weight_(weight) {
    model.at(point, lights_);
    model.ln_covariance(point, lights_, covariance_);
    change_ = times(covariance_.value, weight_);
    for (std::size_t l = 0; l < kLines; ++l) {
      rayleigh_[l] = std::exp(lights_[l].ln_rayleigh + change_[l]);
      const double residual = (rayleigh_[l] - data.rayleigh[l]) / data.sigma[l];
      chi2_ += residual * residual + weight_[l] * change_[l];
    }
  }

  double chi2() const { return chi2_; }
  const LineVector& weight() const { return weight_; }

  /// Of the least chi2 over the changes, with the light linear in them.
  ColumnGradient gradient() {
    LineMatrix matrix;
    LineVector towards{};
    for (std::size_t l = 0; l < kLines; ++l) {
      for (std::size_t m = 0; m <= l; ++m)
        matrix[l * kMaxColumnLines + m] =
            rayleigh_[l] * rayleigh_[m] * covariance_.value[l * kMaxColumnLines + m];
      matrix[l * kMaxColumnLines + l] += data_.sigma[l] * data_.sigma[l];
      towards[l] = data_.rayleigh[l] - rayleigh_[l] * (1.0 - change_[l]);
    }
    of_data_.factor(matrix);
    wanted_ = of_data_.solve(towards);
    ColumnGradient g;
    for (std::size_t k = 0; k < kColumnUnknowns; ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      slopes_[k] = slope_of_rayleigh(k);
      wanted_by_[k] = of_data_.solve(slopes_[k]);
      g.slope(column) = -product(slopes_[k], wanted_);
      for (std::size_t j = 0; j <= k; ++j)
        g.information(column, static_cast<Eigen::Index>(j)) =
            g.information(static_cast<Eigen::Index>(j), column) = product(wanted_by_[k], slopes_[j]);
    }
    return g;
  }

  /// After gradient(): q once it has gone the part `share` of the way to the least chi2 here, and followed
  /// the unknowns' step.
  LineVector weight_after(const ColumnVector& step, double share) const {
    LineVector rest{};
    for (std::size_t l = 0; l < kLines; ++l) rest[l] = wanted_[l] * rayleigh_[l] - weight_[l];
    const LineVector change = times(covariance_.value, rest);
    for (std::size_t l = 0; l < kLines; ++l)
      share = std::min(share, kLongestChange / std::max(kLongestChange, std::abs(change[l])));
    LineVector after = weight_;
    for (std::size_t l = 0; l < kLines; ++l) {
      double followed = 0.0;
      for (std::size_t k = 0; k < kColumnUnknowns; ++k)
        followed -= wanted_by_[k][l] * step(static_cast<Eigen::Index>(k));
      after[l] += share * rest[l] + followed * rayleigh_[l];
    }
    return after;
  }

  /// After gradient(), at the least chi2: what the data leave of K, the unknowns being free of any prior.
  std::vector<LineCorrection> corrections(const ColumnFreedom& is_free) const {
    const auto lines = static_cast<Eigen::Index>(kLines);
    Eigen::MatrixXd inverse(lines, lines), response(lines, lines);
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(lines, kColumnUnknowns);
    for (std::size_t l = 0; l < kLines; ++l) {
      const auto row = static_cast<Eigen::Index>(l);
      LineVector unit{};
      unit[l] = 1.0;
      inverse.col(row) = Eigen::Map<const Eigen::VectorXd>(of_data_.solve(unit).data(), lines);
      for (std::size_t k = 0; k < kColumnUnknowns; ++k)
        if (is_free[k]) slopes(row, static_cast<Eigen::Index>(k)) = slopes_[k][l];
      for (std::size_t m = 0; m < kLines; ++m)
        response(row, static_cast<Eigen::Index>(m)) =
            rayleigh_[l] * covariance_.value[l * kMaxColumnLines + m];
    }
    Eigen::MatrixXd of_unknowns = slopes.transpose() * inverse * slopes;
    for (std::size_t k = 0; k < kColumnUnknowns; ++k)
      if (!is_free[k]) of_unknowns(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)) = 1.0;
    const Eigen::MatrixXd projected =
        inverse - inverse * slopes * of_unknowns.ldlt().solve(slopes.transpose()) * inverse;
    const Eigen::MatrixXd learnt = response.transpose() * projected * response;
    std::vector<LineCorrection> result;
    for (std::size_t l = 0; l < kLines; ++l) {
      const double before = covariance_.value[l * kMaxColumnLines + l];
      const auto row = static_cast<Eigen::Index>(l);
      result.push_back(
          {std::exp(change_[l]), std::sqrt(before), std::sqrt(std::max(0.0, before - learnt(row, row)))});
    }
    return result;
  }

 private:
  static constexpr double kLongestChange = 1.0;  // of a logarithm, at a time

  static double product(const LineVector& one, const LineVector& other) {
    double sum = 0.0;
    for (std::size_t l = 0; l < kLines; ++l) sum += one[l] * other[l];
    return sum;
  }

  static LineVector times(const LineMatrix& matrix, const LineVector& vector) {
    LineVector result{};
    for (std::size_t l = 0; l < kLines; ++l)
      for (std::size_t m = 0; m < kLines; ++m) result[l] += matrix[l * kMaxColumnLines + m] * vector[m];
    return result;
  }

  /// With q at its best chi2 depends on an unknown by K too, as if u changed by half of K' q.
  LineVector slope_of_rayleigh(std::size_t unknown) const {
    LineVector slope{};
    if (covariance_.depends_on[unknown]) slope = times(covariance_.slope[unknown], weight_);
    for (std::size_t l = 0; l < kLines; ++l)
      slope[l] = rayleigh_[l] * (lights_[l].slope[unknown] + 0.5 * slope[l]);
    return slope;
  }

  ColumnData data_;
  ColumnLights lights_;
  LineCovariance covariance_;                // K
  LineVector weight_, change_, rayleigh_{};  // q, u, R
  double chi2_ = 0.0;
  LineCholesky<kLines> of_data_;
  LineVector wanted_;  // the inverse of the data's covariance times (y - R + R u)
  LineSlopes slopes_, wanted_by_;
};

}  // namespace vegard::fit
