#include "fit/triangulation/clock_offsets.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace clock_offsets {

constexpr double kReach = 4.0;  ///< of the velocities, in standard deviations
constexpr int kSteps = 12;      ///< of the first grid, to each side
constexpr std::size_t kMostVelocities = 40000;
constexpr double kLeastLogarithm = -18.0;  ///< of the probability of a velocity that is looked at closer
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
  double shared = 1.0;  ///< factor of the covariances
  double clock_s = 0.0, middle_km = 0.0;
  double drift_km_s = 0.0;
};

/// By how many seconds a pair's pictures may be apart.
double longest_s(const Problem& problem, const MovedPair& pair) {
  return std::abs(pair.apart_s) + 3.0 * problem.clock_s;
}

/// Velocities with equal steps in both directions.
struct Grid {
  double step_km_s = 0.0;
  bool is_fine = true;  ///< no step is wider than what the pairs tell
  std::vector<Eigen::Vector2d> at;
};

/// The weights of a pair's two numbers where a velocity stands for a square of velocities, as wide as a step:
/// half a step moves the light by as much. With fine steps it stands for itself.
Eigen::Matrix2d weight_of(const Problem& problem, const MovedPair& pair, const Grid& grid) {
  Eigen::Matrix2d covariance = pair.covariance_km2;
  if (!grid.is_fine) {
    const double half_km = 0.5 * grid.step_km_s * longest_s(problem, pair);
    covariance(0, 0) += std::pow(pair.border_km_per_km * half_km, 2);
    covariance(1, 1) += half_km * half_km;
  }
  return (problem.shared * covariance).inverse();
}

std::vector<Linear> solved_on(const Problem& problem, const Grid& grid) {
  const auto n = static_cast<Eigen::Index>(problem.pictures);
  std::vector<Eigen::Matrix2d> weights;
  for (const MovedPair& pair : problem.pairs) weights.push_back(weight_of(problem, pair, grid));
  std::vector<Linear> all;
  for (const Eigen::Vector2d& at : grid.at) {
    const Eigen::Vector3d velocity =
        at[0] * problem.pairs.front().along + at[1] * problem.pairs.front().across;
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n + 1, n + 1);
    normal.diagonal().head(n).setConstant(std::pow(problem.clock_s, -2));
    normal(n, n) = std::pow(kFlat_km, -2);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 1);
    double squares = 0.0;
    for (std::size_t p = 0; p < problem.pairs.size(); ++p) {
      const MovedPair& pair = problem.pairs[p];
      const Eigen::Vector2d per_second(pair.border_km_per_km * velocity.dot(pair.along),
                                       velocity.dot(pair.across));
      const Eigen::Vector2d off =
          Eigen::Vector2d(pair.border_km - problem.middle_km, pair.across_km) - pair.apart_s * per_second;
      // The second clock, the first one, and the height.
      Eigen::Matrix<double, 2, 3> slope;
      slope << per_second, -per_second, Eigen::Vector2d::UnitX();
      const Eigen::Index places[3] = {static_cast<Eigen::Index>(pair.second),
                                      static_cast<Eigen::Index>(pair.first), n};
      const Eigen::Matrix3d square = slope.transpose() * weights[p] * slope;
      const Eigen::Vector3d product = slope.transpose() * weights[p] * off;
      for (int i = 0; i < 3; ++i) {
        right[places[i]] += product[i];
        for (int j = 0; j < 3; ++j) normal(places[i], places[j]) += square(i, j);
      }
      squares += off.dot(weights[p] * off);
    }
    const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
    Linear found;
    found.mean = solver.solve(right);
    found.square = solver.solve(Eigen::MatrixXd::Identity(n + 1, n + 1)).diagonal();
    found.logarithm = -0.5 * (squares - right.dot(found.mean)) - 0.5 * solver.vectorD().array().log().sum();
    if (problem.drift_km_s > 0.0) found.logarithm -= 0.5 * at.squaredNorm() / std::pow(problem.drift_km_s, 2);
    all.push_back(std::move(found));
  }
  return all;
}

double most_of(const std::vector<Linear>& all) {
  double most = -HUGE_VAL;
  for (const Linear& one : all) most = std::max(most, one.logarithm);
  return most;
}

/// The velocities that are not improbable, each in four parts.
Grid closer(const Grid& grid, const std::vector<Linear>& all, double fine_km_s) {
  const double most = most_of(all), quarter = 0.25 * grid.step_km_s;
  Grid parts{0.5 * grid.step_km_s, 0.5 * grid.step_km_s <= fine_km_s, {}};
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].logarithm > most + kLeastLogarithm)
      for (const double a : {-quarter, quarter})
        for (const double b : {-quarter, quarter}) parts.at.push_back(grid.at[i] + Eigen::Vector2d(a, b));
  return parts;
}

/// The offsets and the height for all velocities that are not improbable, each with the same share of them.
/// A coarse grid is made finer where the probability is, until its steps are fine. Where that would be too
/// many velocities, steps remain wide and count as errors.
std::vector<Linear> solved_for_all(const Problem& problem) {
  if (!(problem.drift_km_s > 0.0)) return solved_on(problem, {0.0, true, {Eigen::Vector2d::Zero()}});
  // Sums over a normal curve by steps of 1.5 standard deviations are exact to a part in a thousand.
  double fine_km_s = HUGE_VAL;
  const double together = static_cast<double>(problem.pairs.size()) / problem.shared;
  for (const MovedPair& pair : problem.pairs) {
    const Eigen::Matrix2d weight = together * pair.covariance_km2.inverse();
    const double most = std::max(weight(1, 1), weight(0, 0) * std::pow(pair.border_km_per_km, 2));
    fine_km_s = std::min(fine_km_s, 1.5 / (std::sqrt(most) * longest_s(problem, pair)));
  }
  Grid grid{kReach * problem.drift_km_s / kSteps, kReach * problem.drift_km_s / kSteps <= fine_km_s, {}};
  for (int i = -kSteps; i <= kSteps; ++i)
    for (int j = -kSteps; j <= kSteps; ++j) grid.at.push_back(grid.step_km_s * Eigen::Vector2d(i, j));
  std::vector<Linear> all = solved_on(problem, grid);
  while (!grid.is_fine) {
    Grid next = closer(grid, all, fine_km_s);
    if (next.at.size() > kMostVelocities) break;
    grid = std::move(next);
    all = solved_on(problem, grid);
  }
  return all;
}

}  // namespace clock_offsets

ClockSolution::ClockSolution() : border_km(sim::kNaN), border_error_km(sim::kNaN) {}

ClockSolution clock_solution(std::size_t pictures, const std::vector<MovedPair>& pairs, double clock_error_s,
                             double drift_km_s) {
  using namespace clock_offsets;
  ClockSolution solution;
  solution.offsets.assign(pictures, ClockOffset{0.0, clock_error_s, false});
  if (pairs.empty()) return solution;
  Problem problem;
  problem.pictures = pictures;
  problem.pairs = pairs;
  problem.clock_s = std::max(clock_error_s, kLeastClock_s);
  problem.drift_km_s = drift_km_s;
  problem.shared = std::max(
      1.0, static_cast<double>(pairs.size()) / static_cast<double>(std::max<std::size_t>(1, pictures - 1)));
  for (const MovedPair& pair : pairs) problem.middle_km += pair.border_km / static_cast<double>(pairs.size());
  const std::vector<Linear> all = solved_for_all(problem);
  const double most = most_of(all);
  double sum = 0.0;
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
