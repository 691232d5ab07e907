#include "fit/uncertainty/surrogate_cost.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace vegard::fit::surrogate_cost_test {
namespace {

using Values = std::vector<double>;
using Of = std::function<Values(const Values&)>;

const Values kAnswer = {2.0, -1.0, 0.5};
const std::vector<Values> kCovariance = {{0.04, 0.01, 0.0}, {0.01, 0.09, 0.006}, {0.0, 0.006, 0.01}};

/// With derivatives by differences of fifth order, which for what is tested here are good to rounding.
SurrogateCost::Residuals with_slopes(const Of& of) {
  return [of](const Values& at, Values& r, Values& jacobian) {
    r = of(at);
    jacobian.assign(r.size() * at.size(), 0.0);
    constexpr double kH = 1e-3;
    for (std::size_t j = 0; j < at.size(); ++j)
      for (const auto& [by, weight] : {std::pair(-2.0, 1.0), {-1.0, -8.0}, {1.0, 8.0}, {2.0, -1.0}}) {
        Values there = at;
        there[j] += by * kH;
        const Values then = of(there);
        for (std::size_t i = 0; i < r.size(); ++i)
          jacobian[i * at.size() + j] += weight * then[i] / (12.0 * kH);
      }
    return true;
  };
}

double chi2(const Of& of, const Values& at) {
  double sum = 0.0;
  for (const double r : of(at)) sum += r * r;
  return sum;
}

// Residuals of second order, with a mixed term for each pair and what is left at the answer far from nothing:
// the expansion is the sum of squares itself, as far out as one likes.
TEST(SurrogateCost, OfResidualsOfSecondOrderIsExactEverywhere) {
  const Of of = [](const Values& x) {
    return Values{1.0 + 3.0 * x[0] - x[1] * x[2], 2.0 - x[1] + 0.7 * x[0] * x[0],
                  -4.0 + x[2] * x[0] + x[1] * x[1], 0.3 * x[2] * x[2] + x[0] - 2.0 * x[1],
                  5.0 + 2.0 * x[0] * x[1] - 3.0 * x[2]};
  };
  const SurrogateCost surrogate(with_slopes(of), kAnswer, kCovariance);
  for (const Values& at : {Values{2.0, -1.0, 0.5}, {2.3, -1.4, 0.45}, {1.0, 1.0, 1.0}, {6.0, -7.0, 3.0}})
    // Rounding of differences over a step of 0.001, times the polynomial's size.
    EXPECT_NEAR(surrogate.rise(at), chi2(of, at) - chi2(of, kAnswer), 1e-8 * (1.0 + chi2(of, at)));
}

// A saturating curve, as a model's is: at the answer value and slope are those of the sum of squares, and
// within two standard deviations the curved expansion is several times as near as the linear one.
TEST(SurrogateCost, NearTheAnswerHasTheCostsValueAndSlope) {
  const Of of = [](const Values& x) {
    Values r;
    for (int i = 0; i < 20; ++i) {
      const double t = 0.1 * i;
      r.push_back(20.0 * (x[0] * std::exp(-t * (1.0 + x[2])) + std::tanh(x[1] * (1.0 + t)) - 0.7 + 0.2 * t));
    }
    return r;
  };
  const std::vector<Values> narrow = {{0.01, 0.002, 0.0}, {0.002, 0.01, 0.001}, {0.0, 0.001, 0.01}};
  const SurrogateCost surrogate(with_slopes(of), kAnswer, narrow);
  EXPECT_EQ(surrogate.rise(kAnswer), 0.0);
  EXPECT_EQ(surrogate.square(kAnswer), 0.0);
  constexpr double kH = 1e-4;
  Values slope;
  for (std::size_t j = 0; j < 3; ++j) {
    Values before = kAnswer, after = kAnswer;
    before[j] -= kH;
    after[j] += kH;
    slope.push_back((chi2(of, after) - chi2(of, before)) / (2.0 * kH));
    // Third derivatives times h² / 6, of a sum of squares of some thousands.
    EXPECT_NEAR((surrogate.rise(after) - surrogate.rise(before)) / (2.0 * kH), slope[j], 1e-3);
  }
  Values r, jacobian;
  with_slopes(of)(kAnswer, r, jacobian);
  for (const Values& by : {Values{0.1, 0.1, -0.1}, {-0.1, 0.1, 0.1}, {0.15, -0.1, 0.05}, {0.0, 0.2, 0.0}}) {
    Values at = kAnswer;
    double linear = 0.0;
    for (std::size_t i = 0; i < r.size(); ++i) {
      double there = r[i];
      for (std::size_t j = 0; j < 3; ++j) there += jacobian[i * 3 + j] * by[j];
      linear += there * there - r[i] * r[i];
    }
    for (std::size_t j = 0; j < 3; ++j) at[j] += by[j];
    const double exact = chi2(of, at) - chi2(of, kAnswer);
    EXPECT_LT(std::abs(surrogate.rise(at) - exact), 0.35 * std::abs(linear - exact)) << by[0] << " " << by[1];
  }
  // Mahalanobis' distance: one of the last coordinate's own standard deviations, the others going along.
  EXPECT_NEAR(surrogate.square({2.0, -0.99, 0.6}), 1.0, 1e-9);
}

// Where there are no residuals on a coordinate's way, it is expanded linearly; where there are none at all,
// it is level.
TEST(SurrogateCost, GoesWithoutWhatItCannotHave) {
  const Of of = [](const Values& x) { return Values{3.0 * x[0] + x[1], x[1] - x[2], x[2] * x[2]}; };
  const auto whole = with_slopes(of);
  const SurrogateCost half(
      [&](const Values& at, Values& r, Values& jacobian) {
        return std::abs(at[2] - kAnswer[2]) < 1e-12 && whole(at, r, jacobian);
      },
      kAnswer, {{0.04, 0.0, 0.0}, {0.0, 0.09, 0.0}, {0.0, 0.0, 0.01}});
  const Values at = {2.1, -1.2, 0.6};
  // x2² about 0.5 to first order: 0.25 + 0.1.
  const double linear = std::pow(3.0 * 2.1 - 1.2, 2) + 1.8 * 1.8 + 0.35 * 0.35;
  EXPECT_NEAR(half.rise(at), linear - chi2(of, kAnswer), 1e-8);
  const SurrogateCost none([](const Values&, Values&, Values&) { return false; }, kAnswer, kCovariance);
  EXPECT_EQ(none.rise(at), 0.0);
}

}  // namespace
}  // namespace vegard::fit::surrogate_cost_test
