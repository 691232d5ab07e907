// Tolerances of the statistics: a process of width w over a length S has about S/w independent pieces; means
// are asked for within four standard errors. Seed 7.
#include "sim/base/number/gaussian_process.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace vegard::sim::gaussian_process_test {
namespace {

constexpr double kWidth = 2.0;

GaussianProcess process(double instant = 0.0, double lifetime = 0.0, std::uint32_t address = 3) {
  return {7, Stream::ray_light, address, kWidth, instant, lifetime};
}

/// The mean of a function of the place over 20000 widths: its standard error is about 1/sqrt(20000) of its
/// own standard deviation, 0.007.
double mean(const std::function<double(double)>& f) {
  constexpr int n = 60000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) sum += f((i - 0.5 * n) * kWidth / 3.0);
  return sum / n;
}

TEST(GaussianProcess, IsNormalOfUnitVariance) {
  GaussianProcess g = process();
  g.remember(-22000.0, 22000.0);
  EXPECT_NEAR(mean([&](double x) { return g.at(x); }), 0.0, 0.03);
  EXPECT_NEAR(mean([&](double x) { return g.at(x) * g.at(x); }), 1.0, 0.04);
  EXPECT_NEAR(mean([&](double x) { return std::pow(g.at(x), 4); }), 3.0, 0.28);
}

TEST(GaussianProcess, AutocorrelationHasTheWidthAskedFor) {
  GaussianProcess g = process();
  g.remember(-22000.0, 22000.0);
  const auto correlation = [&](double distance) {
    return mean([&](double x) { return g.at(x) * g.at(x + distance); });
  };
  EXPECT_NEAR(correlation(0.5 * kWidth), 0.5, 0.03);
  EXPECT_NEAR(correlation(kWidth), 1.0 / 16.0, 0.03);
  EXPECT_NEAR(correlation(3.0 * kWidth), 0.0, 0.03);
}

/// Of sixteen processes together: a standard error of 0.007 / 4 times the root of 1 + 1/4 for what is asked.
TEST(GaussianProcess, HalfOfTheCorrelationIsLeftAtHalfTheWidthToOnePerCent) {
  double sum = 0.0;
  for (std::uint32_t address = 0; address < 16; ++address) {
    GaussianProcess g = process(0.0, 0.0, address);
    g.remember(-22000.0, 22000.0);
    sum += mean([&](double x) { return g.at(x) * g.at(x + 0.5 * kWidth); }) / 16.0;
  }
  EXPECT_NEAR(sum, 0.5, 0.008);
}

TEST(GaussianProcess, ChangesOverItsLifetimeWithoutJumps) {
  GaussianProcess now = process(40.0, 1.5), half = process(40.75, 1.5), later = process(45.0, 1.5);
  for (GaussianProcess* g : {&now, &half, &later}) g->remember(-22000.0, 22000.0);
  EXPECT_NEAR(mean([&](double x) { return now.at(x) * now.at(x); }), 1.0, 0.04);
  EXPECT_NEAR(mean([&](double x) { return now.at(x) * half.at(x); }), 0.5, 0.03);
  EXPECT_NEAR(mean([&](double x) { return now.at(x) * later.at(x); }), 0.0, 0.03);
  // The slope by the place in units of the kernel's standard deviation is normal, of variance 1/2: steps of
  // 1e-3 of it differ by less than 5e-3, and the cut of the kernel adds 4e-5 times a white number.
  for (int i = 0; i < 4000; ++i) {
    const double t = 40.0 + 1e-3 * 0.45 * i, x = 1e-3 * 0.6 * i;
    EXPECT_NEAR(process(t, 1.5).at(3.3), process(t + 1e-3 * 0.45, 1.5).at(3.3), 5e-3);
    EXPECT_NEAR(process().at(x), process().at(x + 1e-3 * 0.6), 5e-3);
  }
}

TEST(GaussianProcess, DoesNotDependOnWhatIsRemembered) {
  GaussianProcess fresh = process(1.0, 2.0), remembering = process(1.0, 2.0);
  remembering.remember(-5.0, 5.0);
  for (double x : {-40.0, -5.1, -4.0, 0.0, 0.3, 4.9, 7.0, 1e7}) EXPECT_EQ(fresh.at(x), remembering.at(x));
}

TEST(GaussianProcess, DiffersBetweenAddresses) {
  GaussianProcess a = process(0.0, 0.0, 1), b = process(0.0, 0.0, 2);
  EXPECT_NEAR(mean([&](double x) { return a.at(x) * b.at(x); }), 0.0, 0.03);
}

TEST(GaussianField, IsNormalAndAsWideAcrossAsAlong) {
  GaussianField f(7, Stream::patch, 2, kWidth, 3.0, 1.0);
  // 120 x 120 widths of independent pieces: a standard error of 0.01 for the variance.
  double square = 0.0, along = 0.0, across = 0.0, oblique = 0.0;
  constexpr int n = 120;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = i * kWidth + 0.3, y = j * kWidth - 90.0, here = f.at(x, y);
      square += here * here / (n * n);
      along += here * f.at(x + 0.5 * kWidth, y) / (n * n);
      across += here * f.at(x, y + 0.5 * kWidth) / (n * n);
      oblique += here * f.at(x + 0.5 * kWidth, y + 0.5 * kWidth) / (n * n);
    }
  EXPECT_NEAR(square, 1.0, 0.05);
  EXPECT_NEAR(along, 0.5, 0.04);
  EXPECT_NEAR(across, 0.5, 0.04);
  EXPECT_NEAR(oblique, 0.25, 0.04);
}

}  // namespace
}  // namespace vegard::sim::gaussian_process_test
