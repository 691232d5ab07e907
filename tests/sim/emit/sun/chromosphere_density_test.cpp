#include "sim/base/number/random.h"
#include "sim/emit/sun/chromosphere_density.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/support/one_sun.h"

namespace vegard::sim::chromosphere_density_test {
namespace {

using tests::one_sun;

Scene noisy() {
  Scene scene = one_sun();
  scene.seed = 11;
  Chromosphere c;
  c.innerradius = 10.0;
  c.outerradius = 12.0;
  c.scale = 3.0;
  c.shift = {0.3, -0.2, 0.7};
  scene.chromospheres = {c};
  return scene;
}

/// Some places between 10 and 12 units. Stream and seed as in no other test.
std::vector<std::array<double, 3>> places(int count) {
  std::vector<std::array<double, 3>> all;
  for (int i = 0; i < count; ++i) {
    const Words words = random_words(77, Stream::chromosphere, static_cast<std::uint32_t>(i), 5);
    const double z = 2.0 * uniform(words[0]) - 1.0, turn = 6.283185307179586 * uniform(words[1]),
                 r = 10.0 + 2.0 * uniform(words[2]), level = std::sqrt(1.0 - z * z);
    all.push_back({r * level * std::cos(turn), r * level * std::sin(turn), r * z});
  }
  return all;
}

double density_at(const Scene& scene, const std::array<double, 3>& place) {
  return ChromosphereDensity<double>(scene, 0, nullptr, plain_number).at(place.data());
}

TEST(CloudCutoff, StartsAtItsCoverageWithItsSlopeAndEndsAtItsAmplitude) {
  constexpr double kCoverage = 0.3, kSharpness = 5.0, kAmplitude = 2.5, h = 1e-7;
  const auto f = [&](double x) { return cloud_cutoff(x, kCoverage, kSharpness, kAmplitude); };
  EXPECT_EQ(f(kCoverage), 0.0);
  EXPECT_EQ(f(kCoverage - 0.2), 0.0) << "where the formula is negative";
  EXPECT_NEAR(f(kCoverage + h) / h, kAmplitude * kSharpness, 1e-4);
  EXPECT_NEAR(f(kCoverage + 0.1), 2.5 * (1.0 - std::exp(-0.5)), 1e-14);
  EXPECT_NEAR(f(100.0), kAmplitude, 1e-14);
}

TEST(ChromosphereDensity, IsTheCutoffOfASumOfOctaves) {
  const Scene scene = noisy();
  const Chromosphere& c = scene.chromospheres[0];
  const ChromosphereDensity<double> density(scene, 0, nullptr, plain_number);
  Scene uncut = scene;
  uncut.chromospheres[0].cutoff = false;
  const ChromosphereDensity<double> turbulence(uncut, 0, nullptr, plain_number);
  const NoiseLattice lattice(scene.seed, Stream::chromosphere, name_number(c.name));
  int empty = 0;
  for (const auto& place : places(500)) {
    double x = 0.0;
    for (int i = 0; i < c.octaves; ++i) {
      const double finer = std::pow(1.99, i);
      x += std::pow(c.roughness, i) * std::abs(lattice.value(finer * (place[0] / c.scale + c.shift[0]),
                                                             finer * (place[1] / c.scale + c.shift[1]),
                                                             finer * (place[2] / c.scale + c.shift[2])));
    }
    EXPECT_NEAR(turbulence.at(place.data()), x, 1e-11);
    const double f = std::max(0.0, c.amplitude * (1.0 - std::exp(-(x - c.coverage) * c.sharpness)));
    EXPECT_NEAR(density.at(place.data()), f, 1e-10);
    if (f == 0.0) ++empty;
  }
  EXPECT_GT(empty, 20) << "or the cutoff has not been tried";
  EXPECT_LT(empty, 480);
}

TEST(ChromosphereDensity, IsShiftedByLengthsOfItsLargestWaves) {
  Scene scene = noisy();
  const double there = density_at(scene, {10.0 + 2.0 * 3.0, 1.0, -2.0});
  scene.chromospheres[0].shift[0] += 2.0;
  EXPECT_NEAR(density_at(scene, {10.0, 1.0, -2.0}), there, 1e-11);
}

TEST(ChromosphereDensity, DiffersByTheSeedAndFromOneToTheNext) {
  Scene scene = noisy();
  scene.chromospheres[0].cutoff = false;
  scene.chromospheres.push_back(scene.chromospheres[0]);
  scene.chromospheres[1].name = "other";
  const double place[3] = {7.0, 6.0, 5.0};
  const double here = ChromosphereDensity<double>(scene, 0, nullptr, plain_number).at(place);
  EXPECT_NE(ChromosphereDensity<double>(scene, 1, nullptr, plain_number).at(place), here);
  scene.seed = 12;
  EXPECT_NE(ChromosphereDensity<double>(scene, 0, nullptr, plain_number).at(place), here);
}

TEST(ChromosphereDensity, OfTheBiasIsAddedAfterTheCutoffAndNeverNegative) {
  Scene scene = noisy();
  Image map(8, 4, {"Y"});
  for (float& texel : map.data) texel = 0.5f;
  scene.chromospheres[0].peak = 0.6;
  Scene less = scene;
  less.chromospheres[0].peak = -0.6;
  const ChromosphereDensity<double> bare(scene, 0, nullptr, plain_number),
      biased(scene, 0, &map, plain_number), lessened(less, 0, &map, plain_number);
  int negative = 0;
  for (const auto& place : places(200)) {
    const double without = bare.at(place.data());
    EXPECT_NEAR(biased.at(place.data()), without + 0.3, 1e-12);
    EXPECT_NEAR(lessened.at(place.data()), std::max(without - 0.3, 0.0), 1e-12);
    if (without < 0.3) ++negative;
  }
  EXPECT_GT(negative, 10);
}

/// The lag at which the autocorrelation along lines falls to a half.
double half_length(double scale) {
  Scene scene = noisy();
  Chromosphere& c = scene.chromospheres[0];
  c.scale = scale;
  c.cutoff = false;
  const ChromosphereDensity<double> density(scene, 0, nullptr, plain_number);
  constexpr int kLines = 20, kSamples = 2048;
  constexpr double kStep = 0.1;
  std::vector<double> product(kSamples / 2, 0.0);
  std::vector<std::vector<double>> lines(kLines);
  double mean = 0.0;
  for (int line = 0; line < kLines; ++line)
    for (int i = 0; i < kSamples; ++i) {
      const double place[3] = {kStep * i, 9.7 * line, 11.0};
      lines[static_cast<std::size_t>(line)].push_back(density.at(place));
      mean += lines[static_cast<std::size_t>(line)].back() / (kLines * kSamples);
    }
  for (const auto& line : lines)
    for (int lag = 0; lag < kSamples / 2; ++lag)
      for (int i = 0; i < kSamples / 2; ++i)
        product[static_cast<std::size_t>(lag)] +=
            (line[static_cast<std::size_t>(i)] - mean) * (line[static_cast<std::size_t>(i + lag)] - mean);
  int lag = 0;
  while (product[static_cast<std::size_t>(lag)] > 0.5 * product[0]) ++lag;
  const double above = product[static_cast<std::size_t>(lag - 1)],
               below = product[static_cast<std::size_t>(lag)];
  return kStep * (lag - 1 + (above - 0.5 * product[0]) / (above - below));
}

TEST(ChromosphereDensity, HasGranulesThatGrowWithTheirScale) {
  // The pattern itself grows: at twice the scale it is at twice the place what it was.
  Scene scene = noisy(), doubled = scene;
  doubled.chromospheres[0].scale *= 2.0;
  for (const auto& place : places(100))
    EXPECT_NEAR(density_at(doubled, {2.0 * place[0], 2.0 * place[1], 2.0 * place[2]}),
                density_at(scene, place), 1e-11);
  // And so does its correlation along given lines.
  const double small = half_length(2.0), median = half_length(4.0), large = half_length(8.0);
  EXPECT_GT(median, 1.2 * small);
  EXPECT_GT(large, 1.2 * median);
}

}  // namespace
}  // namespace vegard::sim::chromosphere_density_test
