// The granulation statistic: its derivatives, what it does not depend on, and what it refuses.
#include "fit/compare/granulation_statistic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_id.h"
#include "tests/support/expect_error.h"
#include "tests/support/rendered_photo.h"

namespace vegard::fit::granulation_statistic_test {
namespace {

const char* const kScene = R"(
seed = 5
[emission]
lines = [30.4]
[camera]
width = 40
height = 36
hfov_deg = 0.2
azimuth_deg = 180
elevation_deg = 45
[sun]
shown = true
azimuth_deg = 180
elevation_deg = 45
photosphere_rayleigh = [1000]
[[chromosphere]]
name = "noise"
scale = 60
octaves = 2
coverage = 0.1
rayleigh = [300]
step = 0.5
[blur]
width_deg = [0.0]
[sensor]
response = "grey"
exposure = "gain"
gain_per_kilorayleigh = 0.2
)";

const Region kAll{0, 0, 40, 36};

std::vector<double> residuals_at(const GranulationStatistic& statistic, const sim::Scene& scene) {
  const SolvedLight none;
  const std::vector<sim::ParameterId> numbers;
  const std::vector<double> slopes;
  std::vector<double> residual(statistic.residuals());
  statistic.evaluate({none, scene, numbers, slopes}, residual.data(), nullptr);
  return residual;
}

// Exact through cells, trend, transform and the shift that follows the scale. Turbulence has a kink wherever
// an octave crosses 0, so that differences come near slowly as steps get small: by the scale they are off
// by 2.2 % over 1e-3 of it, 1.2 % over 1e-4 and less over the 3e-5 here, where the film's floats (1e-7) are
// not seen yet.
TEST(GranulationStatistic, HasTheDerivativesOfItsResiduals) {
  sim::Scene scene = sim::parse_scene(kScene, "granules.toml");
  const Photo photo = tests::linear_photo(scene);
  const GranulationStatistic statistic(scene, photo, kAll, 1.0, 0.02, 2);
  ASSERT_GE(statistic.residuals(), 3u);
  sim::Chromosphere& c = scene.chromospheres[0];
  c.scale = 63.0;
  double* const numbers[] = {&c.scale, &c.coverage, &c.roughness};
  std::vector<sim::ParameterId> free;
  for (const char* path : {"chromosphere.scale", "chromosphere.coverage", "chromosphere.roughness"})
    free.push_back(sim::parameter_at(scene, path).value());
  SolvedLight light;
  light.free = 3;
  const std::vector<double> identity;
  std::vector<double> residual(statistic.residuals()), jacobian(statistic.residuals() * 3);
  statistic.evaluate({light, scene, free, identity}, residual.data(), jacobian.data());
  for (int j = 0; j < 3; ++j) {
    const double at = *numbers[j], step = 3e-5 * at;
    *numbers[j] = at + step;
    const std::vector<double> more = residuals_at(statistic, scene);
    *numbers[j] = at - step;
    const std::vector<double> less = residuals_at(statistic, scene);
    *numbers[j] = at;
    double off = 0.0, length = 0.0;
    for (std::size_t k = 0; k < residual.size(); ++k) {
      const double difference = (more[k] - less[k]) / (2.0 * step);
      off += std::pow(jacobian[k * 3 + j] - difference, 2);
      length += difference * difference;
    }
    EXPECT_GT(length, 0.0) << j;
    EXPECT_LT(std::sqrt(off / length), 0.02) << j;
  }
}

// A picture that is ten times as bright tells the same of its granules, to a hundredth of
// the residuals' sigma.
TEST(GranulationStatistic, KnowsNoBrightness) {
  const sim::Scene scene = sim::parse_scene(kScene, "granules.toml");
  const Photo photo = tests::linear_photo(scene);
  Photo brighter = photo;
  for (float& light : brighter.linear.data) light *= 10.0f;
  const std::vector<double> a = residuals_at(GranulationStatistic(scene, photo, kAll, 1.0, 0.02, 2), scene),
                            b = residuals_at(GranulationStatistic(scene, brighter, kAll, 1.0, 0.02, 2),
                                             scene);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 0.01) << k;
}

