// The nearest point of a cubic against dense sampling, on curves of every sort.
#include "sim/emit/sun/strand/closest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/number/random.h"

namespace vegard::sim::closest_point_test {
namespace {

using Place = std::array<double, 3>;
constexpr std::uint64_t kSeed = 20090608;

Place on_curve(const CubicBezier& c, double t) {
  const double u = 1.0 - t;
  Place at;
  for (int i = 0; i < 3; ++i)
    at[i] = u * u * u * c[0][i] + 3 * u * u * t * c[1][i] + 3 * u * t * t * c[2][i] + t * t * t * c[3][i];
  return at;
}

double distance(const CubicBezier& c, double t, const Place& p) {
  const Place at = on_curve(c, t);
  return std::sqrt((at[0] - p[0]) * (at[0] - p[0]) + (at[1] - p[1]) * (at[1] - p[1]) +
                   (at[2] - p[2]) * (at[2] - p[2]));
}

/// In a cube of edge 1; number `which` of the places of case n.
Place random_place(std::uint32_t n, std::uint32_t which) {
  const Words w = random_words(kSeed, Stream::strand, n, which);
  return {uniform(w[0]), uniform(w[1]), uniform(w[2])};
}

/// Every sort in its turn; most are not special.
CubicBezier random_curve(std::uint32_t n) {
  CubicBezier c;
  for (std::uint32_t p = 0; p < 4; ++p) c[p] = random_place(n, p);
  const auto on_line = [&](int p, double s) {
    for (int i = 0; i < 3; ++i) c[p][i] = c[0][i] + s * (c[3][i] - c[0][i]);
  };
  switch (n % 16) {
    case 0:  // straight
      on_line(1, 1.0 / 3.0);
      on_line(2, 2.0 / 3.0);
      break;
    case 1:  // on one line, to and fro beyond its ends
      on_line(1, 1.7);
      on_line(2, -0.8);
      break;
    case 2:  // a point
      c[1] = c[2] = c[3] = c[0];
      break;
    case 3:  // a cusp: it stands still at 1/2, where P3 + P2 = P1 + P0
      for (int i = 0; i < 3; ++i) c[3][i] = c[0][i] + c[1][i] - c[2][i];
      break;
    case 4:  // closed
      c[3] = c[0];
      break;
    case 5:  // control points that coincide with the ends
      c[1] = c[0];
      c[2] = c[3];
      break;
    case 6:  // in a plane, with the place in it as well as not
      for (Place& p : c) p[2] = 0.5;
      break;
    default:
      break;
  }
  return c;
}

/// The least of 48 samples, refined about every sample that is nearer than its neighbours: an upper bound of
/// the distance, whatever it misses.
double by_sampling(const CubicBezier& c, const Place& p) {
  constexpr int kSamples = 48;
  std::array<double, kSamples + 1> d;
  for (int i = 0; i <= kSamples; ++i) d[i] = distance(c, static_cast<double>(i) / kSamples, p);
  double best = d[0];
  for (int i = 0; i <= kSamples; ++i) {
    best = std::min(best, d[i]);
    if ((i > 0 && d[i - 1] < d[i]) || (i < kSamples && d[i + 1] < d[i]) || d[i] > best + 0.1) continue;
    double low = std::max(0.0, (i - 1.0) / kSamples), high = std::min(1.0, (i + 1.0) / kSamples);
    for (int step = 0; step < 22; ++step) {
      const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
      const double of_a = distance(c, a, p), of_b = distance(c, b, p);
      best = std::min({best, of_a, of_b});
      (of_a < of_b ? high : low) = of_a < of_b ? b : a;
    }
  }
  return best;
}

TEST(ClosestPoint, IsNeverFartherThanDenseSamplingFinds) {
  for (std::uint32_t n = 0; n < 100000; ++n) {
    const CubicBezier curve = random_curve(n);
    const Place place = n % 7 == 0 ? on_curve(curve, random_place(n, 5)[0]) : random_place(n, 4);
    const ClosestPoint found = closest_point(curve, place);
    ASSERT_GE(found.t, 0.0);
    ASSERT_LE(found.t, 1.0);
    ASSERT_NEAR(found.distance, distance(curve, found.t, place), 1e-14) << n;
    // Squares are known to 4e-15 of a size of at most 9, which is 2e-7 of a distance near 0.
    const double sampled = by_sampling(curve, place);
    ASSERT_LE(found.distance * found.distance, sampled * sampled + 4e-14) << "curve " << n;
  }
}

TEST(ClosestPoint, OfPlacesOnTheCurveIsThere) {
  for (std::uint32_t n = 7; n < 2000; n += 16) {
    const CubicBezier curve = random_curve(n);
    EXPECT_LT(closest_point(curve, on_curve(curve, 0.37)).distance, 2e-7);
  }
}

TEST(ClosestPoint, OfTwoAsNearIsTheFirst) {
  // A hairpin, seen from its axis: both legs are as near.
  const CubicBezier hairpin{{{0.0, -1.0, 0.0}, {4.0, -1.0, 0.0}, {4.0, 1.0, 0.0}, {0.0, 1.0, 0.0}}};
  const ClosestPoint found = closest_point(hairpin, {0.5, 0.0, 0.0});
  EXPECT_LT(found.t, 0.5);
  EXPECT_NEAR(found.distance, distance(hairpin, 1.0 - found.t, {0.5, 0.0, 0.0}), 1e-12);
}

TEST(ClosestPoint, OfAStraightCurveIsTheFootOfThePerpendicular) {
  const CubicBezier line{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {3.0, 0.0, 0.0}}};
  EXPECT_NEAR(closest_point(line, {1.2, 0.5, 0.0}).t, 0.4, 1e-12);
  EXPECT_NEAR(closest_point(line, {1.2, 0.5, 0.0}).distance, 0.5, 1e-15);
  EXPECT_EQ(closest_point(line, {-1.0, 0.0, 2.0}).t, 0.0);
  EXPECT_EQ(closest_point(line, {5.0, 0.0, 0.0}).t, 1.0);
}

TEST(ClosestPoint, OfAChainIsThatOfItsNearestPiece) {
  const std::vector<Place> chain{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {3, 2, 0}, {3, 3, 0}};
  const ClosestPoint found = closest_point(chain, {4.0, 1.5, 0.0});
  EXPECT_NEAR(found.t, 0.75, 1e-12);
  EXPECT_NEAR(found.distance, 1.0, 1e-15);
  EXPECT_NEAR(closest_point(chain, {0.6, -1.0, 0.0}).t, 0.1, 1e-12);
}

/// The source's search: the nearest of 15 places of a curve, then of 15 between its two neighbours, and
/// again.
double by_three_splits_of_14(const CubicBezier& c, const Place& p) {
  double low = 0.0, high = 1.0, best = 0.0;
  for (int level = 0; level < 3; ++level) {
    const double step = (high - low) / 14.0;
    int nearest = 0;
    best = distance(c, low, p);
    for (int i = 1; i <= 14; ++i) {
      const double d = distance(c, low + i * step, p);
      if (d < best) {
        best = d;
        nearest = i;
      }
    }
    const double middle = low + nearest * step;
    low = std::max(0.0, middle - step);
    high = std::min(1.0, middle + step);
  }
  return best;
}

TEST(ClosestPoint, IsWhatTheSourcesSearchMissesNowAndThen) {
  // Curves and places in 300^3 voxels. A search that stays in the right minimum is off by hundredths of
  // a voxel at most; a wrong one shows as more than a twentieth.
  constexpr int kCases = 40000;
  int wrong = 0;
  double worst = 0.0;
  for (std::uint32_t n = 0; n < kCases; ++n) {
    const CubicBezier curve = random_curve(16 * n + 8);
    const Place place = random_place(16 * n + 8, 4);
    const double more = 300.0 * (by_three_splits_of_14(curve, place) - closest_point(curve, place).distance);
    EXPECT_GT(more, -1e-4);
    worst = std::max(worst, more);
    if (more > 0.05) ++wrong;
  }
  RecordProperty("wrong", wrong);
  RecordProperty("worst_voxels", static_cast<int>(worst));
  // About one in a thousand: between a third of that and three times it.
  EXPECT_GT(wrong, kCases / 3000);
  EXPECT_LT(wrong, 3 * kCases / 1000);
}

}  // namespace
}  // namespace vegard::sim::closest_point_test
