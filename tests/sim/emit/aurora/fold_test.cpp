#include "sim/emit/aurora/sheet_structures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace vegard::sim::fold_test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kCenter = 14.0;  // of the fold of the tests, on the sine's flank
constexpr double kHalf = 4.0;

LayerSine<double> sine_at(double x_km) {
  const double wave_number = 2.0 * kPi / 60.0;
  return {3.0, wave_number, 0.4 + wave_number * x_km};
}

Fold fold_at(double x_km) {
  Fold fold;
  fold.from_center_km = x_km - kCenter;
  fold.half_km = kHalf;
  fold.here = std::abs(fold.from_center_km) < kHalf;
  fold.stage = 1.0;
  return fold;
}

/// The curve's point that belongs to a place, in coordinates of the sheet.
CurvePoint<double> curve(double x_km, double stage) {
  CurvePoint<double> point = folded_curve(sine_at(x_km), fold_at(x_km), stage, 0.0);
  point.x_km += x_km;
  return point;
}

struct Vector {
  double x, y;
};
Vector slope(double x_km, double stage, double h) {
  const CurvePoint<double> a = curve(x_km, stage), b = curve(x_km + h, stage);
  return {(b.x_km - a.x_km) / h, (b.aside_km - a.aside_km) / h};
}

TEST(Fold, JoinsTheSineAndItsOwnHalvesWithoutAKink) {
  constexpr double h = 1e-6;
  for (double stage : {0.0, 0.3, 0.6, 1.0})
    for (double x : {kCenter - kHalf, kCenter, kCenter + kHalf}) {
      const CurvePoint<double> left = curve(x - h, stage), right = curve(x + h, stage);
      EXPECT_NEAR(left.x_km, right.x_km, 1e-4);
      EXPECT_NEAR(left.aside_km, right.aside_km, 1e-4);
      EXPECT_NEAR(left.turn_cos, right.turn_cos, 1e-4);
      EXPECT_NEAR(left.turn_sin, right.turn_sin, 1e-4);
      const Vector before = slope(x - h, stage, -h), after = slope(x + h, stage, h);
      EXPECT_NEAR(before.x, after.x, 1e-4) << stage << " " << x;
      EXPECT_NEAR(before.y, after.y, 1e-4) << stage << " " << x;
    }
}

TEST(Fold, LeavesTheSineOutsideUntouched) {
  for (double x : {kCenter - kHalf - 1e-9, kCenter + kHalf + 1e-9, 30.0}) {
    const CurvePoint<double> point = curve(x, 1.0);
    EXPECT_EQ(point.x_km, x);
    EXPECT_EQ(point.aside_km, sine_at(x).aside(0.0));
    EXPECT_EQ(point.turn_cos, 1.0);
    EXPECT_EQ(point.turn_sin, 0.0);
  }
}

TEST(Fold, AtStageZeroIsTheSineWithinAMetre) {
  // Cubic Hermite interpolation over a length l departs by no more than l⁴/384 of the fourth derivative: here
  // 4⁴/384 · 3 (2π/60)⁴ = 0.24 m.
  for (double x = kCenter - kHalf; x < kCenter + kHalf; x += 0.01) {
    const CurvePoint<double> point = curve(x, 0.0);
    EXPECT_NEAR(point.x_km, x, 1e-12);
    EXPECT_NEAR(point.aside_km, sine_at(x).aside(0.0), 2.5e-4);
  }
}

double min_advance(double stage) {
  double least = 1.0;
  for (double x = kCenter - kHalf; x < kCenter + kHalf; x += 0.01)
    least = std::min(least, slope(x, stage, 1e-6).x);
  return least;
}

TEST(Fold, RipplesThenOverhangs) {
  EXPECT_NEAR(min_advance(0.0), 1.0, 1e-6);
  EXPECT_GT(min_advance(0.25), 0.0);
  EXPECT_LT(min_advance(0.6), 0.0);
  EXPECT_LT(min_advance(1.0), min_advance(0.6));
}

