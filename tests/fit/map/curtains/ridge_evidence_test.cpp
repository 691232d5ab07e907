#include "fit/map/curtains/ridge_evidence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace vegard::fit::ridge_evidence_test {
namespace {

constexpr double kResolution_km = 10.0;

double resolution(sim::EastNorth) { return kResolution_km; }

/// A straight line of points every 5 km.
RidgeLine line(sim::EastNorth from, double direction_deg, double length_km) {
  const double a = direction_deg * 3.141592653589793 / 180.0;
  RidgeLine points;
  for (double t = 0.0; t <= length_km; t += 5.0)
    points.push_back({from.east + t * std::sin(a), from.north + t * std::cos(a)});
  return points;
}

TEST(JoinedLines, GoOnInOneCourse) {
  // Three pieces of one line, with gaps of 15 and 25 km, in any order and direction.
  RidgeLine second = line({115.0, 200.0}, 90.0, 80.0);
  std::reverse(second.begin(), second.end());
  const std::vector<RidgeLine> joined =
      joined_lines({second, line({0.0, 200.0}, 90.0, 100.0), line({220.0, 200.0}, 90.0, 60.0)}, resolution);
  ASSERT_EQ(joined.size(), 1u);
  EXPECT_EQ(joined[0].size(), 17u + 21u + 13u);
  const double ends = std::abs(joined[0].back().east - joined[0].front().east);
  EXPECT_NEAR(ends, 280.0, 1e-9);
}

TEST(JoinedLines, AreNotBesideEachOther) {
  // Two lines 20 km apart, one behind the other's end: the way from end to end is across.
  EXPECT_EQ(
      joined_lines({line({0.0, 200.0}, 90.0, 100.0), line({105.0, 220.0}, 90.0, 100.0)}, resolution).size(),
      2u);
}

TEST(JoinedLines, EndWhereACornerIs) {
  EXPECT_EQ(
      joined_lines({line({0.0, 200.0}, 90.0, 100.0), line({105.0, 205.0}, 0.0, 100.0)}, resolution).size(),
      2u);
}

TEST(JoinedLines, EndWhereTheGapIsLong) {
  // A gap of 4 resolutions between lines of 60 km.
  EXPECT_EQ(
      joined_lines({line({0.0, 200.0}, 90.0, 60.0), line({100.0, 200.0}, 90.0, 60.0)}, resolution).size(),
      2u);
}

RidgeLine with_hook(RidgeLine hook, const RidgeLine& course) {
  hook.insert(hook.end(), course.begin(), course.end());
  return hook;
}

TEST(EndsAlongSight, AreCutIfTheyAreNotResolved) {
  // An arc 250 km in the north, and hooks of 25 km along the line of sight at both of its ends.
  const RidgeLine arc = line({-60.0, 250.0}, 90.0, 120.0);
  RidgeLine both = with_hook(line({-66.0, 275.0}, 166.5, 22.0), arc);
  const RidgeLine end = line({61.0, 254.0}, 13.5, 20.0);
  both.insert(both.end(), end.begin(), end.end());
  const auto forty = [](sim::EastNorth) { return 40.0; };
  const RidgeLine cut = without_ends_along_sight(both, forty);
  ASSERT_GE(cut.size(), arc.size() - 2);
  for (const sim::EastNorth& p : cut) EXPECT_LT(p.north, 258.0);
  EXPECT_LT(cut.front().east, -55.0);
  EXPECT_GT(cut.back().east, 55.0);
  // What is longer than the resolution is evidence.
  const auto fifteen = [](sim::EastNorth) { return 15.0; };
  EXPECT_EQ(without_ends_along_sight(both, fifteen).size(), both.size());
}

TEST(EndsAlongSight, OfAStraightArcStay) {
  // Its last 15 km are more along the line of sight than across.
  const RidgeLine arc = line({-50.0, 100.0}, 90.0, 165.0);
  EXPECT_EQ(without_ends_along_sight(arc, [](sim::EastNorth) { return 40.0; }).size(), arc.size());
}

TEST(EndsAlongSight, AloneAreNoRidge) {
  const RidgeLine alone = line({0.0, 250.0}, 0.0, 30.0);
  EXPECT_TRUE(without_ends_along_sight(alone, [](sim::EastNorth) { return 40.0; }).empty());
  EXPECT_EQ(without_ends_along_sight(alone, [](sim::EastNorth) { return 20.0; }).size(), alone.size());
}

TEST(RidgeProbability, IsSmallForWhatChanceMakes) {
  // The candidate is the highest of as many chance ridges as there are places, as a search makes it (seed 3).
  // Their probability of being no chance is then uniform: above 0.95 in one of twenty, and of 200 in fewer
  // than 21 with probability 0.999.
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.3, 1.0);
  constexpr int kPoints = 12, kPlaces = 40, kMaps = 8;
  int sure = 0;
  for (int trial = 0; trial < 200; ++trial) {
    double best = -1e9;
    for (int place = 0; place < kPlaces; ++place) {
      double mean = 0.0;
      for (int i = 0; i < kPoints; ++i) mean += normal(random) / kPoints;
      best = std::max(best, mean);
    }
    std::vector<std::vector<double>> nulls(kMaps);
    for (std::vector<double>& map : nulls)
      for (int i = 0; i < kPoints; ++i) map.push_back(normal(random));
    sure += ridge_probability(best, nulls, kPoints, kPlaces) >= 0.95;
  }
  EXPECT_LT(sure, 21);
}

TEST(RidgeProbability, IsNearOneForWhatRisesAboveIt) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<std::vector<double>> nulls(4);
  for (std::vector<double>& map : nulls)
    for (int i = 0; i < 20; ++i) map.push_back(normal(random));
  // Five standard deviations of the mean of five pieces, at 19 degrees of freedom.
  EXPECT_GT(ridge_probability(5.0, nulls, 5.0, 10.0), 0.95);
  EXPECT_LT(ridge_probability(0.5, nulls, 5.0, 10.0), 0.5);
  EXPECT_TRUE(std::isnan(ridge_probability(5.0, {}, 5.0, 10.0)));
}

TEST(DiffusePatch, IsWideAndNotLong) {
  EXPECT_TRUE(is_diffuse_patch(60.0, 120.0, kResolution_km));
  EXPECT_FALSE(is_diffuse_patch(60.0, 400.0, kResolution_km));  // a wide arc
  EXPECT_FALSE(is_diffuse_patch(12.0, 32.0, kResolution_km));   // not resolved
}

}  // namespace
}  // namespace vegard::fit::ridge_evidence_test
