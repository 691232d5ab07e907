// The colour statistic: the ratios of red and blue to green.
#pragma once

#include <array>
#include <vector>

#include "fit/compare/statistic.h"
#include "fit/measure/profile.h"

namespace vegard::fit {

/// Compares ln(red / green) and ln(blue / green) of the light above the sky in each bin. A factor that is
/// common to all channels of a bin (exposure, the sheet's brightness, rays) cancels. Data: photograph less
/// the solved sky; model: its aurora.
///
/// Noise: the relative errors of both channels in quadrature. The sky is estimated as the mean of the values
/// that are at most three standard errors above the profile's 5th percentile; bins whose light above it is
/// less than five standard deviations in either channel are left out. The logarithm of such a noisy number is
/// too low by half its relative variance on average; this bias by the photograph's own noise is added back.
/// Below a fifth of that light the logarithm is continued by its tangent, so that residuals exist also if the
/// sky takes all the light away or the model has none.
class ColourStatistic : public Statistic {
 public:
  /// `sigma`: of the profile's values (fit/measure/noise_model.h). `weight` multiplies chi2.
  ColourStatistic(const Profile& data, const std::vector<double>& sigma, double weight);

  std::size_t residuals() const override { return ratios_.size(); }
  void evaluate(const StatisticInput& input, double* residual, double* jacobian) const override;

 private:
  struct Channel {
    std::size_t value = 0;  ///< index into the profile
    double mean = 0.0;      ///< of the photograph, sky included
    double darkest = 0.0;   ///< the logarithm is replaced by its tangent below this
  };
  struct Ratio {
    Channel over, under;
    double bias = 0.0, sigma = 0.0;
  };
  std::vector<Ratio> ratios_;
};

}  // namespace vegard::fit