TEST(Fold, TurnsItsMiddleByMoreThan150DegreesClockwiseSeenFromAbove) {
  double before = 0.0;
  for (double stage = 0.0; stage <= 1.0; stage += 0.125) {
    const CurvePoint<double> middle = curve(kCenter, stage);
    const double turned = -std::atan2(middle.turn_sin, middle.turn_cos) * 180.0 / kPi;
    if (stage > 0.0) {
      EXPECT_GT(turned, before);
    }
    before = turned;
  }
  EXPECT_GT(before, 150.0);
  EXPECT_LT(before, 180.0);
}

TEST(Fold, DoesNotCrossItself) {
  std::vector<Vector> points;
  for (double x = kCenter - kHalf - 3.0; x < kCenter + kHalf + 3.0; x += 0.05) {
    const CurvePoint<double> point = curve(x, 1.0);
    points.push_back({point.x_km, point.aside_km});
  }
  const auto side = [](Vector a, Vector b, Vector p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  };
  int crossings = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    for (std::size_t j = i + 2; j + 1 < points.size(); ++j)
      crossings +=
          side(points[i], points[i + 1], points[j]) * side(points[i], points[i + 1], points[j + 1]) < 0.0 &&
          side(points[j], points[j + 1], points[i]) * side(points[j], points[j + 1], points[i + 1]) < 0.0;
  EXPECT_EQ(crossings, 0);
}

// By stage 1 the bends are round: over the middle four fifths of a bend's turn (from 10 to 90 % of 155
// degrees) the radius of curvature on a straight sheet goes from a sixth of half the stretch to less than 0.9
// of it. A cusp, as two cubics made it, has a radius of hundredths there.
TEST(Fold, HasRoundHorseshoeBends) {
  const auto place = [](double x) {
    Fold fold;
    fold.from_center_km = x;
    fold.half_km = 1.0;
    fold.here = std::abs(x) < 1.0;
    fold.stage = 1.0;
    CurvePoint<double> p = folded_curve(LayerSine<double>{0.0, 0.1, 0.0}, fold, 1.0, 0.0);
    return Vector{p.x_km + x, p.aside_km};
  };
  constexpr double h = 1e-3;
  double turned = 0.0, tightest = 1e9, widest = 0.0;
  std::vector<std::pair<double, double>> bends;  // turn so far, radius
  for (double x = h; x < 1.0 - 2.0 * h; x += h) {
    const Vector a = place(x - h), b = place(x), c = place(x + h);
    const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - b.x, vy = c.y - b.y;
    const double angle = std::atan2(ux * vy - uy * vx, ux * vx + uy * vy);
    const double length = 0.5 * (std::hypot(ux, uy) + std::hypot(vx, vy));
    turned += std::max(0.0, angle);
    if (angle > 1e-9) bends.emplace_back(turned, length / angle);
    if (std::abs(angle) > 1e-9) tightest = std::min(tightest, length / std::abs(angle));
  }
  double least = 1e9;
  for (const auto& [so_far, radius] : bends)
    if (so_far > 0.1 * turned && so_far < 0.9 * turned) {
      least = std::min(least, radius);
      widest = std::max(widest, radius);
    }
  EXPECT_GT(least, 0.16);
  EXPECT_LT(widest, 0.9);
  EXPECT_GT(tightest, 0.05);
}

Sheet folded_sheet() {
  Sheet sheet;
  sheet.fold_spacing_km = 20.0;
  sheet.fold_length_km = 8.0;
  sheet.fold_spacing_jitter = 1.0;
  return sheet;
}

struct Stretch {
  double center, from, to;
};

/// The folds between two places along the sheet, found as a beam finds them.
std::vector<Stretch> folds_between(const Folds& folds, double first, double last) {
  std::vector<Stretch> found;
  for (double a = first; a < last; a += 0.25) {
    const Fold fold = folds.at(a);
    if (!fold.here) continue;
    const double center = a - fold.from_center_km;
    if (found.empty() || std::abs(found.back().center - center) > 1e-6)
      found.push_back({center, center - fold.half_km, center + fold.half_km});
  }
  return found;
}

