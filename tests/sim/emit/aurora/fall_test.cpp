// The falling beams over double, instantiated for the instruction set that this file is compiled for.
#include "sim/emit/aurora/fall-inl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/beam.h"

namespace vegard::sim::fall_test {
namespace {

using Beams = HWY_NAMESPACE::FallingBeams<double, double, double>;
using Point = HWY_NAMESPACE::FallenPoint<double, double>;

struct Falls {
  double mean_points = 0.0, deviation_of_points = 0.0;
  double spread_km = 0.0;  ///< RMS, in both directions together, of the lowest point
  double mean_light = 0.0, deviation_of_light = 0.0;  ///< of the path that the points above the end stand for
};

Falls fall(PitchLaw law, int beams, double path_step = 1.0 / 300.0, PathRule rule = PathRule::random) {
  constexpr double kLengthKm = 200.0;
  Deflection<double> deflection;
  deflection.law = law;
  deflection.rule = rule;
  deflection.loss_cone_rad = 2.5 * kRadiansPerDegree;
  deflection.pitch_step_rad = 0.015;
  deflection.path_step = path_step;
  HWY_NAMESPACE::PhiloxKeys keys;
  HWY_NAMESPACE::philox_keys(12, keys);
  Falls result;
  double points2 = 0.0, spread2 = 0.0, light2 = 0.0;
  for (int b = 0; b < beams; ++b) {
    Beams beam;
    beam.start(kLengthKm, static_cast<std::uint32_t>(b), 0, keys);
    int points = 0;
    double aside2 = 0.0, light = 0.0;
    for (bool falls = true; falls;) {
      beam.next_four(deflection, keys, [&](int, const Point& point) {
        falls = falls && point.t <= 1.0;
        if (!falls) return;
        ++points;
        light += point.stretch * kLengthKm;
        aside2 = std::pow(point.across1_km, 2) + std::pow(point.across2_km, 2);
      });
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

TEST(FallingBeams, OfEvenStepsSpreadAlikeAndHaveNoGrainOfTheirOwn) {
  // Tolerances as above. A path has its 600 points; the first stands for up to half a step less than a whole.
  for (const auto& [law, metres] : {std::pair{PitchLaw::increment, 82.0}, std::pair{PitchLaw::reduced, 342.0},
                                    std::pair{PitchLaw::constant, 411.0}}) {
    const Falls even = fall(law, 4000, 1.0 / 300.0, PathRule::even);
    EXPECT_NEAR(1000.0 * even.spread_km, metres, 0.032 * metres + 0.5);
    EXPECT_NEAR(even.mean_points, 600.0, 0.01);
    EXPECT_NEAR(even.mean_light, 200.0, 0.5 * 200.0 / 600.0);
    EXPECT_LT(even.deviation_of_light, 0.5 * fall(law, 4000).deviation_of_light);
  }
}

TEST(FallingBeams, OfEvenStepsBeginBetweenTheirNeighbours) {
  // Of eight points of Weyl's sequence of the golden ratio none is nearer to another than 1 / phi^5, 0.09, or
  // farther from the next than 1 / phi^3, 0.24 (the three-distance theorem), in units of the even step.
  Deflection<double> deflection;
  deflection.loss_cone_rad = 0.04;
  deflection.pitch_step_rad = 0.015;
  deflection.path_step = 0.01;
  HWY_NAMESPACE::PhiloxKeys keys;
  HWY_NAMESPACE::philox_keys(12, keys);
  for (std::uint32_t layer = 0; layer < 3; ++layer) {
    std::vector<double> first;
    for (std::uint32_t b = 40; b < 48; ++b) {
      Beams beam;
      beam.start(150.0, b, layer, keys);
      double before = 0.0;
      beam.next_four(deflection, keys, [&](int i, const Point& p) {
        if (i == 0) first.push_back(p.t / 0.005);
        if (i > 0) {
          EXPECT_NEAR(p.t - before, 0.005, 1e-9);
        }
        before = p.t;
      });
    }
    std::sort(first.begin(), first.end());
    for (std::size_t i = 0; i < first.size(); ++i) {
      const double gap = i == 0 ? first.front() + 1.0 - first.back() : first[i] - first[i - 1];
      EXPECT_GT(gap, 0.08);
      EXPECT_LT(gap, 0.25);
    }
  }
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
  Deflection<double> deflection;
  deflection.law = PitchLaw::constant;
  deflection.loss_cone_rad = deflection.pitch_step_rad = 0.0;
  deflection.path_step = 0.01;
  HWY_NAMESPACE::PhiloxKeys keys;
  HWY_NAMESPACE::philox_keys(12, keys);
  Beams beam;
  beam.start(150.0, 4, 2, keys);
  for (int n = 0; n < 10; ++n) {
    beam.next_four(deflection, keys, [&](int, const Point& p) {
      EXPECT_NEAR(p.along_km, 150.0 * p.t, 1e-9);
      EXPECT_EQ(p.across1_km, 0.0);
      EXPECT_EQ(p.across2_km, 0.0);
    });
  }
}

TEST(FallingBeams, TakeTheirStepsFromOneWordEach) {
  // The constant law: what goes aside is the step times the sine of one angle.
  Deflection<double> deflection;
  deflection.rule = PathRule::random;
  deflection.law = PitchLaw::constant;
  deflection.loss_cone_rad = 0.1;
  deflection.path_step = 0.01;
  HWY_NAMESPACE::PhiloxKeys keys;
  HWY_NAMESPACE::philox_keys(12, keys);
  Beams beam;
  beam.start(150.0, 4, 2, keys);
  Point before{};
  for (std::uint32_t quad = 0; quad < 5; ++quad) {
    const Words words = random_words(12, Stream::path, quad, 4, 2);
    beam.next_four(deflection, keys, [&](int i, const Point& p) {
      EXPECT_NEAR(p.t - before.t, 0.01 * ((words[i] >> 16) + 0.5) / 65536.0, 1e-9);
      const double aside = 150.0 * (p.t - before.t) * std::sin(0.1);
      double cosine, sine;
      HWY_NAMESPACE::random_direction(words[i], cosine, sine);
      EXPECT_NEAR(p.across1_km - before.across1_km, aside * cosine, 1e-6);
      EXPECT_NEAR(p.across2_km - before.across2_km, aside * sine, 1e-6);
      before = p;
    });
  }
}

TEST(RandomDirection, ComesInEveryOf65536EvenlySpacedAzimuths) {
  const double turn = 2.0 * std::acos(-1.0);
  std::vector<bool> seen(65536, false);
  for (std::uint32_t lower = 0; lower < 65536; ++lower) {
    const std::uint32_t word = 0xabcd0000u | lower;  // the upper half is of no account
    double cosine, sine;
    HWY_NAMESPACE::random_direction(word, cosine, sine);
    const double cell = std::floor(std::atan2(sine, cosine) / turn * 65536.0),
                 azimuth = (cell + 0.5) * turn / 65536.0;
    seen[static_cast<std::size_t>(cell + 32768.0)] = true;
    ASSERT_NEAR(cosine, std::cos(azimuth), 1e-7) << lower;
    ASSERT_NEAR(sine, std::sin(azimuth), 1e-7) << lower;
    HWY_NAMESPACE::Pack of_pack_cosine, of_pack_sine;
    HWY_NAMESPACE::random_direction(hwy::HWY_NAMESPACE::Set(HWY_NAMESPACE::WordTag(), word), of_pack_cosine,
                                    of_pack_sine);
    ASSERT_NEAR(hwy::HWY_NAMESPACE::GetLane(of_pack_cosine.v), cosine, 3e-7) << lower;
    ASSERT_NEAR(hwy::HWY_NAMESPACE::GetLane(of_pack_sine.v), sine, 3e-7) << lower;
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 65536);
}

TEST(LanePacks, DrawTheRandomNumbersOfTheScalarKernel) {
  using HWY_NAMESPACE::LaneTraits;
  using HWY_NAMESPACE::Pack;
  constexpr std::uint64_t kSeed = 0x123456789abcdefull;
  HWY_NAMESPACE::PhiloxKeys keys;
  HWY_NAMESPACE::philox_keys(kSeed, keys);
  std::uint32_t beams[16];
  for (std::uint32_t i = 0; i < 16; ++i) beams[i] = 1000 + 0x1234567u * i;
  for (std::uint32_t layer : {0u, 3u, 0xffff0102u}) {
    LaneTraits<Pack>::PathWords packs;
    packs.start(LaneTraits<Pack>::load_indices(beams), layer, keys);
    for (std::uint32_t quad : {0u, 1u, 5u, 123456u}) {
      LaneTraits<Pack>::Words of_packs[4];
      packs.draw(quad, keys, of_packs);
      for (int lane = 0; lane < LaneTraits<Pack>::lanes(); ++lane) {
        const Words expected = random_words(kSeed, Stream::path, quad, beams[lane], layer);
        LaneTraits<double>::PathWords one;
        one.start(beams[lane], layer, keys);
        std::uint32_t of_one[4];
        one.draw(quad, keys, of_one);
        for (int i = 0; i < 4; ++i) {
          std::uint32_t words[16];
          hwy::HWY_NAMESPACE::StoreU(of_packs[i], HWY_NAMESPACE::WordTag(), words);
          EXPECT_EQ(words[lane], expected[i]);
          EXPECT_EQ(of_one[i], expected[i]);
          float lengths[16];
          LaneTraits<Pack>::store(HWY_NAMESPACE::upper_uniform(of_packs[i]), lengths);
          EXPECT_EQ(lengths[lane], upper_uniform(expected[i]));
        }
      }
    }
  }
}

}  // namespace
}  // namespace vegard::sim::fall_test
