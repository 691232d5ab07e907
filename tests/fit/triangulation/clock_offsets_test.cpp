#include "fit/triangulation/clock_offsets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sim/base/number/constants.h"

namespace vegard::fit::clock_offsets_test {
namespace {

/// What pictures of one border say, whose light drifts and whose clocks are off.
struct Truth {
  double border_km = 105.0;
  Eigen::Vector3d velocity_km_s = Eigen::Vector3d::Zero();
  std::vector<double> told_s, offset_s;  ///< the clocks' times, and what is to be added to them
};

MovedPair seen(const Truth& truth, std::size_t first, std::size_t second, double base_deg,
               std::mt19937_64& random, double across_error_km = 0.5) {
  std::normal_distribution<double> normal;
  MovedPair pair;
  pair.first = first;
  pair.second = second;
  pair.apart_s = truth.told_s[second] - truth.told_s[first];
  const double turn = base_deg * sim::kRadiansPerDegree;
  pair.along = {std::sin(turn), std::cos(turn), 0.0};
  pair.across = {-std::cos(turn), std::sin(turn), 0.0};
  pair.border_km_per_km = 1.1;
  const double border_error_km = 2.0 * across_error_km;
  pair.covariance_km2 =
      Eigen::Vector2d(border_error_km * border_error_km, across_error_km * across_error_km).asDiagonal();
  const double apart_s = pair.apart_s + truth.offset_s[second] - truth.offset_s[first];
  const Eigen::Vector3d moved = apart_s * truth.velocity_km_s;
  pair.border_km =
      truth.border_km + pair.border_km_per_km * moved.dot(pair.along) + border_error_km * normal(random);
  pair.across_km = moved.dot(pair.across) + across_error_km * normal(random);
  return pair;
}

Truth chance_truth(std::mt19937_64& random, std::vector<double> told_s, double clock_s, double drift_km_s) {
  std::normal_distribution<double> normal;
  Truth truth;
  truth.told_s = std::move(told_s);
  for (std::size_t i = 0; i < truth.told_s.size(); ++i) truth.offset_s.push_back(clock_s * normal(random));
  truth.velocity_km_s = {drift_km_s * normal(random), drift_km_s * normal(random), 0.0};
  return truth;
}

struct Held {
  int first_offsets = 0, offsets = 0, heights = 0;
};

struct Case {
  double drift_km_s, clock_s, apart_s, across_error_km;
};

/// How many standard errors hold the truth, by two independent pairs of three pictures.
Held held_of(int trials, const Case& made) {
  std::mt19937_64 random(47);
  Held held;
  for (int trial = 0; trial < trials; ++trial) {
    const Truth truth =
        chance_truth(random, {0.0, made.apart_s, 0.5 * made.apart_s}, made.clock_s, made.drift_km_s);
    const std::vector<MovedPair> pairs = {seen(truth, 0, 1, 90.0, random, made.across_error_km),
                                          seen(truth, 0, 2, 20.0, random, made.across_error_km)};
    const ClockSolution found = clock_solution(3, pairs, made.clock_s, made.drift_km_s);
    held.first_offsets += std::abs(found.offsets[0].s - truth.offset_s[0]) < found.offsets[0].error_s;
    held.offsets += std::abs(found.offsets[1].s - truth.offset_s[1]) < found.offsets[1].error_s;
    held.heights += std::abs(found.border_km - truth.border_km) < found.border_error_km;
  }
  return held;
}

// Seed 47. Of 100 draws with a probability of 68.3 % the share has a standard error of 4.7 % (binomial
// distribution); three of these are allowed. In the later cases the pairs tell the velocity a hundred times
// and more better than it is known before.
TEST(ClockOffsets, ErrorsHoldOffsetsAndHeight) {
  constexpr int kTrials = 100;
  for (const Case& made :
       {Case{0.5, 1.0, 10.0, 0.5}, Case{5.0, 0.05, 60.0, 0.3}, Case{0.5, 0.1, 60.0, 0.1}}) {
    const Held held = held_of(kTrials, made);
    for (const int count : {held.first_offsets, held.offsets, held.heights}) {
      EXPECT_GT(count, 0.54 * kTrials) << made.drift_km_s << " km/s, " << made.clock_s << " s";
      EXPECT_LT(count, 0.82 * kTrials) << made.drift_km_s << " km/s, " << made.clock_s << " s";
    }
  }
}

// Of so many velocities not all are looked at, and what is left out counts as an error: more may hold than
// 68.3 %, not fewer. Of 30 draws the share has a standard error of 8.5 %.
TEST(ClockOffsets, ErrorsAreNotTooSmallWhereTheDriftMayBeAnything) {
  constexpr int kTrials = 30;
  const Held held = held_of(kTrials, {100.0, 2.0, 10.0, 0.1});
  for (const int count : {held.first_offsets, held.offsets, held.heights}) EXPECT_GT(count, 0.43 * kTrials);
}

TEST(ClockOffsets, AreFoundWhereTheDriftIsKnown) {
  // Three pictures far apart in time tell the velocity; the last one's clock is 20 s late, its error 20 s.
  Truth truth;
  truth.told_s = {0.0, 40.0, 20.0};
  truth.offset_s = {0.0, 0.0, 20.0};
  truth.velocity_km_s = {0.3, 0.6, 0.0};
  std::mt19937_64 random(3);
  std::vector<MovedPair> pairs;
  for (const double base_deg : {0.0, 45.0, 90.0, 135.0})
    for (const auto& [first, second] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}})
      pairs.push_back(seen(truth, first, second, base_deg, random));
  const ClockSolution found = clock_solution(3, pairs, 5.0, 0.5);
  EXPECT_TRUE(found.offsets[2].is_told);
  const double apart_s = found.offsets[2].s - 0.5 * (found.offsets[0].s + found.offsets[1].s);
  EXPECT_NEAR(apart_s, 20.0, 3.0 * std::hypot(found.offsets[2].error_s, found.offsets[0].error_s));
  EXPECT_GT(apart_s, 5.0);
}

