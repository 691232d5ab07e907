// The border statistic: the row of the aurora's lower border in each band.
#pragma once

#include <vector>

#include "fit/compare/statistic.h"
#include "fit/measure/profile.h"

namespace vegard::fit {

/// A band's border is where green falls off downwards: the mean position weighed with the square of the fall,
///
///   y = sum r w(f_r) / sum w(f_r),    f_r = sum_k K_k G_(r + k),    K_k ~ -k exp(-k^2 / 2 m^2), m = 2,
///
/// w(f) = f^2 where light falls downwards, 0 elsewhere. It is smooth in all light, and knows neither of gains
/// nor of a level sky. Rows about the brightest and down to where a tenth of its light is left, three times
/// as far to either side, take part. Noise makes falls where there are none: the model's w is the expectation
/// of the square under the photograph's own noise, so that both are alike where the model is right.
///
/// Noise of y: to first order that of the profile (photograph and model error, rows taken as independent), to
/// second order the photograph's own. Bands whose steepest fall is less than five of its standard deviations
/// have no border.
class BorderStatistic : public Statistic {
 public:
  /// `sigma`: of the profile's values (fit/measure/noise_model.h). `weight` multiplies chi2.
  BorderStatistic(const Profile& data, const std::vector<double>& sigma, double weight);

  std::string name() const override { return "border"; }
  std::size_t residuals() const override { return bands_.size(); }
  void evaluate(const StatisticInput& input, double* residual, double* jacobian) const override;

  /// Position of each border that is compared, in the profile's rows, and its standard deviation, in the
  /// order of the residuals; light as in Profile, sky taken off.
  struct Border {
    int band = 0;
    double row = 0.0, sigma = 0.0;
  };
  std::vector<Border> borders(const std::vector<double>& light) const;

 private:
  struct Band {
    int band = 0;
    std::vector<int> rows;              ///< whose fall takes part
    std::vector<double> noise_of_fall;  ///< the photograph's own
    double sigma = 0.0;
  };
  struct BorderRow {
    double row = 0.0;
    std::vector<double> slope;  ///< d row / d light of the band's rows
  };
  /// `expected`: of light without noise, what noise would make of it.
  BorderRow border_row(const Band& band, const std::vector<double>& green, bool expected) const;
  std::vector<double> green_of(int band, const std::vector<double>& light) const;

  Profile data_;
  double weight_;
  std::vector<Band> bands_;
};

}  // namespace vegard::fit
