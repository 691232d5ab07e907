#include "fit/compare/inflation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vegard::fit {
namespace {

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

double correlated_residuals(const Profile& data, const std::vector<std::size_t>& used,
                            const std::vector<double>& residual) {
  std::vector<double> at(data.mean.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 0; k < used.size(); ++k) at[used[k]] = residual[k];
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
  // The largest partial sum: residuals that swing about zero at once and yet drift slowly are not
  // independent.
  const auto largest_sum = [](int lags, const auto& at_lag) {
    double sum = 1.0, largest = 1.0;
    for (int lag = 1; lag < lags; ++lag) {
      sum += 2.0 * at_lag(lag);
      largest = std::max(largest, sum);
    }
    return largest;
  };
  return largest_sum(data.rows / 4, [&](int lag) { return correlation(0, lag, 0); }) *
         largest_sum(std::max(2, data.bands / 4), [&](int lag) { return correlation(lag, 0, 0); }) *
         (1.0 + 2.0 * std::max(0.0, correlation(0, 0, 1)));
}

double residual_scale(double chi2, int dof, double residuals, double correlated) {
  constexpr double kMinScale = 0.01;
  const double data_scale =
      chi2 / std::max(1, dof) * (1.0 + std::sqrt(2.0 * correlated / std::max(1.0, residuals)));
  return std::max(kMinScale, data_scale);
}

double Inflation::factor() const { return std::sqrt(scale * correlated); }

Inflation error_inflation(const Profile& data, const std::vector<std::size_t>& used,
                          const std::vector<double>& residual, int dof) {
  double chi2 = 0.0;
  for (const double r : residual) chi2 += r * r;
  const double correlated = correlated_residuals(data, used, residual);
  return {residual_scale(chi2, dof, static_cast<double>(used.size()), correlated), correlated};
}

}  // namespace vegard::fit
