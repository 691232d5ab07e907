// The falling beams over double, instantiated for the instruction set that this file is compiled for.
#include "sim/emit/aurora/fall-inl.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/earth.h"
#include "sim/emit/aurora/beam.h"

namespace vegard::sim {
namespace {

using Beams = HWY_NAMESPACE::FallingBeams<double, double, double>;
using Point = HWY_NAMESPACE::FallenPoint<double, double>;

struct Falls {
  double mean_points = 0.0, deviation_of_points = 0.0;
  double spread_km = 0.0;  ///< RMS, in both directions together, of the lowest point
  double mean_light = 0.0, deviation_of_light = 0.0;  ///< of the path that the points above the end stand for
};

Falls fall(PitchLaw law, int beams, double path_step = 1.0 / 300.0) {
  constexpr double kLengthKm = 200.0;
  const FallFrame<double> frame = fall_frame<double>(90.0 * kRadiansPerDegree, 0.0);
  Deflection<double> deflection;
  deflection.law = law;
  deflection.loss_cone_rad = 2.5 * kRadiansPerDegree;
  deflection.pitch_step_rad = 0.015;
  deflection.path_step = path_step;
  HWY_NAMESPACE::PhiloxKeys keys;
  HWY_NAMESPACE::philox_keys(12, keys);
  Falls result;
  double points2 = 0.0, spread2 = 0.0, light2 = 0.0;
  for (int b = 0; b < beams; ++b) {
    Beams beam;
    const double start[3] = {3.0, -5.0, 300.0};
    beam.start(start, kLengthKm, static_cast<std::uint32_t>(b), 0, keys);
    int points = 0;
    double aside2 = 0.0, light = 0.0;
    for (bool falls = true; falls;) {
      Point two[2];
      beam.next_two(frame, deflection, keys, two);
      for (const Point& point : two) {
        falls = falls && point.t <= 1.0;
        if (!falls) break;
        ++points;
        light += point.stretch_km;
        aside2 = std::pow(point.position_in_enu_km[0] - start[0], 2) +
                 std::pow(point.position_in_enu_km[1] - start[1], 2);
      }
    }
    result.mean_points += static_cast<double>(points) / beams;
    points2 += static_cast<double>(points) * points / beams;
    spread2 += aside2 / beams;
    result.mean_light += light / beams;
    light2 += light * light / beams;
  }
  result.deviation_of_points = std::sqrt(points2 - result.mean_points * result.mean_points);
  result.deviation_of_light = std::sqrt(light2 - result.mean_light * result.mean_light);
  result.spread_km = std::sqrt(spread2);
  return result;
}

TEST(FallingBeams, AreDeflectedSixHundredTimesGiveOrTakeFourteen) {
  // Renewals with uniform steps of at most 1/300 (docs/physics.md row B12): mean 600 - 1/3, deviation 14.1.
  // Seed 12, 4000 beams: four standard errors are 0.9 and 0.63.
  const Falls falls = fall(PitchLaw::reduced, 4000);
  EXPECT_NEAR(falls.mean_points, 600.0 - 1.0 / 3.0, 0.9);
  EXPECT_NEAR(falls.deviation_of_points, 14.14, 0.63);
  EXPECT_NEAR(fall(PitchLaw::reduced, 1000, 1.0 / 150.0).mean_points, 300.0 - 1.0 / 3.0, 1.3);
}

TEST(FallingBeams, SpreadByTheReadingOfEquationFour) {
  // docs/physics.md row B14: 200 km, 2.5 degrees, 0.015 rad, d_t = 1/300. r^2 is exponentially distributed,
  // so that the RMS of 4000 beams has a standard error of 0.8 %; four of them, and the figures' own rounding.
  const auto expect_metres = [](PitchLaw law, double metres, double rounding) {
    EXPECT_NEAR(1000.0 * fall(law, 4000).spread_km, metres, 0.032 * metres + rounding);
  };
  expect_metres(PitchLaw::product, 3.6, 0.05);
  expect_metres(PitchLaw::increment, 82.0, 0.5);
  expect_metres(PitchLaw::reduced, 342.0, 0.5);
  expect_metres(PitchLaw::constant, 411.0, 0.5);
}

TEST(FallingBeams, PointsStandForTheWholePath) {
  // Half a first step is missing at the top, and the last point on the path stands for half of the gap that
  // holds the end: the mean is the length less a quarter of the largest step, plus what the end's longer gap
  // adds (its mean is 2/3 of the largest step, half of it before the point, half of that shared).
  const Falls falls = fall(PitchLaw::constant, 4000);
  EXPECT_NEAR(falls.mean_light, 200.0, 0.3 * 200.0 / 300.0);
  EXPECT_LT(falls.deviation_of_light, 0.5 * 200.0 / 300.0);
}

TEST(FallingBeams, AZeroPitchFallsStraight) {
  const FallFrame<double> frame = fall_frame<double>(70.0 * kRadiansPerDegree, 0.3);
  Deflection<double> deflection;
  deflection.law = PitchLaw::constant;
  deflection.loss_cone_rad = deflection.pitch_step_rad = 0.0;
  deflection.path_step = 0.01;
  HWY_NAMESPACE::PhiloxKeys keys;
  HWY_NAMESPACE::philox_keys(12, keys);
  Beams beam;
  const double start[3] = {1.0, 2.0, 300.0};
  beam.start(start, 150.0, 4, 2, keys);
  for (int n = 0; n < 20; ++n) {
    Point two[2];
    beam.next_two(frame, deflection, keys, two);
    for (const Point& p : two)
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(p.position_in_enu_km[i], start[i] + 150.0 * p.t * frame.along[i], 1e-9);
  }
}

TEST(SineCosineOfTurns, AreWithinTheirStatedError) {
  for (double turns = 0.0; turns <= 1.0; turns += 1.0 / 4096) {
    double s, c;
    HWY_NAMESPACE::sine_cosine_of_turns(turns, s, c);
    EXPECT_NEAR(s, std::sin(2.0 * std::acos(-1.0) * turns), 3e-7) << turns;
    EXPECT_NEAR(c, std::cos(2.0 * std::acos(-1.0) * turns), 3e-7) << turns;
    HWY_NAMESPACE::Pack ps, pc;
    HWY_NAMESPACE::sine_cosine_of_turns(HWY_NAMESPACE::Pack(turns), ps, pc);
    EXPECT_NEAR(hwy::HWY_NAMESPACE::GetLane(ps.v), s, 3e-7) << turns;
    EXPECT_NEAR(hwy::HWY_NAMESPACE::GetLane(pc.v), c, 3e-7) << turns;
  }
}

TEST(LanePacks, DrawTheRandomNumbersOfTheScalarKernel) {
  using HWY_NAMESPACE::LaneTraits;
  using HWY_NAMESPACE::Pack;
  HWY_NAMESPACE::PhiloxKeys keys;
  HWY_NAMESPACE::philox_keys(0x123456789abcdefull, keys);
  std::uint32_t beams[16];
  for (std::uint32_t i = 0; i < 16; ++i) beams[i] = 1000 + 77 * i;
  for (std::uint32_t pair : {0u, 5u, 123456u}) {
    Pack packs[4];
    LaneTraits<Pack>::uniforms(LaneTraits<Pack>::load_indices(beams), pair, 3, keys, packs);
    for (int lane = 0; lane < LaneTraits<Pack>::lanes(); ++lane) {
      double scalar[4];
      LaneTraits<double>::uniforms(beams[lane], pair, 3, keys, scalar);
      for (int i = 0; i < 4; ++i) {
        float lanes[16];
        LaneTraits<Pack>::store(packs[i], lanes);
        EXPECT_EQ(lanes[lane], static_cast<float>(scalar[i]));
      }
    }
  }
}

}  // namespace
}  // namespace vegard::sim
