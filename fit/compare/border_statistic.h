// The border statistic: the row of the aurora's lower border in each band.
#pragma once

#include <vector>

#include "fit/compare/statistic.h"
#include "fit/measure/profile.h"

namespace vegard::fit {

/// A band's border is the row at which green decreases downwards: the mean position weighted with the square
/// of the decrease f,
///
///   y = sum r w(f_r) / sum w(f_r),    f_r = sum_k K_k G_(r + k),    K_k ~ -k exp(-k^2 / 2 m^2), m = 2,
///
/// where w(f) = f^2 if light decreases downwards, else 0. y is a smooth function of the light, and does not
/// depend on the gains or on a level sky. The rows that are used reach from the brightest one down to where a
/// tenth of its light is left, and three times that distance further on both sides. Noise causes decreases
/// where there are none: the model's w is the expectation of the square under the photograph's own noise, so
/// that photograph and model agree where the model is right.
///
/// Noise of y: to first order that of the profile (photograph and model error, rows taken as independent), to
/// second order the photograph's own. Bands whose steepest decrease is less than five of its standard
/// deviations have no border.
class BorderStatistic : public Statistic {
 public:
  /// `sigma`: of the profile's values (fit/measure/noise_model.h). `weight` multiplies chi2.
  BorderStatistic(const Profile& data, const std::vector<double>& sigma, double weight);

  std::size_t residuals() const override { return bands_.size(); }
  void evaluate(const StatisticInput& input, double* residual, double* jacobian) const override;

  /// Position of each border that is compared, in the profile's rows, and its standard deviation, in the
  /// order of the residuals. `light` is indexed as in Profile, without the sky.
  struct Border {
    int band = 0;
    double row = 0.0, sigma = 0.0;
  };
  std::vector<Border> borders(const std::vector<double>& light) const;

 private:
  struct Band {
    int band = 0;
    std::vector<int> rows;              ///< rows that are used
    std::vector<double> noise_of_fall;  ///< the photograph's own
    double sigma = 0.0;
  };
  struct BorderRow {
    double row = 0.0;
    std::vector<double> slope;  ///< d row / d light of the band's rows
  };
  /// `expected`: whether `green` is light without noise, for which the expectation under noise is computed.
  BorderRow border_row(const Band& band, const std::vector<double>& green, bool expected) const;
  std::vector<double> green_of(int band, const std::vector<double>& light) const;

  Profile data_;
  double weight_;
  std::vector<Band> bands_;
};

}  // namespace vegard::fit
