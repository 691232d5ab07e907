#include "sim/base/number/spline.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::sim::spline_test {
namespace {

const std::vector<double> kKnots = {0.0, 0.5, 1.7, 2.0, 3.1, 5.0};

std::vector<double> values(double (*f)(double)) {
  std::vector<double> y;
  for (double x : kKnots) y.push_back(f(x));
  return y;
}

SplineValue at(const std::vector<double>& y, double x) {
  return spline_at(kKnots, y, spline_curvature(kKnots, y), x);
}

TEST(Spline, PassesThroughItsKnotsWithoutCurvatureAtTheEnds) {
  const std::vector<double> y = values([](double x) { return std::sin(2.0 * x); });
  const std::vector<double> curvature = spline_curvature(kKnots, y);
  EXPECT_EQ(curvature.front(), 0.0);
  EXPECT_EQ(curvature.back(), 0.0);
  EXPECT_GT(std::abs(curvature[2]), 0.1);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(at(y, kKnots[i]).value, y[i], 1e-14);
}

TEST(Spline, HasContinuousSlopeAndCurvatureAtInnerKnots) {
  const std::vector<double> y = values([](double x) { return std::exp(-x) + x * x; });
  const std::vector<double> curvature = spline_curvature(kKnots, y);
  constexpr double h = 1e-5;
  for (std::size_t i = 1; i + 1 < y.size(); ++i) {
    const double left = at(y, kKnots[i] - h).slope, here = at(y, kKnots[i]).slope,
                 right = at(y, kKnots[i] + h).slope;
    EXPECT_NEAR((here - left) / h, curvature[i], 1e-3) << "from the left of knot " << i;
    EXPECT_NEAR((right - here) / h, curvature[i], 1e-3) << "from the right of knot " << i;
  }
}

TEST(Spline, IsExactForStraightLinesBeyondItsEndsToo) {
  const std::vector<double> y = values([](double x) { return 3.0 - 2.0 * x; });
  for (double x = -1.0; x < 6.0; x += 0.13) {
    EXPECT_NEAR(at(y, x).value, 3.0 - 2.0 * x, 1e-13);
    EXPECT_NEAR(at(y, x).slope, -2.0, 1e-13);
  }
}

TEST(Spline, IsLinearInItsValues) {
  const std::vector<double> f = values([](double x) { return std::sin(x); });
  const std::vector<double> g = values([](double x) { return x * x - 1.0; });
  std::vector<double> both;
  for (std::size_t i = 0; i < f.size(); ++i) both.push_back(2.0 * f[i] - 0.7 * g[i]);
  for (double x = 0.0; x <= 5.0; x += 0.21)
    EXPECT_NEAR(at(both, x).value, 2.0 * at(f, x).value - 0.7 * at(g, x).value, 1e-13);
}

TEST(Spline, SlopeIsTheDerivativeOfTheValue) {
  const std::vector<double> y = values([](double x) { return std::cos(3.0 * x); });
  constexpr double h = 1e-6;
  for (double x = 0.05; x < 5.0; x += 0.17)
    EXPECT_NEAR(at(y, x).slope, (at(y, x + h).value - at(y, x - h).value) / (2.0 * h), 1e-8) << x;
}

TEST(Spline, IsExactForACubicOfGivenSlopesAtItsEnds) {
  const auto cubic = [](double x) { return 1.0 - 2.0 * x + 0.3 * x * x + 0.1 * x * x * x; };
  const auto slope = [](double x) { return -2.0 + 0.6 * x + 0.3 * x * x; };
  const auto integral = [](double x) { return x - x * x + 0.1 * x * x * x + 0.025 * x * x * x * x; };
  std::vector<double> y;
  for (const double x : kKnots) y.push_back(cubic(x));
  const std::vector<double> curvature =
      clamped_spline_curvature(kKnots, y, slope(kKnots.front()), slope(kKnots.back()));
  for (double x = 0.0; x <= 5.0; x += 0.21) {
    EXPECT_NEAR(spline_at(kKnots, y, curvature, x).value, cubic(x), 1e-12) << x;
    EXPECT_NEAR(spline_integral(kKnots, y, curvature, x), integral(x), 1e-12) << x;
  }
  EXPECT_NEAR(spline_integral(kKnots, y, curvature, 5.0), integral(5.0), 1e-12);
}

TEST(Spline, OfTwoKnotsIsTheLineBetweenThem) {
  const std::vector<double> x = {1.0, 3.0}, y = {5.0, 9.0};
  EXPECT_NEAR(spline_at(x, y, spline_curvature(x, y), 1.5).value, 6.0, 1e-14);
}

}  // namespace
}  // namespace vegard::sim::spline_test
