#include "fit/measure/line_brightness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/number/constants.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/colour/line_estimate.h"
#include "sim/view/sky/night_sky.h"

namespace vegard::fit {
namespace {

// Of a picture without any noise, so that weights stay finite.
constexpr double kMinSigma = 1e-12;

/// Of the known lights of the scene's night sky, as Profile::mean; empty if there are none.
std::vector<double> night_sky_means(const sim::Scene& scene, const Profile& profile) {
  if (!sim::has_night_sky(scene)) return {};
  const sim::Image light = sim::night_sky_light(scene);
  std::vector<double> means(profile.mean.size(), 0.0);
  for (int band = 0; band < profile.bands; ++band) {
    const int begin = band_begin(profile.region, profile.bands, band);
    const int end = band_begin(profile.region, profile.bands, band + 1);
    for (int row = 0; row < profile.rows; ++row)
      for (int c = 0; c < 3; ++c) {
        double& mean = means[profile.index(band, row, c)];
        for (int x = begin; x < end; ++x) mean += light.at(x, profile.region.y + row, c) / (end - begin);
      }
  }
  return means;
}

}  // namespace

LineBrightness line_brightness(const sim::Scene& scene, const Profile& profile) {
  std::vector<sim::Vector3> colours = sim::line_colours(scene);
  for (sim::Vector3& rgb : colours)
    for (double& channel : rgb) channel *= 1e-3;
  const sim::LineEstimator estimator(std::move(colours));

  const std::vector<double> night_sky = night_sky_means(scene, profile);

  LineBrightness result;
  for (const double nm : scene.emission.lines) result.names.push_back(std::to_string(std::lround(10.0 * nm)));
  for (int band = 0; band < profile.bands; ++band) {
    for (int row = 0; row < profile.rows; ++row) {
      const std::array<double, 3> basis =
          sim::sky_basis((profile.region.y + row + 0.5) / scene.camera.height);
      const std::size_t i = profile.index(band, row, 0);
      sim::Vector3 rgb, sigma;
      bool known = true;
      for (int c = 0; c < 3; ++c) {
        rgb[c] = profile.mean[i + c] - scene.sky.level[c] * basis[0] - scene.sky.gradient[c] * basis[1] -
                 scene.sky.curvature[c] * basis[2];
        if (!night_sky.empty()) rgb[c] -= night_sky[i + c];
        sigma[c] = profile.standard_error[i + c];
        known = known && std::isfinite(rgb[c]) && std::isfinite(sigma[c]);
        sigma[c] = std::max(sigma[c], kMinSigma);
      }
      const sim::LineEstimate estimate = known ? estimator.estimate(rgb, sigma) : sim::LineEstimate{};
      for (int l = 0; l < estimator.lines(); ++l) {
        result.rayleigh.push_back(known ? estimate.rayleigh[l] : sim::kNaN);
        result.sigma.push_back(known ? std::sqrt(estimate.covariance[l][l]) : sim::kNaN);
        for (int k = 0; k < estimator.lines(); ++k)
          result.covariance.push_back(known ? estimate.covariance[l][k] : sim::kNaN);
      }
    }
  }
  return result;
}

}  // namespace vegard::fit