TEST(GranulationStatistic, SaysWhatIsMissing) {
  const sim::Scene scene = sim::parse_scene(kScene, "granules.toml");
  const Photo photo = tests::linear_photo(scene);
  const auto refused = [&](const sim::Scene& other, const Region& region, const char* word) {
    const std::string text = tests::expect_error(
        sim::ErrorKind::scene, [&] { GranulationStatistic(other, photo, region, 1.0, 0.02, 2); });
    EXPECT_NE(text.find("fit.granulation_weight"), std::string::npos) << text;
    EXPECT_NE(text.find(word), std::string::npos) << text;
  };
  sim::Scene bare = scene;
  bare.chromospheres.clear();
  refused(bare, kAll, "no chromosphere");
  refused(scene, {0, 0, 12, 12}, "too small");
  sim::Scene aside = scene;
  aside.sun.azimuth_deg = 181.0;
  refused(aside, kAll, "too little of the Sun's disc");
}

// Cells of one pixel and of two: the photograph's noise is in the power of its rings as it would be were its
// variance known. A median of 7200 and of 4600 pixels tells a variance to 5 and 7 %; the granules' own
// unevenness from pixel to pixel, a hundredth of the light, counts for some per cent more.
TEST(GranulationStatistic, KnowsThePhotographsNoise) {
  for (const int cell : {1, 2}) {
    sim::Scene scene = sim::parse_scene(kScene, "granules.toml");
    scene.camera.width = cell == 1 ? 90 : 136;
    scene.camera.height = cell == 1 ? 80 : 34;
    scene.camera.hfov_deg = 0.2 / 120.0 * scene.camera.width;
    const Region all{0, 0, scene.camera.width, scene.camera.height};
    constexpr double kNoise = 0.05;
    const Photo photo = tests::noisy_photo(scene, kNoise, 5);
    const GranulationStatistic statistic(scene, photo, all, 1.0, 0.02, 2);
    ASSERT_GE(statistic.residuals(), 1u);
    std::vector<double> light;
    for (int y = 0; y + cell <= all.height; y += cell)
      for (int x = 0; x + cell <= all.width; x += cell) {
        double sum = 0.0;
        for (int i = 0; i < cell * cell; ++i) sum += photo.linear.at(x + i % cell, y + i / cell, 1);
        light.push_back(sum / (cell * cell));
      }
    const PowerSpectrum& spectrum = statistic.spectrum();
    const double known = spectrum.noise_power(
        spectrum.of(light), std::vector<double>(light.size(), kNoise * kNoise / (cell * cell)));
    EXPECT_GT(known, 0.0);
    for (const GranulationStatistic::Band& band : statistic.bands())
      EXPECT_NEAR(band.noise_power / known, 1.0, cell == 1 ? 0.15 : 0.24) << cell << " px";
  }
}

// Nothing but noise, of a thirtieth of the light, in cells of one pixel: nothing is left to compare.
TEST(GranulationStatistic, SaysThatAllIsNoise) {
  const sim::Scene scene = sim::parse_scene(kScene, "granules.toml");
  Photo photo = tests::noisy_photo(scene, 0.0, 1);
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal(0.3, 0.01);
  for (float& value : photo.linear.data) value = static_cast<float>(normal(random));
  const std::string text = tests::expect_error(
      sim::ErrorKind::unreadable_input, [&] { GranulationStatistic(scene, photo, kAll, 1.0, 0.02, 2); });
  EXPECT_NE(text.find("noise"), std::string::npos) << text;
  EXPECT_NE(text.find("fit.granulation_weight"), std::string::npos) << text;
  EXPECT_NE(text.find("fit.roi_px"), std::string::npos) << text;
}

}  // namespace
}  // namespace vegard::fit::granulation_statistic_test
