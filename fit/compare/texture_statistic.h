// The texture statistic: the variation of light along an arc, wherever each ray is.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "fit/compare/statistic.h"
#include "fit/model/sheet_in_view.h"
#include "fit/photo/photo.h"
#include "fit/photo/region.h"
#include "sim/base/number/ray_covariance.h"

namespace vegard::fit {

/// Compares autocovariances of the logarithm of the light along the brightest rows of each band.
///
/// Data: green above the sky, averaged column by column over the rows in which the band has at least 0.7 of
/// its peak. A parabola along the band is subtracted from its logarithm, which gives f; the autocovariances
/// are (1/n) sum f(x) f(x + lag) at lags of 0 to a third of the band. Model: the expectation of the same
/// quantity for rays of a contrast and a width (ray_log_covariance) where the sheet is in view
/// (sheet_in_view), parabola and photon noise included.
///
/// The rays' contrast and width are solved at every evaluation, as gains are; both are common to the whole
/// picture. So the statistic depends on distance and bearing only through the change of scale across the
/// picture; its purpose is to measure the rays themselves (solved()). The scene's own ray_contrast and
/// ray_width_km are ignored.
///
/// Noise: f is taken as Gaussian. Autocovariances are quadratic forms in f, whose covariance is 2 tr(B_k S
/// B_l S), where S is the photograph's own autocovariance, pooled over bands. Residuals are the combinations
/// of lags that are independent and of variance 1 under this covariance.
///
/// Only one sheet is used: the first with ray_contrast above 0, else the first. Arcs other than its first
/// one, and the change of scale along the sine, are neglected.
class TextureStatistic : public Statistic {
 public:
  /// `scene` gives the sheet and [fit]. `weight` multiplies chi2.
  TextureStatistic(const sim::Scene& scene, const Photo& photo, const Region& region, double weight);

  /// Number of residuals: 0 if the light along the bands is as even as its noise and the model error allow.
  std::size_t residuals() const override { return residuals_; }
  void evaluate(const StatisticInput& input, double* residual, double* jacobian) const override;
  std::vector<Solved> solved(const sim::Scene& scene) const override;

  /// Light along a stretch of columns (in the .cpp).
  struct Row;

 private:
  struct Stretch {
    double x_px = 0.0, y_px = 0.0;       ///< its middle
    std::vector<double> seen;            ///< autocovariance at each lag
    std::vector<double> noise_response;  ///< contribution of noise to it
    std::vector<double>
        distance_response;          ///< its response to a covariance of 1 at a distance, [lag][pixels]
    std::vector<double> whitening;  ///< [residual][lag]
    std::size_t pixels = 0, lags = 0, residuals = 0;
  };
  using Views = std::vector<std::optional<SheetInView>>;  // of each stretch
  struct Solution {
    double ln_contrast = 0.0, ln_width = 0.0;
    std::vector<double> residual;
    double chi2 = 0.0;
    double variance[2] = {0.0, 0.0};  // of the two logarithms
  };

  static Stretch stretch_of(const Row& row, const std::vector<int>& lags,
                            const std::vector<double>& by_distance, double model_error, double weight);
  Views views(const sim::Scene& scene) const;
  std::vector<double> residual_of(const Views& views, double ln_contrast, double ln_width) const;
  std::array<std::vector<double>, 2> slopes(const Views& views, const std::array<double, 2>& at) const;
  Eigen::Vector2d gradient(const Views& views, const std::array<double, 2>& at) const;
  Solution solve(const Views& views) const;

  int sheet_ = 0;
  double weight_ = 1.0;
  std::vector<Stretch> stretches_;
  std::size_t residuals_ = 0;
};

}  // namespace vegard::fit