TEST(Folds, AreQuasiPeriodicAndNeverOverlap) {
  const Sheet sheet = folded_sheet();
  const std::vector<Stretch> found = folds_between(Folds(sheet, 0, 11, 0.0, 0.0), -10000.0, 10000.0);
  ASSERT_NEAR(found.size(), 1000u, 2);
  double square = 0.0;
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_GE(found[i].from, found[i - 1].to - 1e-9);
    const double distance = found[i].center - found[i - 1].center;
    square += (distance - 20.0) * (distance - 20.0) / found.size();
  }
  EXPECT_NEAR((found.back().center - found.front().center) / (found.size() - 1), 20.0, 0.03);
  // The difference of two uniform shifts over 12 km: a variance of 24. Its standard error is about 1;
  // seed 11.
  EXPECT_NEAR(square, 24.0, 4.0);
  Sheet even = sheet;
  even.fold_spacing_jitter = 0.0;
  for (const Stretch& fold : folds_between(Folds(even, 0, 11, 0.0, 0.0), -100.0, 100.0))
    EXPECT_NEAR(std::remainder(fold.center - 10.0, 20.0), 0.0, 1e-9);
}

TEST(Folds, HaveStagesThatDoNotHangOnTheirPlaces) {
  Sheet sheet = folded_sheet();
  sheet.fold_stage_spread = 0.6;
  const Folds folds(sheet, 0, 11, 0.0, 0.0);
  const std::vector<Stretch> found = folds_between(folds, -10000.0, 10000.0);
  double of_place = 0.0, of_stage = 0.0, of_both = 0.0;
  for (const Stretch& stretch : found) {
    // Uniform in both: about the middle of the slot of 20 km, and about 1 less half of the spread.
    const double place = std::remainder(stretch.center - 10.0, 20.0);
    const double stage = folds.at(stretch.center).stage - 0.7;
    EXPECT_LE(std::abs(stage), 0.3 + 1e-12);
    of_place += place * place;
    of_stage += stage * stage;
    of_both += place * stage;
  }
  EXPECT_NEAR(of_stage / static_cast<double>(found.size()), 0.6 * 0.6 / 12.0, 0.003);
  EXPECT_NEAR(of_both / std::sqrt(of_place * of_stage), 0.0, 4.0 / std::sqrt(1000.0)) << "seed 11";
}

TEST(Folds, TravelAtTheirSpeedAndWithTheSheet) {
  Sheet sheet = folded_sheet();
  sheet.fold_speed_km_s = 2.5;
  const Folds before(sheet, 0, 11, 0.0, 0.0), after(sheet, 0, 11, 4.0, 3.0);
  for (double a = 0.0; a < 100.0; a += 0.7) {
    EXPECT_NEAR(after.at(a + 13.0).from_center_km, before.at(a).from_center_km, 1e-9);
    EXPECT_EQ(after.at(a + 13.0).stage, before.at(a).stage);
  }
}

TEST(Folds, AreBornAndDieWithoutAJump) {
  // Long folds on a short sine: at stage 0 they depart from it by 100 m, which would show when they are born.
  Sheet sheet = folded_sheet();
  sheet.fold_length_km = 18.0;
  sheet.fold_lifetime_s = 3.0;
  const LayerSine<double> sine{3.0, 2.0 * kPi / 30.0, 0.7};
  constexpr double step_s = 1e-3;
  double moved = 0.0;
  for (double a : {3.0, 9.0, 11.0, 27.0, 30.0}) {
    const auto at = [&](double t) { return folded_curve(sine, Folds(sheet, 0, 11, t, 0.0).at(a), 1.0, 0.0); };
    CurvePoint<double> before = at(0.0);
    for (double t = step_s; t < 9.0; t += step_s) {
      const CurvePoint<double> now = at(t);
      // Some 10 km/s at most.
      EXPECT_NEAR(now.x_km, before.x_km, 0.02) << t;
      EXPECT_NEAR(now.aside_km, before.aside_km, 0.02) << t;
      moved = std::max(moved, std::abs(now.x_km));
      before = now;
    }
  }
  EXPECT_GT(moved, 0.5);
  // Another generation, another stage.
  EXPECT_NE(Folds(sheet, 0, 11, 1.0, 0.0).at(10.0).stage, Folds(sheet, 0, 11, 4.0, 0.0).at(10.0).stage);
}

}  // namespace
}  // namespace vegard::sim::fold_test
