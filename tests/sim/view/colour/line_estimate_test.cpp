#include "sim/base/number/distributions.h"
#include "sim/view/colour/line_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "sim/base/error.h"
#include "sim/base/number/random.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/structs/sensor.h"
#include "sim/view/colour/line_colours.h"

namespace vegard::sim::line_estimate_test {
namespace {

std::vector<Vector3> per_rayleigh(const Scene& scene) {
  std::vector<Vector3> colours = line_colours(scene);
  for (Vector3& rgb : colours)
    for (double& channel : rgb) channel *= 1e-3;
  return colours;
}

Vector3 light(const std::vector<Vector3>& colours, const std::vector<double>& rayleigh) {
  Vector3 rgb{};
  for (std::size_t l = 0; l < colours.size(); ++l)
    for (int c = 0; c < 3; ++c) rgb[c] += rayleigh[l] * colours[l][c];
  return rgb;
}

TEST(LineEstimate, InvertsLightWithoutNoise) {
  for (std::string response : {std::string("cie"), built_in_cameras()[0], built_in_cameras()[3]}) {
    Scene scene;
    scene.sensor.response = response;
    const std::vector<double> truth = {812.0, 5310.0, 640.0};
    const auto colours = per_rayleigh(scene);
    const LineEstimate estimate =
        LineEstimator(colours).estimate(light(colours, truth), Vector3{1e-3, 2e-3, 3e-3});
    for (int l = 0; l < 3; ++l) EXPECT_NEAR(estimate.rayleigh[l], truth[l], 1e-8 * truth[1]) << response;
  }
}

TEST(LineEstimate, FewerLinesAreALeastSquaresFit) {
  Scene scene;
  scene.sensor.response = "nikon_d700";
  scene.emission.lines = {630.0, 557.7};
  const auto colours = per_rayleigh(scene);
  const LineEstimator estimator(colours);
  const Vector3 sigma = {1e-3, 2e-3, 5e-4};
  Vector3 rgb = light(colours, {800.0, 5000.0});
  const LineEstimate exact = estimator.estimate(rgb, sigma);
  EXPECT_NEAR(exact.rayleigh[0], 800.0, 1e-6);
  EXPECT_NEAR(exact.rayleigh[1], 5000.0, 1e-6);
  // Off the plane of the two colours: the residual is orthogonal to both in the weighted sense.
  for (int c = 0; c < 3; ++c) rgb[c] += 0.01 * (c - 1);
  const LineEstimate estimate = estimator.estimate(rgb, sigma);
  const Vector3 fitted = light(colours, estimate.rayleigh);
  for (const Vector3& colour : colours) {
    double inner = 0.0, size = 0.0;
    for (int c = 0; c < 3; ++c) {
      inner += colour[c] * (rgb[c] - fitted[c]) / (sigma[c] * sigma[c]);
      size += std::abs(colour[c]) * std::abs(rgb[c] - fitted[c]) / (sigma[c] * sigma[c]);
    }
    EXPECT_NEAR(inner / size, 0.0, 1e-9);
  }
}

TEST(LineEstimate, CovarianceIsWhatNoiseMakes) {
  // 40 000 draws give a variance to 0.7 % (sqrt(2 / n)); 3 % is four of those. Seed 71.
  constexpr int kDraws = 40000;
  Scene scene;
  scene.sensor.response = "canon_5d_mark_ii";
  const auto colours = per_rayleigh(scene);
  const LineEstimator estimator(colours);
  const Vector3 truth = light(colours, {800.0, 5000.0, 600.0}), sigma = {1e-3, 2e-3, 1.5e-3};
  const LineEstimate predicted = estimator.estimate(truth, sigma);
  double square[3][3] = {};
  for (int i = 0; i < kDraws; ++i) {
    const Words words = random_words(71, Stream::search, i);
    Vector3 noisy = truth;
    for (int c = 0; c < 3; ++c) noisy[c] += sigma[c] * normal_quantile(uniform(words[c]));
    const LineEstimate estimate = estimator.estimate(noisy, sigma);
    for (int l = 0; l < 3; ++l)
      for (int m = 0; m < 3; ++m)
        square[l][m] += (estimate.rayleigh[l] - predicted.rayleigh[l]) *
                        (estimate.rayleigh[m] - predicted.rayleigh[m]) / kDraws;
  }
  for (int l = 0; l < 3; ++l)
    for (int m = 0; m < 3; ++m) {
      const double unit = std::sqrt(predicted.covariance[l][l] * predicted.covariance[m][m]);
      EXPECT_NEAR(square[l][m] / unit, predicted.covariance[l][m] / unit, 0.03) << l << m;
    }
}

TEST(LineEstimate, RefusesWhatColourCannotTell) {
  const auto refused = [](const std::vector<double>& lines) {
    Scene scene;
    scene.sensor.response = "nikon_d700";
    scene.emission.lines = lines;
    EXPECT_THROW(LineEstimator{per_rayleigh(scene)}, Error) << lines.size();
  };
  refused({630.0, 557.7, 427.8, 520.0});
  refused({630.0, 557.7, 844.6});  // not seen
  refused({557.7, 557.7});
}

}  // namespace
}  // namespace vegard::sim::line_estimate_test
