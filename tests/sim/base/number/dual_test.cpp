#include "sim/base/number/dual.h"

#include <gtest/gtest.h>

namespace vegard::sim::dual_test {
namespace {

using Two = Dual<double, Tangents<double, 2>>;

/// Compares the tangents of f(a, b) with central differences; the error of those is about 1e-9 here.
template <class F>
void expect_derivatives(const char* what, const F& f) {
  SCOPED_TRACE(what);
  constexpr double a = 1.3, b = 0.7, h = 1e-5;
  Two x(a), y(b);
  x.d.t[0] = 1.0;
  y.d.t[1] = 1.0;
  const Two result = f(x, y);
  EXPECT_DOUBLE_EQ(result.v, f(a, b));
  EXPECT_NEAR(result.d.t[0], (f(a + h, b) - f(a - h, b)) / (2 * h), 1e-8);
  EXPECT_NEAR(result.d.t[1], (f(a, b + h) - f(a, b - h)) / (2 * h), 1e-8);
}

TEST(Dual, EveryOperatorFollowsTheChainRule) {
  expect_derivatives("a + b", [](auto a, auto b) { return a + b; });
  expect_derivatives("a + c", [](auto a, auto b) { return (a * b) + 2.5; });
  expect_derivatives("c + a", [](auto a, auto b) { return 2.5 + (a * b); });
  expect_derivatives("a - b", [](auto a, auto b) { return a - b; });
  expect_derivatives("a - c", [](auto a, auto b) { return (a * b) - 2.5; });
  expect_derivatives("c - a", [](auto a, auto b) { return 2.5 - (a * b); });
  expect_derivatives("-a", [](auto a, auto b) { return -(a * b); });
  expect_derivatives("a * b", [](auto a, auto b) { return a * b; });
  expect_derivatives("a * c", [](auto a, auto b) { return (a - b) * 2.5; });
  expect_derivatives("c * a", [](auto a, auto b) { return 2.5 * (a - b); });
  expect_derivatives("a / b", [](auto a, auto b) { return a / b; });
  expect_derivatives("a / c", [](auto a, auto b) { return (a * b) / 2.5; });
  expect_derivatives("c / a", [](auto a, auto b) { return 2.5 / (a * b); });
  expect_derivatives("square_root", [](auto a, auto b) { return square_root(a * b); });
  expect_derivatives("sine", [](auto a, auto b) { return sine(a * b); });
  expect_derivatives("cosine", [](auto a, auto b) { return cosine(a * b); });
  expect_derivatives("exponential", [](auto a, auto b) { return exponential(a * b); });
  expect_derivatives("logarithm", [](auto a, auto b) { return logarithm(a * b); });
  expect_derivatives("tangent", [](auto a, auto b) { return tangent(a * b); });
}

TEST(Dual, AConstantHasNoTangentsAndValueOfDropsThem) {
  const Two constant(4.0);
  EXPECT_EQ(constant.d.t[0], 0.0);
  EXPECT_EQ(constant.d.t[1], 0.0);
  Two x(3.0);
  x.d.t[1] = 5.0;
  EXPECT_EQ(value_of(x), 3.0);
}

}  // namespace
}  // namespace vegard::sim::dual_test
