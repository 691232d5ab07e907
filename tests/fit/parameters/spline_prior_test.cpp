#include "fit/parameters/spline_prior.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <string>

#include "sim/base/number/random.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/spline_rates.h"

namespace vegard::fit::spline_prior_test {
namespace {

sim::Scene free_form(const std::string& more = "") {
  return sim::parse_scene(
      "[[sheet]]\nprofile = \"spline\"\nspline_knots = 64\n" + more +
          "[emission]\nlines = [557.7, 427.8]\n[fit]\nfree = [\"sheet.main.spline_rate\"]\n",
      "scene.toml");
}

std::vector<double> starts(const std::vector<FreeNumber>& free) {
  std::vector<double> values;
  for (const FreeNumber& number : free) values.push_back(number.start);
  return values;
}

TEST(PriorRows, JacobianAgreesWithDifferences) {
  sim::Scene scene = free_form();
  std::vector<FreeNumber> free = free_numbers(scene);
  free[5].prior = sim::Prior{40.0, 7.0};
  PriorRows rows(free);
  append_rows(spline_prior(scene, free, 3.0), scene, 2.0, rows);
  ASSERT_EQ(rows.count(), 1u + 2u * 62u + 1u) << "a number's own, bends, the scale";
  std::vector<double> values = starts(free), residuals, up, down, jacobian;
  for (std::size_t j = 0; j < values.size(); ++j) values[j] *= 1.0 + 0.3 * std::sin(3.0 * j);
  rows.evaluate(values, residuals, &jacobian);
  for (const std::size_t j : {0u, 5u, 64u, 100u, 127u}) {
    const double value = values[j], step = 1e-5 * value;
    values[j] = value + step;
    rows.evaluate(values, up, nullptr);
    values[j] = value - step;
    rows.evaluate(values, down, nullptr);
    values[j] = value;
    for (std::size_t r = 0; r < rows.count(); ++r) {
      const double difference = (up[r] - down[r]) / (2.0 * step);
      EXPECT_NEAR(jacobian[r * values.size() + j], difference, 1e-6 * std::abs(difference) + 1e-7);
    }
  }
}

TEST(SplinePrior, AnExponentialProfileCostsNothingAndTheStartHoldsTheScale) {
  sim::Scene scene = free_form();
  const sim::AltitudeSpline spline = sim::altitude_spline(scene.sheets[0]);
  for (int l = 0; l < 2; ++l)
    for (int k = 0; k < spline.count(); ++k)
      scene.sheets[0].spline_rate[l * spline.count() + k] = 500.0 * std::exp(-spline.centre_km(k) / 35.0);
  const std::vector<FreeNumber> free = free_numbers(scene);
  PriorRows rows(free);
  append_rows(spline_prior(scene, free, 5.0), scene, 1.0, rows);
  std::vector<double> residuals;
  rows.evaluate(starts(free), residuals, nullptr);
  for (const double residual : residuals) EXPECT_NEAR(residual, 0.0, 1e-9);

  std::vector<double> brighter = starts(free);
  for (double& value : brighter) value *= 1.01;
  rows.evaluate(brighter, residuals, nullptr);
  EXPECT_NEAR(residuals.back(), std::log(1.01) / SplinePrior::kScaleError, 1e-6);
}

TEST(SplinePrior, SomethingThatIsNotFreeGivesTheScale) {
  const sim::Scene scene = free_form();
  std::vector<FreeNumber> free = free_numbers(scene);
  EXPECT_TRUE(spline_prior(scene, free, 1.0).holds_scale);
  free.pop_back();
  EXPECT_FALSE(spline_prior(scene, free, 1.0).holds_scale);
  sim::Scene two = scene;
  two.sheets.push_back(sim::Sheet{});
  two.sheets.back().name = "other";
  EXPECT_FALSE(spline_prior(two, free_numbers(two), 1.0).holds_scale);
}

// Bends drawn with known spreads (seed 4), seen directly with little noise: 62 bends tell a standard
// deviation to 1 / sqrt(124) = 9 %, and three of that are allowed.
TEST(SplinePrior, TheMostProbableSmoothnessIsThatOfTheBendsLineByLine) {
  const sim::Scene scene = free_form();
  const std::vector<FreeNumber> free = free_numbers(scene);
  const SplinePrior prior = spline_prior(scene, free, 1.0);
  const double spread[2] = {0.5, 0.05};
  std::vector<double> at(free.size());
  for (std::size_t l = 0; l < 2; ++l) {
    const SplineLine& line = prior.lines[l];
    at[line.numbers[1]] = 0.1;
    for (std::size_t i = 0; i < line.bends.size(); ++i) {
      const auto words = sim::random_words(4, sim::Stream::search, static_cast<std::uint32_t>(l),
                                           static_cast<std::uint32_t>(i));
      const double u = sim::uniform(words[0]), v = sim::uniform(words[1]);
      const double normal = std::sqrt(-2.0 * std::log(1.0 - u)) * std::cos(6.283185307179586 * v);
      const Bend& bend = line.bends[i];
      at[bend.numbers[2]] = (spread[l] * normal - bend.factors[0] * at[bend.numbers[0]] -
                             bend.factors[1] * at[bend.numbers[1]]) /
                            bend.factors[2];
    }
  }
  const std::size_t n = free.size();
  std::vector<double> information(n * n, 0.0), none(n * n, 0.0);
  for (std::size_t j = 0; j < n; ++j) information[j * n + j] = 1e8;  // 1e-4 on every logarithm
  double determined = 0.0;
  const std::vector<double> smoothness =
      most_probable_smoothness(prior, information, none, at, 1.0, &determined);
  EXPECT_NEAR(std::log(smoothness[0] * spread[0]), 0.0, 0.27);
  EXPECT_NEAR(std::log(smoothness[1] * spread[1]), 0.0, 0.27);
  EXPECT_NEAR(determined, static_cast<double>(n), 0.1);
}

TEST(SplinePrior, CoefficientsListedOneByOneAndOutOfOrderAreAsSmooth) {
  const sim::Scene scene = free_form();
  sim::Scene backwards = scene;
  backwards.fit.free.clear();
  for (int k = 128; k-- > 0;) {
    sim::FreeParameter one;
    one.path = "sheet.main.spline_rate." + std::string(k < 64 ? "5577_" : "4278_") + std::to_string(k % 64);
    backwards.fit.free.push_back(one);
  }
  const std::vector<FreeNumber> free = free_numbers(scene), other = free_numbers(backwards);
  const std::vector<SplineLine> lines = spline_lines(scene, free), others = spline_lines(backwards, other);
  ASSERT_EQ(others.size(), 2u);
  for (std::size_t l = 0; l < 2; ++l) {
    EXPECT_EQ(others[l].knots, lines[l].knots);
    ASSERT_EQ(others[l].bends.size(), 62u);
    for (std::size_t b = 0; b < 62; ++b)
      for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(other[others[l].bends[b].numbers[i]].path, free[lines[l].bends[b].numbers[i]].path);
        EXPECT_EQ(others[l].bends[b].factors[i], lines[l].bends[b].factors[i]);
      }
  }
}

/// Data 2 ln(c) = 2 target with an error of 1 each, and the prior they are seen under.
struct Seen {
  std::vector<FreeNumber> free = free_numbers(free_form());
  SplinePrior prior = spline_prior(free_form(), free, 1.0);
  Eigen::MatrixXd data = Eigen::MatrixXd::Identity(128, 128) * 4.0, bends = Eigen::MatrixXd::Zero(128, 128);
  Eigen::VectorXd target{128};

