#include "fit/uncertainty/profile_likelihood.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

namespace vegard::fit::profile_likelihood_test {
namespace {

/// chi2 = 7 + (x - m)ᵀ A (x - m) with A far from diagonal, and its exact minimum over all but one coordinate.
struct Parabola {
  Eigen::Matrix3d a;
  Eigen::Vector3d m{1.0, -2.0, 0.5};
  Parabola() { a << 4.0, 1.8, 0.3, 1.8, 1.0, 0.1, 0.3, 0.1, 9.0; }
  double minimised(std::size_t j, double fixed, std::vector<double>& point) const {
    const Eigen::Matrix3d covariance = a.inverse();
    const auto jj = static_cast<Eigen::Index>(j);
    const Eigen::Vector3d x = m + covariance.col(jj) / covariance(jj, jj) * (fixed - m(jj));
    point.assign(x.data(), x.data() + 3);
    return 7.0 + (x - m).dot(a * (x - m));
  }
};

TEST(ProfileLikelihood, OfAParabolaIsTheCovariances) {
  const Parabola p;
  const Eigen::Matrix3d covariance = p.a.inverse();
  const std::vector<double> answer(p.m.data(), p.m.data() + 3);
  for (std::size_t j = 0; j < 3; ++j)
    for (const double first : {0.05, 1.0, 3.0}) {
      ProfileLikelihoodOptions options;
      options.inflation = 1.7;
      options.first_step = first;
      options.max_steps = 200.0;
      const auto jj = static_cast<Eigen::Index>(j);
      const double sigma = 1.7 * std::sqrt(covariance(jj, jj));
      const LikelihoodProfile profile = profile_likelihood(
          j, answer, 7.0,
          [&](std::size_t k, double x, std::vector<double>& point) { return p.minimised(k, x, point); },
          options);
      EXPECT_TRUE(profile.whole);
      EXPECT_FALSE(profile.better);
      // The square root of a parabola is a straight line, so that the secant is exact.
      EXPECT_NEAR(profile.interval68.lower.value(), answer[j] - sigma, 1e-9);
      EXPECT_NEAR(profile.interval68.upper.value(), answer[j] + sigma, 1e-9);
      EXPECT_NEAR(profile.interval95.lower.value(), answer[j] - 2.0 * sigma, 1e-9);
      EXPECT_NEAR(profile.interval95.upper.value(), answer[j] + 2.0 * sigma, 1e-9);
      // The path is the regression line: the others give way by their covariance.
      for (std::size_t i = 0; i < profile.path.size(); ++i) {
        const ProfilePoint& at = profile.path[i];
        if (i > 0) {
          EXPECT_GT(at.fixed, profile.path[i - 1].fixed);
        }
        EXPECT_NEAR(at.rise, std::pow((at.fixed - answer[j]) / sigma, 2), 1e-9);
        for (Eigen::Index k = 0; k < 3; ++k)
          EXPECT_NEAR(at.point[k], p.m(k) + covariance(k, jj) / covariance(jj, jj) * (at.fixed - answer[j]),
                      1e-9);
      }
    }
}

// chi2 of a Poisson count of 5 and its rate e^u: 2 (e^u - 5 u) less its least. Its ends solve
// e^u - 5 u - 5 + 5 ln 5 = rise / 2; of the rise of 1 these are the rates 3.084084 and 7.581106
// (by bisection of that equation).
TEST(ProfileLikelihood, IsLopsidedWhereChi2Is) {
  const auto chi2 = [](double u) { return 2.0 * (std::exp(u) - 5.0 * u); };
  const double answer = std::log(5.0);
  ProfileLikelihoodOptions options;
  options.first_step = 1.0 / std::sqrt(5.0);
  options.tolerance = 1e-6;
  int minimisations = 0;
  const LikelihoodProfile profile = profile_likelihood(
      0, {answer}, chi2(answer),
      [&](std::size_t, double u, std::vector<double>&) {
        ++minimisations;
        return chi2(u);
      },
      options);
  const auto rise_at = [&](const std::optional<double>& u) { return chi2(u.value()) - chi2(answer); };
  EXPECT_NEAR(rise_at(profile.interval68.lower), 1.0, 1e-5);
  EXPECT_NEAR(rise_at(profile.interval68.upper), 1.0, 1e-5);
  EXPECT_NEAR(rise_at(profile.interval95.lower), 4.0, 4e-5);
  EXPECT_NEAR(rise_at(profile.interval95.upper), 4.0, 4e-5);
  EXPECT_NEAR(std::exp(*profile.interval68.lower), 3.084084, 2e-5);
  EXPECT_NEAR(std::exp(*profile.interval68.upper), 7.581106, 2e-5);
  EXPECT_GT(answer - *profile.interval68.lower, 1.15 * (*profile.interval68.upper - answer));
  EXPECT_LT(minimisations, 24);  // six for each end: every one is a descent
}

// Outwards it costs, inwards nothing: open on that side, whether a limit ends the walk or nothing does.
TEST(ProfileLikelihood, IsOpenWhereNothingBounds) {
  const auto one_sided = [](std::size_t, double x, std::vector<double>&) {
    return x > 0.0 ? x * x : 0.5 * std::tanh(-x);
  };
  ProfileLikelihoodOptions options;
  LikelihoodProfile profile = profile_likelihood(0, {0.0}, 0.0, one_sided, options);
  EXPECT_FALSE(profile.interval68.lower);
  EXPECT_FALSE(profile.interval95.lower);
  EXPECT_NEAR(profile.interval68.upper.value(), 1.0, 1e-9);
  EXPECT_NEAR(profile.interval95.upper.value(), 2.0, 1e-9);
  EXPECT_TRUE(profile.whole);
  EXPECT_NEAR(profile.path.front().fixed, -20.0, 1e-9);
  options.most = 1.5;  // within the 95 % interval, outside of the 68 %
  profile = profile_likelihood(0, {0.0}, 0.0, one_sided, options);
  EXPECT_NEAR(profile.interval68.upper.value(), 1.0, 1e-9);
  EXPECT_FALSE(profile.interval95.upper);
  EXPECT_LE(profile.path.back().fixed, 1.5);
}

TEST(ProfileLikelihood, TellsOfABetterAnswer) {
  const LikelihoodProfile profile = profile_likelihood(
      0, {0.0}, 0.0,
      [](std::size_t, double x, std::vector<double>&) {
        return x * x - 5.0 * std::exp(-8.0 * std::pow(x - 2.0, 2));
      },
      ProfileLikelihoodOptions{});
  ASSERT_TRUE(profile.better);
  EXPECT_NEAR(profile.better->fixed, 2.0, 0.5);
  EXPECT_FALSE(profile.interval95.upper);
  EXPECT_NEAR(profile.interval95.lower.value(), -2.0, 1e-6);
}

TEST(ProfileLikelihood, EndsWhenStoppedOrAtAWall) {
  std::atomic<bool> stop{false};
  ProfileLikelihoodOptions options;
  options.stop = &stop;
  const LikelihoodProfile stopped = profile_likelihood(
      0, {0.0}, 0.0,
      [&](std::size_t, double x, std::vector<double>&) {
        stop = true;
        return 0.1 * x * x;
      },
      options);
  EXPECT_FALSE(stopped.whole);
  EXPECT_EQ(stopped.path.size(), 2u);
  const LikelihoodProfile wall = profile_likelihood(
      0, {0.0}, 0.0,
      [](std::size_t, double x, std::vector<double>&) { return x > 1.5 ? std::nan("") : x * x; },
      ProfileLikelihoodOptions{});
  EXPECT_NEAR(wall.interval68.upper.value(), 1.0, 1e-9);
  EXPECT_FALSE(wall.interval95.upper);
  EXPECT_NEAR(wall.interval95.lower.value(), -2.0, 1e-9);
}

}  // namespace
}  // namespace vegard::fit::profile_likelihood_test
