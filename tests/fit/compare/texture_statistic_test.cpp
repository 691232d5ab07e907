// Texture of made-up rays: the simulator's own process along a sheet, seen by a camera, without a rendering.
#include "fit/compare/texture_statistic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/base/number/gaussian_process.h"
#include "sim/render/film.h"
#include "sim/scene/table/parameter_id.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::texture_statistic_test {
namespace {

constexpr double kContrast = 0.5, kWidthKm = 1.5, kSky = 0.05, kNoise = 0.02;
constexpr int kBands = 4;

/// One thin layer, right across the view, 200 km away: 480 pixels at about a fifth of a kilometre each.
sim::Scene scene_of_rays() {
  sim::Scene scene = tests::small_scene();
  scene.camera.width = 480;
  scene.camera.height = 40;
  scene.camera.azimuth_deg = 0.0;
  scene.camera.elevation_deg = 25.0;
  scene.camera.roll_deg = 0.0;
  scene.camera.hfov_deg = 25.0;
  sim::Sheet& sheet = scene.sheets[0];
  sheet.center_km = {0.0, 200.0};
  sheet.bearing_deg = 80.0;
  sheet.layers = 1;
  sheet.width_km = 0.3;
  scene.blur.width_deg = {0.2, 0.1, 0.1};
  scene.fit.bands = kBands;
  return scene;
}

/// Rays by their formula, averaged over what a pixel smears, 24 rows of the same light, noise.
Photo photo_of_rays(const sim::Scene& scene, unsigned seed, double contrast = kContrast) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  sim::GaussianProcess process(seed, sim::Stream::ray_light, 0, kWidthKm, 0.0, 0.0);
  Photo photo;
  photo.linear = sim::Image(scene.camera.width, scene.camera.height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  double along = 0.0;
  for (int x = 0; x < scene.camera.width; ++x) {
    const SheetInView seen = *sheet_in_view(scene, scene.sheets[0], x + 0.5, 20.0);
    along += seen.km_per_px;
    double light = 0.0, weight = 0.0;
    const double smear = std::sqrt(seen.smear_km2);
    for (double d = -3.0; d <= 3.0; d += 0.25) {
      const double w = std::exp(-0.5 * d * d);
      light += w * std::exp(contrast * process.at(along + d * smear) - 0.5 * contrast * contrast);
      weight += w;
    }
    for (int y = 0; y < scene.camera.height; ++y)
      for (int c = 0; c < 3; ++c)
        photo.linear.at(x, y, c) = static_cast<float>(
            kSky + (y >= 10 && y < 34 ? 0.4 * light / weight : 0.0) + kNoise * normal(random));
  }
  return photo;
}

const Region kWhole{0, 0, 480, 40};

std::vector<double> residuals_of(const TextureStatistic& texture, const sim::Scene& scene,
                                 const std::vector<sim::ParameterId>& numbers = {},
                                 std::vector<double>* jacobian = nullptr) {
  SolvedLight light;
  light.free = static_cast<int>(numbers.size());
  std::vector<double> residual(texture.residuals());
  if (jacobian != nullptr) jacobian->resize(residual.size() * numbers.size());
  const std::vector<double> identity;
  texture.evaluate({light, scene, numbers, identity}, residual.data(),
                   jacobian != nullptr ? jacobian->data() : nullptr);
  return residual;
}

TEST(RayCovariance, WithoutASmearIsThatOfTheLogarithm) {
  const sim::Rays rays{0.8, 2.0};
  for (const double apart : {0.0, 0.3, 1.0, 3.0})
    EXPECT_NEAR(sim::ray_log_covariance(rays, 0.0, apart),
                0.64 * std::exp(-4.0 * std::log(2.0) * apart * apart / 4.0), 1e-9);
}

/// The covariance of the light itself, smeared, by a sum over the kernel of exp(c^2 rho) - 1.
TEST(RayCovariance, OfASmearIsTheConvolution) {
  const sim::Rays rays{0.9, 2.0};
  constexpr double kSmear = 0.7;  // km^2
  for (const double apart : {0.0, 1.5}) {
    double sum = 0.0, weight = 0.0;
    for (double d = -12.0; d <= 12.0; d += 0.01) {
      const double w = std::exp(-0.25 * d * d / kSmear);  // two smears together
      const double at = apart + d, rho = std::exp(-4.0 * std::log(2.0) * at * at / 4.0);
      sum += w * (std::exp(0.81 * rho) - 1.0);
      weight += w;
    }
    EXPECT_NEAR(sim::ray_log_covariance(rays, kSmear, apart), std::log1p(sum / weight), 1e-6);
  }
}

/// Scale at the middle of a picture that faces the sheet: distance over focal length.
TEST(SheetInView, FacingItAKilometreIsTheDistanceOverTheFocalLength) {
  sim::Scene scene = scene_of_rays();
  scene.sheets[0].bearing_deg = 90.0;
  scene.camera.elevation_deg = 0.0;
  const auto seen = sheet_in_view(scene, scene.sheets[0], 240.0, 20.0);
  ASSERT_TRUE(seen);
  const double focal = 240.0 / std::tan(12.5 * std::acos(-1.0) / 180.0);
  EXPECT_NEAR(seen->km_per_px, 200.0 / focal, 1e-9);
  const double blur = sim::blur_sigma_px(scene, 1);
  EXPECT_NEAR(seen->smear_km2, seen->km_per_px * seen->km_per_px * (blur * blur + 1.0 / 12.0), 1e-9)
      << "seen straight on, depth does not smear";
  scene.sheets[0].center_km.north = -200.0;
  EXPECT_FALSE(sheet_in_view(scene, scene.sheets[0], 240.0, 20.0)) << "behind";
}

// Thirty pictures of other rays, seeds 1 to 30. Each gives a contrast and a width that scatter about the
// truth by their error bars: the mean of 30 by 0.18 of one, and 0.13 is the standard error of a spread of 30.
// A picture whose rays chance has made so alike that they tell too little may say so, and has no error bars;
// more than one in ten would be no chance.
// About 20 residuals a picture less the two that are solved for: 600 numbers, sqrt(2 / 600) = 0.06; products
// of Gaussian numbers scatter more than Gaussian numbers do, twice that. Four times these, rounded down.
TEST(TextureStatistic, DoesNotDependOnWhereRaysStand) {
  const sim::Scene scene = scene_of_rays();
  double squares = 0.0, numbers = 0.0, contrast = 0.0, width = 0.0, contrast2 = 0.0, width2 = 0.0;
  constexpr int kPictures = 30;
  int told = 0;
  for (unsigned seed = 1; seed <= kPictures; ++seed) {
    const TextureStatistic texture(scene, photo_of_rays(scene, seed), kWhole, 1.0);
    ASSERT_GT(texture.residuals(), 8u);
    for (const double r : residuals_of(texture, scene)) squares += r * r;
    numbers += static_cast<double>(texture.residuals()) - 2.0;
    const auto solved = texture.solved(scene);
    ASSERT_EQ(solved.size(), 2u);
    if (solved[0].sigma == 0.0 || solved[1].sigma == 0.0) continue;
    const double c = (solved[0].value - kContrast) / solved[0].sigma,
                 w = (solved[1].value - kWidthKm) / solved[1].sigma;
    ++told;
    contrast += c;
    width += w;
    contrast2 += c * c;
    width2 += w * w;
  }
  ASSERT_GE(told, kPictures - 3);
  for (double* mean : {&contrast, &width, &contrast2, &width2}) *mean /= told;
  EXPECT_NEAR(squares / numbers, 1.0, 0.4);
  EXPECT_NEAR(contrast, 0.0, 0.7);
  EXPECT_NEAR(width, 0.0, 0.7);
  EXPECT_NEAR(std::sqrt(contrast2), 1.0, 0.5);
  EXPECT_NEAR(std::sqrt(width2), 1.0, 0.5);
}

TEST(TextureStatistic, OfEvenLightThereIsNone) {
  const sim::Scene scene = scene_of_rays();
  const TextureStatistic texture(scene, photo_of_rays(scene, 1, 0.0), kWhole, 1.0);
  EXPECT_EQ(texture.residuals(), 0u);
  EXPECT_TRUE(texture.solved(scene).empty());
}

TEST(TextureStatistic, SlopesAgreeWithDifferences) {
  const sim::Scene scene = scene_of_rays();
  const TextureStatistic texture(scene, photo_of_rays(scene, 5), kWhole, 2.0);
  using sim::ParameterRole;
  const std::vector<sim::ParameterId> numbers = {
      sim::parameter_with(ParameterRole::centre, 0, 1), sim::parameter_with(ParameterRole::bearing, 0),
      sim::parameter_with(ParameterRole::camera_azimuth), sim::parameter_with(ParameterRole::energy, 0),
      sim::parameter_with(ParameterRole::field_of_view)};
  std::vector<double> jacobian;
  residuals_of(texture, scene, numbers, &jacobian);
  constexpr double h = 0.02;
  for (std::size_t j = 0; j < numbers.size(); ++j) {
    const auto at = [&](double step) {
      sim::Scene moved = scene;
      *sim::number_at(moved, numbers[j]) += step;
      return residuals_of(texture, moved);
    };
    const std::vector<double> up = at(h), down = at(-h);
    double size = 0.0;
    for (std::size_t k = 0; k < up.size(); ++k) {
      const double difference = (up[k] - down[k]) / (2.0 * h);
      size = std::max(size, std::abs(difference));
      EXPECT_NEAR(jacobian[k * numbers.size() + j], difference, 1e-4) << "number " << j;
    }
    if (j == 3)
      EXPECT_EQ(size, 0.0) << "electrons have no place in it";
    else
      EXPECT_GT(size, 1e-3) << "number " << j;
  }
}

}  // namespace
}  // namespace vegard::fit::texture_statistic_test