  Seen() {
    for (int j = 0; j < 128; ++j) target(j) = std::sin(0.7 * j) + 0.3 * std::sin(2.9 * j * j);
    for (const SplineLine& line : prior.lines)
      for (const Bend& bend : line.bends)
        for (int i = 0; i < 3; ++i)
          for (int k = 0; k < 3; ++k)
            bends(bend.numbers[i], bend.numbers[k]) += bend.factors[i] * bend.factors[k];
  }
  /// From the optimum under the bends times `weight`.
  std::vector<double> smoothness(double weight) const {
    const Eigen::VectorXd at = (data + weight * weight * bends).ldlt().solve(data * target);
    const std::vector<double> information(data.data(), data.data() + data.size()), none(data.size(), 0.0);
    return most_probable_smoothness(prior, information, none, {at.data(), at.data() + at.size()}, weight,
                                    nullptr);
  }
};

TEST(SplinePrior, TheMostProbableSmoothnessDoesNotDependOnTheWeightOfTheLastDescent) {
  const Seen seen;
  const std::vector<double> expected = seen.smoothness(1.0);
  EXPECT_GT(expected[0], 0.06);
  EXPECT_LT(expected[0], 90.0) << "neither limit";
  for (const double weight : {0.2, 3.0, 10.0})
    for (std::size_t l = 0; l < 2; ++l) EXPECT_NEAR(seen.smoothness(weight)[l] / expected[l], 1.0, 1e-6);
}

/// By data of this Jacobian.
double determined_by(const Seen& seen, const Eigen::MatrixXd& jacobian) {
  const Eigen::MatrixXd product = jacobian.transpose() * jacobian;
  const std::vector<double> information(product.data(), product.data() + product.size()),
      none(product.size(), 0.0), at(product.rows(), 0.0);
  double determined = 0.0;
  most_probable_smoothness(seen.prior, information, none, at, 1.0, &determined);
  return determined;
}

TEST(SplinePrior, ANumberThatIsTheScaleOverAgainTakesNoPart) {
  // One coordinate more that does what all coefficients do together: one direction is told by nothing, and
  // the data determine as many as without it. Rounding hides that.
  const Seen seen;
  for (const double unit : {1.0, 1.0 / 3.0, 1e-3, 700.1}) {
    Eigen::MatrixXd wider = Eigen::MatrixXd::Zero(128, 129);
    for (int i = 0; i < 128; ++i)
      for (int k = 0; k < 128; ++k)
        wider(i, k) = (i == k ? 200.0 : 0.0) + std::sin(1.0 + i * 3.3 + k * k * 0.7);
    const double determined_alone = determined_by(seen, wider.leftCols(128));
    wider.col(128) = unit * wider.leftCols(128).rowwise().sum();
    EXPECT_NEAR(determined_by(seen, wider), determined_alone, 1e-3) << unit;
  }
}

}  // namespace
}  // namespace vegard::fit::spline_prior_test
