// Statistics of made-up curtains: their noise, their slopes, and what they do not see.
#include "fit/compare/statistics.h"
#include "fit/measure/profile_bins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "fit/compare/border_statistic.h"
#include "fit/compare/colour_statistic.h"
#include "fit/measure/noise_model.h"
#include "tests/support/expect_error.h"
#include "tests/support/kind_named.h"
#include "tests/support/made_photo.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::statistics_test {
namespace {

constexpr int kBands = 6;
constexpr double kNoise = 0.02;
constexpr unsigned kPhotos = 40;

const std::vector<sim::ParameterId> kNoNumbers;
const std::vector<double> kNoSlopes;

SolvedLight true_light(const BinGrid& grid, const tests::MadeCurtain& curtain) {
  SolvedLight light;
  light.aurora = tests::made_bins(grid, curtain);
  for (std::size_t i = 0; i < light.aurora.size(); ++i) light.behind.push_back(tests::kMadeSky[i % 3]);
  return light;
}

std::vector<double> residuals_of(const Statistic& statistic, const SolvedLight& light,
                                 std::vector<double>* jacobian = nullptr) {
  const sim::Scene scene;
  std::vector<double> residual(statistic.residuals());
  if (jacobian != nullptr) jacobian->resize(residual.size() * light.free);
  statistic.evaluate({light, scene, kNoNumbers, kNoSlopes}, residual.data(),
                     jacobian != nullptr ? jacobian->data() : nullptr);
  return residual;
}

struct Moments {
  double sum = 0.0, squares = 0.0;
  int count = 0;
  void add(double x) {
    sum += x;
    squares += x * x;
    ++count;
  }
  double mean() const { return sum / count; }
  double mean_square() const { return squares / count; }
};

// Forty photographs of white noise, seeds 1 to 40. The mean square of n Gaussian numbers has a standard error
// of sqrt(2 / n). Colour: ratios of a bin share green, which makes it 1.25 times that, of 20000 numbers
// 0.013; a noise estimated from 15 rows of 40 pixels adds 0.01 and the logarithm's curvature up to 0.03 at
// five standard deviations: 0.06 in all. Border: 240 numbers, 0.09; three times that.
TEST(Statistics, ColourAndBorderScatterByTheirSigma) {
  const tests::MadeCurtain truth;
  const Region region{0, 0, truth.width, truth.height};
  const SolvedLight light = true_light(column_bins(region, kBands), truth);
  Moments colour, border;
  for (unsigned seed = 1; seed <= kPhotos; ++seed) {
    tests::MadeCurtain noisy = truth;
    noisy.noise = kNoise;
    noisy.seed = seed;
    const Profile data = extract_profile(tests::made_photo(noisy), region, kBands);
    const std::vector<double> sigma = profile_sigma(data, 0.0);
    for (const double r : residuals_of(ColourStatistic(data, sigma, 1.0), light)) colour.add(r);
    for (const double r : residuals_of(BorderStatistic(data, sigma, 1.0), light)) border.add(r);
  }
  EXPECT_GT(colour.count, 15000);
  EXPECT_NEAR(colour.mean_square(), 1.0, 0.06);
  EXPECT_NEAR(colour.mean(), 0.0, 0.06);
  EXPECT_EQ(border.count, 240);
  EXPECT_NEAR(border.mean_square(), 1.0, 0.27);
  EXPECT_NEAR(border.mean(), 0.0, 0.2);
}

// As above; strips of 30 rows and 30 bins, cells of 16 pixels: 14400 and 12600 numbers, standard errors of
// 0.012. Noise from 240 or 2300 pixels is worth 0.025 more.
// The logarithm of light of ten standard deviations is 0.005 too small in the mean, that of twenty 0.00125.
// What their ratio makes up for is the difference of the two: 20000 bins tell it to 0.0008.
TEST(Statistics, RatiosOfColoursAreWithoutBias) {
  constexpr int kBins = 20000, kDark = 2000;
  const double red = 20.0, green = 10.0;  // standard deviations, of 1
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  Profile data;
  data.bands = 1;
  data.rows = kBins + kDark;
  SolvedLight light;
  for (int row = 0; row < data.rows; ++row)
    for (const double channel : {red, green, 0.0}) {
      const bool lit = row < kBins && channel > 0.0;
      data.mean.push_back(lit ? channel + normal(random) : 0.0);
      data.standard_error.push_back(lit ? 1.0 : 1e-6);
      light.aurora.push_back(lit ? channel : 0.0);
      light.behind.push_back(0.0);
    }
  data.count.assign(data.mean.size(), 1);
  const ColourStatistic colour(data, data.standard_error, 1.0);
  ASSERT_EQ(colour.residuals(), kBins) << "red over green";
  const std::vector<double> residual = residuals_of(colour, light);
  double mean = 0.0;
  for (int bin = 0; bin < kBins; ++bin) {
    const double of_red = data.mean[data.index(0, bin, 0)], of_green = data.mean[data.index(0, bin, 1)];
    mean += residual[bin] * std::hypot(1.0 / of_red, 1.0 / of_green) / kBins;
  }
  EXPECT_NEAR(mean, 0.0, 4.0 * 0.0008);
}

TEST(Statistics, LightInStripsAndCellsScattersByItsSigma) {
  const tests::MadeCurtain truth;
  const BinGrid profiles = column_bins({0, 0, truth.width, truth.height}, kBands);
  for (const bool strips : {true, false}) {
    const auto grid =
        std::make_shared<const BinGrid>(strips ? horizontal_bins(profiles, 4) : image_bins(profiles, 16));
    const std::vector<double> light = tests::made_bins(*grid, truth);
    Moments moments;
    for (unsigned seed = 1; seed <= kPhotos; ++seed) {
      tests::MadeCurtain noisy = truth;
      noisy.noise = kNoise;
      noisy.seed = seed;
      const Profile data = extract_profile(tests::made_photo(noisy), grid);
      const std::vector<double> sigma = profile_sigma(data, 0.0);
      for (std::size_t i = 0; i < light.size(); ++i)
        moments.add((data.mean[i] - tests::kMadeSky[i % 3] - light[i]) / sigma[i]);
    }
    EXPECT_NEAR(moments.mean_square(), 1.0, 0.06) << (strips ? "strips" : "cells");
  }
}

/// A weight multiplies chi2.
TEST(Statistics, WeightsMultiplyTheSquares) {
  tests::MadeCurtain noisy;
  noisy.noise = kNoise;
  const Region region{0, 0, noisy.width, noisy.height};
  const Profile data = extract_profile(tests::made_photo(noisy), region, kBands);
  const std::vector<double> sigma = profile_sigma(data, 0.01);
  const SolvedLight light = true_light(*data.grid, noisy);
  const std::vector<double> one = residuals_of(ColourStatistic(data, sigma, 1.0), light),
                            four = residuals_of(ColourStatistic(data, sigma, 4.0), light);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_NEAR(four[k], 2.0 * one[k], 1e-9);
  const std::vector<double> border = residuals_of(BorderStatistic(data, sigma, 1.0), light),
                            border4 = residuals_of(BorderStatistic(data, sigma, 4.0), light);
  ASSERT_EQ(border.size(), static_cast<std::size_t>(kBands));
  for (std::size_t k = 0; k < border.size(); ++k) EXPECT_NEAR(border4[k], 2.0 * border[k], 1e-9);
}

TEST(Statistics, ColourAndBorderKnowNothingOfTheBrightnessOfBands) {
  tests::MadeCurtain noisy;
  noisy.noise = kNoise;
  const Region region{0, 0, noisy.width, noisy.height};
  const Profile data = extract_profile(tests::made_photo(noisy), region, kBands);
  const std::vector<double> sigma = profile_sigma(data, 0.01);
  SolvedLight light = true_light(*data.grid, noisy);
  const ColourStatistic colour(data, sigma, 1.0);
  // Without the photograph's own noise the model's border is that of light alone.
  Profile quiet = data;
  quiet.standard_error.assign(quiet.standard_error.size(), 0.0);
  const BorderStatistic border(quiet, sigma, 1.0);
  const std::vector<double> colour_before = residuals_of(colour, light),
                            border_before = residuals_of(border, light);
  for (std::size_t i = 0; i < light.aurora.size(); ++i) light.aurora[i] *= 1.0 + 0.5 * data.grid->band[i / 3];
  const std::vector<double> colour_after = residuals_of(colour, light),
                            border_after = residuals_of(border, light);
  for (std::size_t k = 0; k < colour_before.size(); ++k) EXPECT_NEAR(colour_after[k], colour_before[k], 1e-9);
  for (std::size_t k = 0; k < border_before.size(); ++k) EXPECT_NEAR(border_after[k], border_before[k], 1e-9);
}

/// Slanting by 0.02, and five rows lower: so is the border, to a tenth of a row. The steepest fall lies
/// within the edge's width of half the light.
TEST(Statistics, BorderFollowsTheCurtain) {
  tests::MadeCurtain curtain;
  const Region region{0, 0, curtain.width, curtain.height};
  std::vector<double> unmoved;
  for (const double shift : {0.0, 5.0}) {
    curtain.border_y = 70.0 + shift;
    const Profile data = extract_profile(tests::made_photo(curtain), region, kBands);
    const BorderStatistic border(data, profile_sigma(data, 0.01), 1.0);
    std::vector<double> light = data.mean;
    for (std::size_t i = 0; i < light.size(); ++i) light[i] -= tests::kMadeSky[i % 3];
    const auto borders = border.borders(light);
    ASSERT_EQ(borders.size(), static_cast<std::size_t>(kBands));
    for (int b = 0; b < kBands; ++b) {
      const double slant = 0.02 * (b + 0.5) * curtain.width / kBands;
      EXPECT_NEAR(borders[b].row - slant, 70.0 + shift, 2.0) << "band " << b;
      if (shift == 0.0) unmoved.push_back(borders[b].row);
      EXPECT_NEAR(borders[b].row, unmoved[b] + shift, 0.1) << "band " << b;
      EXPECT_NEAR(borders[b].row - borders[0].row, slant - 0.02 * 20.0, 0.1);
    }
  }
}

/// Model of the made-up curtain in all bins, with slopes by border_y and fade_px that are exact to 1e-9.
ModelProfile made_model(const Statistics& statistics, const tests::MadeCurtain& curtain) {
  ModelProfile model;
  model.free = 2;
  constexpr double h = 1e-4;
  for (const auto& grid : statistics.grids()) {
    const std::vector<double> light = tests::made_bins(*grid, curtain);
    tests::MadeCurtain c[4] = {curtain, curtain, curtain, curtain};
    c[0].border_y += h, c[1].border_y -= h, c[2].fade_px += h, c[3].fade_px -= h;
    std::vector<double> moved[4];
    for (int k = 0; k < 4; ++k) moved[k] = tests::made_bins(*grid, c[k]);
    for (std::size_t i = 0; i < light.size(); ++i) {
      model.value.push_back(light[i]);
      model.derivative.push_back((moved[0][i] - moved[1][i]) / (2 * h));
      model.derivative.push_back((moved[2][i] - moved[3][i]) / (2 * h));
    }
  }
  return model;
}

/// The gains and the sky move along with the parameters, and their motion is in the slopes: the solution is
/// that of the linear statistics at the same parameters.
TEST(Statistics, SlopesCountTheChangeOfGainsAndSky) {
  tests::MadeCurtain noisy;
  noisy.noise = kNoise;
  const Photo photo = tests::made_photo(noisy);
  sim::Scene scene = tests::small_scene();
  scene.fit.bands = kBands;
  scene.fit.sky_terms = 2;
  scene.fit.weight[sim::StatisticKind::colour] = 0.5;
  scene.fit.weight[sim::StatisticKind::border] = 2.0;
  for (const bool linear : {true, false}) {
    scene.fit.weight[sim::StatisticKind::profile] = linear ? 1.0 : 0.0;
    scene.fit.weight[sim::StatisticKind::horizontal] = scene.fit.weight[sim::StatisticKind::image] =
        linear ? 0.5 : 0.0;
    const Profile data = extract_profile(photo, {10, 4, 200, 110}, kBands);
    const Statistics statistics(scene, photo, data, profile_sigma(data, 0.02), 0.0, {0.02});
    ASSERT_EQ(statistics.linear_counts(), linear);
    ASSERT_EQ(statistics.others().size(), 2u);
    tests::MadeCurtain at = noisy;
    at.border_y += 1.5;
    at.fade_px *= 1.1;
    const auto residuals = [&](const tests::MadeCurtain& curtain, std::vector<double>* jacobian) {
      const ModelProfile model = made_model(statistics, curtain);
      const LinearSolution solution = statistics.linear().solve(model);
      const SolvedLight light = statistics.linear().light(model, solution, data.mean.size());
      std::vector<double> all;
      for (const Statistics::Other& other : statistics.others()) {
        std::vector<double> slopes;
        for (const double r : residuals_of(*other.statistic, light, jacobian != nullptr ? &slopes : nullptr))
          all.push_back(r);
        if (jacobian != nullptr) jacobian->insert(jacobian->end(), slopes.begin(), slopes.end());
      }
      return all;
    };
    std::vector<double> jacobian;
    residuals(at, &jacobian);
    constexpr double h = 1e-3;
    for (int j = 0; j < 2; ++j) {
      tests::MadeCurtain more = at, less = at;
      (j == 0 ? more.border_y : more.fade_px) += h;
      (j == 0 ? less.border_y : less.fade_px) -= h;
      const std::vector<double> up = residuals(more, nullptr), down = residuals(less, nullptr);
      double largest = 0.0;
      for (std::size_t k = 0; k < up.size(); ++k) {
        const double difference = (up[k] - down[k]) / (2 * h);
        largest = std::max(largest, std::abs(difference));
        EXPECT_NEAR(jacobian[k * 2 + j], difference, 1e-4 * (1.0 + std::abs(difference))) << k;
      }
      EXPECT_GT(largest, 0.1);
    }
  }
}

// Beside profiles that do not run along columns, and of a sensor without colours. Granulation looks at the
// region itself, and may stand beside all of them.
TEST(Statistics, RefuseWhatMeansNothingBesideALoopALimbOrAGreySensor) {
  const Photo photo = tests::made_photo({});
  const Profile data = extract_profile(photo, {10, 4, 200, 110}, kBands);
  const auto build = [&](const sim::Scene& scene) {
    Statistics(scene, photo, data, profile_sigma(data, 0.02), 0.0, {0.02});
  };
  using sim::StatisticKind;
  const std::pair<const char*, StatisticKind> refused[] = {
      {"fit.colour_weight", StatisticKind::colour},
      {"fit.horizontal_weight", StatisticKind::horizontal},
      {"fit.border_weight", StatisticKind::border},
      {"fit.image_weight", StatisticKind::image},
      {"fit.texture_weight", StatisticKind::texture}};
  for (const auto& [key, kind] : refused)
    for (const char* along : {"loop", "limb"}) {
      sim::Scene scene = tests::small_scene();
      scene.fit.bands = kBands;
      scene.fit.weight[kind] = 0.5;
      EXPECT_NO_THROW(build(scene)) << key;
      scene.fit.profile_along = tests::kind_named<sim::ProfileAlong>(along);
      const std::string text = tests::expect_error(sim::ErrorKind::scene, [&] { build(scene); });
      EXPECT_NE(text.find(key), std::string::npos) << text;
      EXPECT_NE(text.find(along), std::string::npos) << text;
    }
  sim::Scene grey = tests::small_scene();
  grey.fit.bands = kBands;
  grey.sensor.response = "grey";
  EXPECT_NO_THROW(build(grey));
  grey.fit.weight[sim::StatisticKind::colour] = 0.5;
  const std::string text = tests::expect_error(sim::ErrorKind::scene, [&] { build(grey); });
  EXPECT_NE(text.find("fit.colour_weight"), std::string::npos) << text;
  EXPECT_NE(text.find("grey"), std::string::npos) << text;
}

}  // namespace
}  // namespace vegard::fit::statistics_test
