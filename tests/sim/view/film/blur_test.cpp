#include "sim/view/film/blur.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "sim/render/film.h"

namespace vegard::sim::blur_test {
namespace {

double sum_of(const BlurKernel& kernel) {
  double sum = kernel.weights[0];
  for (int k = 1; k <= kernel.radius(); ++k) sum += 2.0 * kernel.weights[k];
  return sum;
}

TEST(GaussianKernel, SumsToOneAndFallsOutwards) {
  for (double sigma : {0.1, 0.7, 2.0, 4.75, 23.0}) {
    const BlurKernel kernel = gaussian_kernel(sigma);
    EXPECT_NEAR(sum_of(kernel), 1.0, 1e-6) << sigma;
    EXPECT_EQ(kernel.radius(), static_cast<int>(std::ceil(4.0 * sigma)));
    for (int k = 1; k <= kernel.radius(); ++k) EXPECT_LT(kernel.weights[k], kernel.weights[k - 1]);
  }
}

TEST(GaussianKernel, HasItsStandardDeviationAndThatOfACell) {
  // The integral over cells adds the variance of a cell, 1/12; four sigma hold 0.9989 of the variance.
  for (double sigma : {1.0, 2.0, 4.75}) {
    const BlurKernel kernel = gaussian_kernel(sigma);
    double variance = 0.0;
    for (int k = 1; k <= kernel.radius(); ++k) variance += 2.0 * k * k * kernel.weights[k];
    EXPECT_NEAR(variance, sigma * sigma + 1.0 / 12.0, 2e-3 * sigma * sigma) << sigma;
  }
}

TEST(GaussianKernel, PaperFiveTapsHoldItsShareBeforeNormalising) {
  // docs/physics.md row B25: 78.9 % per axis at sigma 2. Normalising divides by that share.
  const BlurKernel full = gaussian_kernel(2.0), cut = gaussian_kernel(2.0, 2);
  ASSERT_EQ(cut.radius(), 2);
  EXPECT_NEAR(full.weights[0] / cut.weights[0], 0.789, 5e-4);
  EXPECT_NEAR(sum_of(cut), 1.0, 1e-6);
}

TEST(GaussianKernel, OfNoWidthDoesNothing) {
  EXPECT_EQ(gaussian_kernel(0.0).weights, std::vector<float>{1.0f});
}

TEST(GaussianKernelDerivative, IsTheDerivativeByTheWidth) {
  for (int radius : {-1, 3}) {
    for (double sigma : {0.62, 2.1, 4.7}) {  // away from where the reach of 4 sigma grows by a cell
      constexpr double h = 1e-3;
      const BlurKernel derivative = gaussian_kernel_derivative(sigma, radius);
      const BlurKernel more = gaussian_kernel(sigma + h, radius), less = gaussian_kernel(sigma - h, radius);
      ASSERT_EQ(derivative.radius(), more.radius());
      ASSERT_EQ(derivative.radius(), less.radius());
      EXPECT_NEAR(sum_of(derivative), 0.0, 1e-6);
      // The kernels are floats: 6e-8 over 2h is 3e-5.
      for (int k = 0; k <= derivative.radius(); ++k)
        EXPECT_NEAR(derivative.weights[k], (more.weights[k] - less.weights[k]) / (2 * h), 5e-5) << k;
    }
  }
}

std::vector<float> noise(std::size_t count) {
  std::mt19937 random(5);
  std::vector<float> values(count);
  for (float& v : values) v = static_cast<float>(random() % 1000) * 0.01f;
  return values;
}

/// Plain double code for the same convolution.
std::vector<double> slow_blur(const std::vector<float>& in, int rows, int columns, int channels,
                              const BlurKernel& kernel, int down, int across) {
  std::vector<double> out(in.size(), 0.0);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      for (int k = -kernel.radius(); k <= kernel.radius(); ++k) {
        const int rr = r + k * down, cc = c + k * across;
        if (rr < 0 || rr >= rows || cc < 0 || cc >= columns) continue;
        for (int ch = 0; ch < channels; ++ch)
          out[(r * columns + c) * channels + ch] +=
              static_cast<double>(kernel.weights[std::abs(k)]) * in[(rr * columns + cc) * channels + ch];
      }
  return out;
}

TEST(Blur, IsTheConvolutionDownAndAcrossForAnyThreads) {
  constexpr int kRows = 37, kColumns = 23;
  for (int channels : {1, 3}) {
    const std::vector<float> in = noise(kRows * kColumns * channels);
    const BlurKernel kernel = gaussian_kernel(2.3);
    for (bool down : {true, false}) {
      const auto expected = slow_blur(in, kRows, kColumns, channels, kernel, down, !down);
      std::vector<float> one(in.size()), three(in.size());
      (down ? blur_down : blur_across)(in.data(), one.data(), kRows, kColumns, channels, kernel, 1);
      (down ? blur_down : blur_across)(in.data(), three.data(), kRows, kColumns, channels, kernel, 3);
      EXPECT_EQ(one, three);
      for (std::size_t i = 0; i < in.size(); ++i) EXPECT_NEAR(one[i], expected[i], 1e-4);
    }
  }
}

TEST(Blur, KeepsTheLightThatIsAwayFromTheEdges) {
  constexpr int kSize = 61;
  std::vector<float> in(kSize * kSize, 0.0f), down(in.size()), both(in.size());
  const std::vector<float> lit = noise(11 * 11);
  for (int r = 0; r < 11; ++r)
    for (int c = 0; c < 11; ++c) in[(r + 25) * kSize + c + 25] = lit[r * 11 + c];
  const BlurKernel kernel = gaussian_kernel(4.75);
  blur_down(in.data(), down.data(), kSize, kSize, 1, kernel, 2);
  blur_across(down.data(), both.data(), kSize, kSize, 1, kernel, 2);
  const double before = std::accumulate(in.begin(), in.end(), 0.0),
               after = std::accumulate(both.begin(), both.end(), 0.0);
  EXPECT_NEAR(after / before, 1.0, 1e-6);
  EXPECT_LT(both[30 * kSize + 30], 10.0f);
  EXPECT_GT(both[15 * kSize + 30], 0.0f);
}

TEST(BlurSigma, IsThePapersAtThePapersResolutionAndScales) {
  // Sigma 4.75 and 2.0 px at 383 rows and 35 degrees (docs/physics.md row B25): 0.43 and 0.18 degrees are
  // those, to half a unit of their last digit.
  Scene scene;
  scene.camera.width = 383;
  scene.camera.hfov_deg = 35.0;
  const double rounding = 0.005 * 383 / 35.0;
  EXPECT_NEAR(blur_sigma_px(scene, 0), 4.75, rounding);
  EXPECT_NEAR(blur_sigma_px(scene, 1), 2.0, rounding);
  EXPECT_EQ(blur_sigma_px(scene, 2), 0.0);
  const double once = blur_sigma_px(scene, 0);
  scene.camera.width *= 2;
  EXPECT_NEAR(blur_sigma_px(scene, 0), 2.0 * once, 1e-12);
  scene.camera.hfov_deg *= 2.0;
  EXPECT_NEAR(blur_sigma_px(scene, 0), once, 1e-12);
}

TEST(BlurWindow, IsAPartOfThePlanesBlurredBothWays) {
  // Windows inside, at the edges, and narrower than a kernel is wide; the same bits.
  constexpr int kRows = 40, kColumns = 53, kPlanes = 3;
  constexpr std::size_t kCells = kRows * kColumns;
  std::vector<float> in(kCells * kPlanes), down(in.size()), both(in.size());
  for (std::size_t i = 0; i < in.size(); ++i) in[i] = static_cast<float>((i * 2654435761u) >> 8 & 0xffff);
  const BlurKernel none = gaussian_kernel(0.0), wide = gaussian_kernel(3.0), narrow = gaussian_kernel(1.3);
  const std::vector<PlaneBlur> blurs = {{none, wide}, {wide, narrow}, {narrow, none}};
  for (std::size_t plane = 0; plane < kPlanes; ++plane) {
    const std::size_t at = plane * kCells;
    blur_down(in.data() + at, down.data() + at, kRows, kColumns, 1, blurs[plane].down, 1);
    blur_across(down.data() + at, both.data() + at, kRows, kColumns, 1, blurs[plane].across, 1);
  }
  for (const Window& w :
       {Window{14, 15, 12, 20}, Window{0, 0, kRows, kColumns}, Window{0, 3, 30, 2}, Window{33, 50, 7, 3}}) {
    std::vector<float> out(static_cast<std::size_t>(w.rows) * w.columns * kPlanes);
    blur_window(in.data(), kRows, kColumns, blurs, w, out.data(), 2);
    for (int y = 0; y < w.rows; ++y)
      for (int x = 0; x < w.columns; ++x)
        for (int plane = 0; plane < kPlanes; ++plane)
          ASSERT_EQ(out[(y * w.columns + x) * kPlanes + plane],
                    both[plane * kCells + (w.first_row + y) * kColumns + w.first_column + x])
              << y << " " << x << " " << plane;
  }
}

}  // namespace
}  // namespace vegard::sim::blur_test