TEST(ClockOffsets, RemainUnknownWhereTheLightSaysNothing) {
  std::mt19937_64 random(5);
  Truth truth;
  truth.told_s = {0.0, 0.0};
  truth.offset_s = {0.0, 0.0};
  MovedPair pair = seen(truth, 0, 1, 0.0, random);
  pair.covariance_km2 *= 1e4;
  const ClockSolution found = clock_solution(2, {pair}, 2.0, 0.5);
  for (const ClockOffset& clock : found.offsets) {
    EXPECT_FALSE(clock.is_told);
    EXPECT_NEAR(clock.error_s, 2.0, 0.1);
  }
  EXPECT_TRUE(std::isnan(clock_solution(2, {}, 2.0, 0.5).border_km));
}

TEST(ClockOffsets, WidenTheHeightByTheDrift) {
  // Exact clocks, 15 s apart: the light moves by 0.5 km/s · 15 s along the base, 1.1 km of height for each.
  MovedPair pair;
  pair.second = 1;
  pair.apart_s = 15.0;
  pair.border_km = 105.0;
  pair.border_km_per_km = 1.1;
  pair.covariance_km2 = Eigen::Vector2d(1.0, 1.0).asDiagonal();
  pair.along = Eigen::Vector3d::UnitX();
  pair.across = Eigen::Vector3d::UnitY();
  const ClockSolution found = clock_solution(2, {pair}, 0.0, 0.5);
  EXPECT_NEAR(found.border_error_km, std::hypot(1.0, 1.1 * 7.5), 0.05);
  EXPECT_NEAR(found.border_km, 105.0, 1e-6);
}

}  // namespace
}  // namespace vegard::fit::clock_offsets_test
