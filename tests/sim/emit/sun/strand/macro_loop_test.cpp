// Strands of macro-loops: where they stand, what noise does to them, and their derivatives.
#include "sim/emit/sun/strand/macro_loop.h"
#include "sim/scene/structs/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "tests/support/free_paths.h"
#include "tests/support/kind_named.h"

namespace vegard::sim::macro_loop_test {
namespace {

const NumberAs<double> kPlain = [](const double& x) { return x; };

using Point = std::array<double, 3>;

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double length(const Point& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }
Point on_curve(const Strand<double>& s, double t) {
  Point at{};
  const double u = 1.0 - t, w[4] = {u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t};
  for (int p = 0; p < 4; ++p)
    for (int i = 0; i < 3; ++i) at[i] += w[p] * s.points[p][i];
  return at;
}

/// On the equator at the frame's x axis, from south to north: along = z, across = y, up = x.
Loop plain_loop() {
  Loop loop;
  loop.bearing_deg = 0.0;
  loop.strands = 40;
  loop.rayleigh = {1.0};
  return loop;
}

Strands<double> made(const Loop& loop, std::uint64_t seed = 1) {
  return strands_of<double>(Sun{}, loop, seed, kPlain);
}

TEST(MacroLoop, PlainStrandsAreTranslationsOfOneAnotherInParallelPlanes) {
  Loop loop = plain_loop();
  loop.latitude_deg = 20.0;
  loop.longitude_deg = -70.0;
  loop.bearing_deg = 33.0;
  loop.tilt_deg = 25.0;
  const Strands<double> all = made(loop);
  ASSERT_EQ(all.all.size(), 40u);
  const auto& first = all.all.front().points;
  for (const Strand<double>& strand : all.all) {
    const Point shift = minus(strand.points[0], first[0]);
    for (int p = 0; p < 4; ++p)
      EXPECT_LT(length(minus(minus(strand.points[p], first[p]), shift)), 1e-12 * 700.0) << "point " << p;
    EXPECT_EQ(strand.along, all.all.front().along);
  }
  // Evenly apart: the photosphere's curvature is second-order and the same for both feet.
  for (std::size_t k = 2; k < all.all.size(); ++k)
    EXPECT_NEAR(length(minus(all.all[k].points[0], all.all[k - 1].points[0])), 0.5, 1e-3);
}

TEST(MacroLoop, WithoutSpreadAndNoiseStrandsAreTheSameToTheLastBit) {
  Loop loop = plain_loop();
  loop.spread = 0.0;
  loop.tilt_per_distance_deg = 3.0;
  loop.skew = 4.0;
  const Strands<double> all = made(loop);
  for (const Strand<double>& strand : all.all) {
    EXPECT_EQ(strand.points, all.all[0].points);
    for (const Point& p : strand.points)
      for (const double x : p) EXPECT_EQ(std::signbit(x), x < 0.0);
    EXPECT_EQ(strand.along, all.all[0].along);
  }
}

TEST(MacroLoop, StandsAsItsNumbersSay) {
  Loop loop = plain_loop();
  loop.strands = 1;
  const Sun sun;
  const Strand<double> strand = made(loop).all[0];
  const double depth = std::sqrt(sun.radius * sun.radius - 40.0 * 40.0);
  const Point feet[2] = {{depth, 0.0, -40.0}, {depth, 0.0, 40.0}};
  EXPECT_LT(length(minus(strand.points[0], feet[0])), 1e-10);
  EXPECT_LT(length(minus(strand.points[3], feet[1])), 1e-10);
  EXPECT_LT(length(minus(on_curve(strand, 0.5), {depth + 60.0, 0.0, 0.0})), 1e-10);
  for (const double t : {0.1, 0.3, 0.8})
    EXPECT_NEAR(on_curve(strand, t)[0] - depth, 60.0 * 4.0 * t * (1.0 - t), 1e-10) << t;

  loop.tilt_deg = 90.0;  // to the right of the way north, which is to the west
  EXPECT_LT(length(minus(on_curve(made(loop).all[0], 0.5), {depth, 60.0, 0.0})), 1e-10);
  loop.tilt_deg = 0.0;
  loop.skew = 7.0;  // the first to the right
  EXPECT_NEAR(made(loop).all[0].points[1][1], 7.0, 1e-10);
  EXPECT_NEAR(made(loop).all[0].points[2][1], -7.0, 1e-10);
  loop.sharpness = 1.0;
  EXPECT_NEAR(made(loop).all[0].points[1][2], 0.0, 1e-10);
  loop.bearing_deg = 90.0;  // to the west
  EXPECT_LT(length(minus(made(loop).all[0].points[3], {depth, 40.0, 0.0})), 1e-10);
}

TEST(MacroLoop, FeetAreOnThePhotosphereWhateverTheNoise) {
  Loop loop = plain_loop();
  loop.root_noise = 30.0;
  loop.height_noise = 1.0;
  loop.tilt_noise_deg = 40.0;
  loop.filaments = 5;
  for (const Strand<double>& strand : made(loop).all)
    for (const int foot : {0, 3}) EXPECT_NEAR(length(strand.points[foot]), Sun{}.radius, 1e-9);
}

TEST(MacroLoop, NoiseHasTheStatedMoments) {
  // 4000 strands: means are off by 1/63 of the deviation, deviations by 1/89 of themselves (one sigma).
  constexpr int kMany = 4000;
  Loop loop = plain_loop();
  loop.strands = kMany;
  loop.spread = 0.0;
  loop.density_noise = 0.5;
  loop.height_noise = 0.1;
  loop.root_noise = 2.0;
  const Strands<double> all = made(loop);
  std::vector<double> density, height, across;
  for (const Strand<double>& s : all.all) {
    density.push_back(s.along[0]);
    Point middle = s.points[0];
    for (int i = 0; i < 3; ++i) middle[i] = 0.5 * (middle[i] + s.points[3][i]);
    height.push_back(length(minus(on_curve(s, 0.5), middle)));
    across.push_back(s.points[0][1]);
  }
  const auto mean = [](const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  };
  const auto deviation = [&](const std::vector<double>& v) {
    double sum = 0.0;
    for (const double x : v) sum += std::pow(x - mean(v), 2);
    return std::sqrt(sum / static_cast<double>(v.size()));
  };
  EXPECT_NEAR(mean(density), 1.0, 4.0 * std::sqrt((std::exp(0.25) - 1.0) / kMany));
  EXPECT_NEAR(mean(height), 60.0, 4.0 * 6.0 / std::sqrt(kMany));
  EXPECT_NEAR(deviation(height), 6.0, 4.0 * 6.0 / std::sqrt(2.0 * kMany));
  EXPECT_NEAR(mean(across), 0.0, 4.0 * 2.0 / std::sqrt(kMany));
  EXPECT_NEAR(deviation(across), 2.0, 4.0 * 2.0 / std::sqrt(2.0 * kMany));
}

TEST(MacroLoop, LoopsAndSeedsDiffer) {
  Loop loop = plain_loop();
  loop.root_noise = 1.0;
  EXPECT_EQ(made(loop).all[3].points, made(loop).all[3].points);
  Loop other = loop;
  other.name = "other";
  EXPECT_NE(made(loop).all[3].points, made(other).all[3].points);
  EXPECT_NE(made(loop, 1).all[3].points, made(loop, 2).all[3].points);
}

/// Mean distance between neighbours, of the places that `where` gives.
double spacing(const Strands<double>& all, const std::function<Point(const Strand<double>&)>& where) {
  double sum = 0.0;
  for (std::size_t k = 1; k < all.all.size(); ++k)
    sum += length(minus(where(all.all[k]), where(all.all[k - 1])));
  return sum / static_cast<double>(all.all.size() - 1);
}

TEST(MacroLoop, FilamentsDrawTopsTogetherByTheirPullAndLeaveFeet) {
  Loop loop = plain_loop();
  loop.root_noise = 1.0;
  loop.tilt_noise_deg = 3.0;
  loop.strands = 100;
  const Strands<double> loose = made(loop);
  loop.filaments = 6;
  const Strands<double> drawn = made(loop);
  const auto top = [](const Strand<double>& s) { return on_curve(s, 0.5); };
  const auto foot = [](const Strand<double>& s) { return s.points[0]; };
  EXPECT_EQ(spacing(loose, foot), spacing(drawn, foot));
  EXPECT_LT(spacing(drawn, top), 0.6 * spacing(loose, top));
  EXPECT_LT(spacing(drawn, top), spacing(drawn, foot));

  // All of them at their bunch's top: as many places as filaments.
  loop.filament_pull = 1.0;
  const Strands<double> knotted = made(loop);
  int places = 1;
  for (std::size_t k = 1; k < knotted.all.size(); ++k)
    if (length(minus(top(knotted.all[k]), top(knotted.all[k - 1]))) > 1e-9) ++places;
  EXPECT_EQ(places, 6);
}

TEST(MacroLoop, HeightFalloffsAreOneWhereMostAndLeastWhereLeast) {
  Loop loop = plain_loop();
  loop.falloff_least = 0.2;
  loop.base_density = 3.0;
  for (const std::string word : {"none", "grow", "fade", "logarithmic", "inverse-square"}) {
    loop.height_falloff = tests::kind_named<HeightFalloff>(word);
    const std::vector<double> along = made(loop).all[0].along;
    const double at_foot = along.front(), at_top = along[along.size() / 2];
    EXPECT_NEAR(at_foot, word == "grow" ? 0.6 : 3.0, 1e-12) << word;
    EXPECT_NEAR(at_top, word == "none" || word == "grow" ? 3.0 : 0.6, 1e-12) << word;
    EXPECT_NEAR(along.back(), at_foot, 1e-12) << word;
    for (std::size_t i = 1; i <= along.size() / 2; ++i) {
      const double rise = along[i] - along[i - 1];
      EXPECT_TRUE(word == "grow" ? rise > 0.0 : word == "none" ? rise == 0.0 : rise < 0.0) << word;
    }
  }
  loop.height_falloff = HeightFalloff::none;
  loop.brightening = 2.0;
  const std::vector<double> bright = made(loop).all[0].along;
  EXPECT_NEAR(bright[bright.size() / 2], 9.0, 1e-12);  // (1 + 2) times the base, at the top
}

TEST(MacroLoop, StrandsBrightenFromTheirFeetOverAShareOfTheHeight) {
  Loop loop = plain_loop();
  const Strands<double> before = strands_of<double>(Sun{}, loop, 3, kPlain);
  loop.foot_fade = 0.2;
  const Strands<double> after = strands_of<double>(Sun{}, loop, 3, kPlain);
  const std::vector<double>&whole = before.all[0].along, &faded = after.all[0].along;
  ASSERT_EQ(faded.size(), whole.size());
  EXPECT_EQ(faded.front(), 0.0);
  EXPECT_EQ(faded.back(), 0.0);
  for (std::size_t i = 0; i < faded.size(); ++i) {
    const double t = static_cast<double>(i) / (faded.size() - 1.0), z = 4.0 * t * (1.0 - t);
    if (z >= 0.2)
      EXPECT_EQ(faded[i], whole[i]);
    else
      EXPECT_LT(faded[i], whole[i]);
  }
}

TEST(MacroLoop, DerivativesAreThoseOfCentralDifferences) {
  Scene scene;
  scene.sun.shown = true;
  Loop askew = plain_loop();
  askew.latitude_deg = 20.0;
  askew.longitude_deg = -40.0;
  askew.bearing_deg = 70.0;
  askew.sharpness = 0.3;
  askew.skew = 5.0;
  askew.tilt_deg = 20.0;
  askew.tilt_per_distance_deg = 1.0;
  askew.strands = 7;
  askew.height_falloff = HeightFalloff::inverse_square;
  askew.falloff_least = 0.1;
  askew.root_noise = 1.0;
  askew.height_noise = 0.1;
  askew.tilt_noise_deg = 3.0;
  askew.density_noise = 0.4;
  askew.filaments = 2;
  askew.brightening = 1.5;
  askew.brightening_at = 0.8;
  scene.loops = {askew};
  const auto flat = [](const auto& strands) {
    auto numbers = strands.all[0].along;
    for (const auto& strand : strands.all) {
      for (const auto& point : strand.points) numbers.insert(numbers.end(), point.begin(), point.end());
      numbers.insert(numbers.end(), strand.along.begin(), strand.along.end());
      numbers.push_back(strand.radius_first);
      numbers.push_back(strand.radius_last);
    }
    return numbers;
  };
  const auto plain = [&](const Scene& of) {
    return flat(strands_of<double>(of.sun, of.loops[0], of.seed, kPlain));
  };
  const std::vector<double> here = plain(scene);
  int moved = 0;
  for (const tests::FreePath& free : tests::free_paths(scene)) {
    if (free.path.row->table != "loop" || free.path.row->key == "rayleigh" ||
        free.path.row->key == "temperature_mk")
      continue;
    const double* at = real_value(scene, free.path);
    const auto dual = flat(strands_of<FreeDual>(scene.sun, scene.loops[0], scene.seed, [&](const double& x) {
      FreeDual d(x);
      if (&x == at) d.d.t[0] = 1.0;
      return d;
    }));
    Scene more = scene, less = scene;
    *real_value(more, free.path) += free.step;
    *real_value(less, free.path) -= free.step;
    const std::vector<double> high = plain(more), low = plain(less);
    double size = 0.0;
    for (std::size_t i = 0; i < here.size(); ++i) {
      EXPECT_NEAR(dual[i].v, here[i], 1e-10 * (1.0 + std::abs(here[i])));
      const double difference = (high[i] - low[i]) / (2.0 * free.step);
      // Numbers of some 700 differ with an error of 1e-13, over a step of 1e-4: 1e-9; steps' squares the
      // rest.
      EXPECT_NEAR(dual[i].d.t[0], difference, 1e-6 * (1.0 + std::abs(difference))) << free.path.text;
      size += std::abs(difference);
    }
    EXPECT_GT(size, 0.0) << free.path.text;
    ++moved;
  }
  EXPECT_EQ(moved, 21) << "every number of a loop that may be free, but for its light";
}

}  // namespace
}  // namespace vegard::sim::macro_loop_test
