// Colour profiles: how much red and blue there is beside green.
#pragma once

#include <array>
#include <vector>

#include "fit/compare/statistic.h"
#include "fit/measure/profile.h"

namespace vegard::fit {

/// ln(red / green) and ln(blue / green) of the light above the sky, bin by bin. What scales all channels of a
/// bin alike (exposure, the sheet's brightness, rays) does nothing to it. Data: photograph less the solved
/// sky; model: its aurora.
///
/// Noise: the relative errors of both channels in quadrature. Bins whose light above the sky (the mean of
/// what lies at the profile's 5th percentile) is less than five of its standard deviations in either channel
/// are left out. A logarithm
/// of so noisy a number is low by half its relative variance on average: that of the photograph's own noise
/// is added back. Below a fifth of the light that the photograph had above that, the logarithm
/// goes on as its tangent, so that a sky that takes all the light away, or a model without any, has a
/// residual too.
class ColourStatistic : public Statistic {
 public:
  /// `sigma`: of the profile's values (fit/measure/noise_model.h). `weight` multiplies chi2.
  ColourStatistic(const Profile& data, const std::vector<double>& sigma, double weight);

  std::string name() const override { return "colour"; }
  std::size_t residuals() const override { return ratios_.size(); }
  void evaluate(const StatisticInput& input, double* residual, double* jacobian) const override;

 private:
  struct Channel {
    std::size_t value = 0;  ///< index into the profile
    double mean = 0.0;      ///< of the photograph, sky included
    double darkest = 0.0;   ///< below which the logarithm is a straight line
  };
  struct Ratio {
    Channel over, under;
    double bias = 0.0, sigma = 0.0;
  };
  std::vector<Ratio> ratios_;
};

}  // namespace vegard::fit
