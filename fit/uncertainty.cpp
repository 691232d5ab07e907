#include "fit/uncertainty.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vegard::fit {
namespace {

constexpr double kRankTolerance = 1e-7;
constexpr double kLeans = 1e-2;  // share of an undetermined direction that spoils a coordinate

/// Mean product of pairs of residuals over the mean square.
class Correlation {
 public:
  void add(double a, double b) {
    product_ += a * b;
    square_ += 0.5 * (a * a + b * b);
  }
  double value() const { return square_ > 0.0 ? product_ / square_ : 0.0; }

 private:
  double product_ = 0.0, square_ = 0.0;
};

}  // namespace

double error_inflation(const Profile& data, const std::vector<std::size_t>& used,
                       const std::vector<double>& residual, int dof) {
  std::vector<double> at(data.mean.size(), std::numeric_limits<double>::quiet_NaN());
  double chi2 = 0.0;
  for (std::size_t k = 0; k < used.size(); ++k) {
    at[used[k]] = residual[k];
    chi2 += residual[k] * residual[k];
  }
  const auto correlation = [&](int d_band, int d_row, int d_channel) {
    Correlation c;
    for (int b = 0; b + d_band < data.bands; ++b)
      for (int r = 0; r + d_row < data.rows; ++r)
        for (int ch = 0; ch + d_channel < 3; ++ch) {
          const double one = at[data.index(b, r, ch)];
          const double two = at[data.index(b + d_band, r + d_row, ch + d_channel)];
          if (!std::isnan(one) && !std::isnan(two)) c.add(one, two);
        }
    return c.value();
  };
  double together = 1.0;
  for (int lag = 1; lag < data.rows / 2; ++lag) {
    const double c = correlation(0, lag, 0);
    if (c <= 0.0) break;
    together += 2.0 * c;
  }
  together *= 1.0 + 2.0 * std::max(0.0, correlation(0, 0, 1));
  together *= 1.0 + 2.0 * std::max(0.0, correlation(1, 0, 0));
  return std::sqrt(std::max(1.0, chi2 / std::max(1, dof)) * together);
}

Uncertainty uncertainty(const std::vector<double>& jacobian, int residuals, int coordinates,
                        double inflation) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::MatrixXd j = Eigen::Map<const RowMajor>(jacobian.data(), residuals, coordinates);
  Eigen::VectorXd length = j.colwise().norm();
  for (int i = 0; i < coordinates; ++i)
    if (length(i) > 0.0) j.col(i) /= length(i);
  // The singular values of J are those of its triangular factor, which is small.
  const Eigen::MatrixXd triangle =
      Eigen::HouseholderQR<Eigen::MatrixXd>(j).matrixQR().topRows(coordinates).triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(triangle, Eigen::ComputeFullV);
  const Eigen::VectorXd& s = svd.singularValues();
  const Eigen::MatrixXd& v = svd.matrixV();
  const double largest = coordinates > 0 ? s(0) : 0.0;

  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(coordinates, coordinates);
  std::vector<bool> undetermined(coordinates, false);
  for (int k = 0; k < coordinates; ++k) {
    if (s(k) > kRankTolerance * largest && s(k) > 0.0) {
      covariance += v.col(k) * v.col(k).transpose() / (s(k) * s(k));
    } else {
      for (int i = 0; i < coordinates; ++i)
        if (v(i, k) * v(i, k) > kLeans * kLeans) undetermined[i] = true;
    }
  }
  Uncertainty result;
  result.inflation = inflation;
  result.sigma.resize(coordinates);
  result.correlation.assign(coordinates, std::vector<double>(coordinates, 0.0));
  for (int i = 0; i < coordinates; ++i) {
    const bool known = !undetermined[i] && length(i) > 0.0 && std::isfinite(covariance(i, i));
    result.sigma[i] = known ? inflation * std::sqrt(covariance(i, i)) / length(i)
                            : std::numeric_limits<double>::quiet_NaN();
    for (int k = 0; k < coordinates; ++k) {
      const double scale = std::sqrt(covariance(i, i) * covariance(k, k));
      if (known && !undetermined[k] && scale > 0.0) result.correlation[i][k] = covariance(i, k) / scale;
    }
  }
  return result;
}

}  // namespace vegard::fit
