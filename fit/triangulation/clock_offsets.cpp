#include "fit/triangulation/clock_offsets.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace clock_offsets {

constexpr double kReach = 4.0;                      ///< of the velocity's grid, in standard deviations
constexpr int kFewestSteps = 12, kMostSteps = 120;  ///< to each side
constexpr double kLeastClock_s = 1e-3;
constexpr double kFlat_km = 1e4;  ///< standard deviation of a height of which nothing is known
constexpr double kTold = 0.8;

/// The offsets and the height for one velocity, with the logarithm of its probability.
struct Linear {
  Eigen::VectorXd mean;
  Eigen::VectorXd square;  ///< of their errors
  double logarithm = 0.0;
};

/// Pairs with the covariances that they count with, and the height that all of them are near.
struct Problem {
  std::size_t pictures = 0;
  std::vector<MovedPair> pairs;
  std::vector<Eigen::Matrix2d> weights;
  double clock_s = 0.0, middle_km = 0.0;
};

Linear solved_for(const Problem& problem, const Eigen::Vector3d& velocity_km_s) {
  const auto n = static_cast<Eigen::Index>(problem.pictures);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n + 1, n + 1);
  normal.diagonal().head(n).setConstant(std::pow(problem.clock_s, -2));
  normal(n, n) = std::pow(kFlat_km, -2);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 1);
  double squares = 0.0;
  for (std::size_t p = 0; p < problem.pairs.size(); ++p) {
    const MovedPair& pair = problem.pairs[p];
    const Eigen::Vector2d per_second(pair.border_km_per_km * velocity_km_s.dot(pair.along),
                                     velocity_km_s.dot(pair.across));
    Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(2, n + 1);
    for (Eigen::Index row = 0; row < 2; ++row) {
      slope(row, static_cast<Eigen::Index>(pair.second)) = per_second[row];
      slope(row, static_cast<Eigen::Index>(pair.first)) = -per_second[row];
    }
    slope(0, n) = 1.0;
    const Eigen::Vector2d off =
        Eigen::Vector2d(pair.border_km - problem.middle_km, pair.across_km) - pair.apart_s * per_second;
    normal += slope.transpose() * problem.weights[p] * slope;
    right += slope.transpose() * problem.weights[p] * off;
    squares += off.dot(problem.weights[p] * off);
  }
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
  Linear found;
  found.mean = solver.solve(right);
  found.square = solver.solve(Eigen::MatrixXd::Identity(n + 1, n + 1)).diagonal();
  found.logarithm = -0.5 * (squares - right.dot(found.mean)) - 0.5 * solver.vectorD().array().log().sum();
  return found;
}

}  // namespace clock_offsets

ClockSolution::ClockSolution() : border_km(sim::kNaN), border_error_km(sim::kNaN) {}

ClockSolution clock_solution(std::size_t pictures, const std::vector<MovedPair>& pairs, double clock_error_s,
                             double drift_km_s) {
  using namespace clock_offsets;
  ClockSolution solution;
  solution.offsets.assign(pictures, ClockOffset{0.0, clock_error_s, false});
  if (pairs.empty()) return solution;
  Problem problem{pictures, pairs, {}, std::max(clock_error_s, kLeastClock_s), 0.0};
  const double shared = std::max(
      1.0, static_cast<double>(pairs.size()) / static_cast<double>(std::max<std::size_t>(1, pictures - 1)));
  double longest_s = 0.0, least_km = HUGE_VAL;
  for (const MovedPair& pair : pairs) {
    problem.weights.push_back((shared * pair.covariance_km2).inverse());
    problem.middle_km += pair.border_km / static_cast<double>(pairs.size());
    longest_s = std::max(longest_s, std::abs(pair.apart_s) + 3.0 * problem.clock_s);
    least_km = std::min(least_km, std::sqrt(pair.covariance_km2(1, 1)));
  }
  // Sums over a normal curve by steps of 1.5 standard deviations are exact to a part in a thousand.
  const double wanted_km_s = 1.5 * least_km / longest_s;
  const int half = drift_km_s > 0.0
                       ? std::clamp(static_cast<int>(std::ceil(kReach * drift_km_s / wanted_km_s)),
                                    kFewestSteps, kMostSteps)
                       : 0;
  const double step_km_s = half > 0 ? kReach * drift_km_s / half : 0.0;
  std::vector<Linear> all;
  for (int i = -half; i <= half; ++i)
    for (int j = -half; j <= half; ++j) {
      all.push_back(solved_for(problem, step_km_s * (i * pairs.front().along + j * pairs.front().across)));
      if (half > 0)
        all.back().logarithm -= 0.5 * std::pow(kReach / half, 2) * static_cast<double>(i * i + j * j);
    }
  double most = -HUGE_VAL, sum = 0.0;
  for (const Linear& one : all) most = std::max(most, one.logarithm);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(pictures) + 1), square = mean;
  for (const Linear& one : all) {
    const double weight = std::exp(one.logarithm - most);
    sum += weight;
    mean += weight * one.mean;
    square += weight * (one.square + one.mean.cwiseAbs2());
  }
  mean /= sum;
  const Eigen::VectorXd error = (square / sum - mean.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  for (std::size_t i = 0; i < pictures; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    solution.offsets[i] = {mean[k], error[k], error[k] < kTold * clock_error_s};
  }
  solution.border_km = problem.middle_km + mean[static_cast<Eigen::Index>(pictures)];
  solution.border_error_km = error[static_cast<Eigen::Index>(pictures)];
  return solution;
}

}  // namespace vegard::fit
