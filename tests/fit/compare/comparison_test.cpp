// Statistics of rendered pictures: the Jacobian of each and of a mix, and what a comparison says of itself.
//
// The differences are those of a film in floats, with the kinks of the bilinear splat (profile_cost_test.cpp
// has what that costs: a column of the Jacobian differs by up to 1.6 % of its norm for the profile).
#include "fit/compare/comparison.h"
#include "fit/compare/inflation.h"
#include "fit/measure/profile_bins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fit/measure/noise_model.h"
#include "fit/parameters/free_parameters.h"
#include "fit/uncertainty/uncertainty.h"
#include "sim/render/render.h"
#include "tests/support/free_paths.h"
#include "tests/support/kind_named.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::comparison_test {
namespace {

const Region kRegion{10, 10, 140, 100};

sim::Scene scene_of_few() {
  sim::Scene scene = tests::small_scene();
  scene.camera.roll_deg = 2.0;
  scene.sheets[0].length_km = 280.0;
  scene.sheets[0].beams = 4000;
  scene.blur.width_deg = {0.43, 0.4, 0.4};
  scene.sky.level = {0.02, 0.03, 0.05};
  scene.fit.bands = 4;
  scene.fit.sky_terms = 2;
  scene.fit.model_error = 0.05;
  for (const char* path : {"sheet.main.center_km.north", "sheet.main.energy_kev", "camera.elevation_deg"})
    scene.fit.free.push_back(tests::free_entry(path));
  return scene;
}

Photo photo_of(const sim::Scene& scene) {
  Photo photo;
  photo.linear = sim::render(scene).rgb;
  photo.usable.assign(photo.linear.data.size(), 1);
  for (std::size_t i = 0; i < photo.usable.size(); i += 97) photo.usable[i] = 0;
  photo.floating = true;
  photo.srgb = false;
  return photo;
}

const Photo& photo_of_elsewhere() {
  static const Photo photo = [] {
    sim::Scene elsewhere = scene_of_few();
    elsewhere.sheets[0].center_km.north += 6.0;
    elsewhere.sheets[0].energy_kev *= 1.2;
    return photo_of(elsewhere);
  }();
  return photo;
}

std::unique_ptr<Comparison> compared(const sim::Scene& scene, const Photo& photo, double smooth_rows = 0.0) {
  Profile data = extract_profile(photo, std::make_shared<const BinGrid>(profile_bins(scene, kRegion)));
  std::vector<double> sigma = profile_sigma(data, scene.fit.model_error);
  return std::make_unique<Comparison>(scene, photo, std::move(data), std::move(sigma),
                                      Comparison::Resolution{1.0, smooth_rows, 2});
}

constexpr double kSteps[] = {0.004, 0.002, 1.5e-3};  // as in profile_cost_test.cpp

/// `tolerance`: of a column's norm.
void expect_jacobian(const sim::Scene& scene, double smooth_rows, double tolerance) {
  const std::unique_ptr<Comparison> comparison = compared(scene, photo_of_elsewhere(), smooth_rows);
  const std::vector<FreeNumber> free = free_numbers(scene);
  const ParameterMap map(scene, free);
  std::vector<double> start;
  std::vector<int> all;
  for (const FreeNumber& number : free) {
    all.push_back(static_cast<int>(all.size()));
    start.push_back(number.start);
  }
  const Comparison::Point point = comparison->at(scene, map.motion(start, all, scene));
  const std::size_t p = free.size(), n = point.residual().size();
  ASSERT_EQ(n, static_cast<std::size_t>(comparison->residuals()));
  ASSERT_GT(n, 0u);
  std::vector<double> jacobian;
  comparison->jacobian(point, jacobian);
  ASSERT_EQ(jacobian.size(), n * p);
  for (std::size_t j = 0; j < p; ++j) {
    SCOPED_TRACE(free[j].path);
    const auto at = [&](double step) {
      std::vector<double> values = start;
      values[j] += step;
      sim::Scene moved = scene;
      map.put(values, moved);
      return comparison->at(moved).residual();
    };
    const std::vector<double> up = at(kSteps[j]), down = at(-kSteps[j]);
    double error = 0.0, size = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const double difference = (up[k] - down[k]) / (2 * kSteps[j]);
      error += std::pow(jacobian[k * p + j] - difference, 2);
      size += difference * difference;
    }
    EXPECT_GT(size, 0.0);
    EXPECT_LT(std::sqrt(error / size), tolerance);
  }
  double chi2 = 0.0;
  int residuals = 0;
  for (const Comparison::Share& share : comparison->shares(point)) {
    chi2 += share.chi2;
    residuals += share.residuals;
  }
  EXPECT_EQ(residuals, comparison->residuals());
  EXPECT_NEAR(chi2, point.chi2, 1e-9 * chi2);
}

sim::Scene with(const std::function<void(sim::Fit&)>& change) {
  sim::Scene scene = scene_of_few();
  scene.fit.weight[sim::StatisticKind::profile] = 0.0;
  change(scene.fit);
  return scene;
}

TEST(Comparison, JacobianOfEachStatisticAgreesWithDifferences) {
  expect_jacobian(with([](sim::Fit& fit) { fit.weight[sim::StatisticKind::colour] = 1.0; }), 0.0, 0.03);
  expect_jacobian(with([](sim::Fit& fit) { fit.weight[sim::StatisticKind::border] = 1.0; }), 0.0, 0.03);
  expect_jacobian(with([](sim::Fit& fit) { fit.weight[sim::StatisticKind::horizontal] = 1.0; }), 0.0, 0.03);
  expect_jacobian(with([](sim::Fit& fit) { fit.weight[sim::StatisticKind::image] = 1.0; }), 0.0, 0.03);
}

TEST(Comparison, JacobianOfAMixAgreesWithDifferences) {
  for (const double smooth_rows : {0.0, 3.0})
    expect_jacobian(with([](sim::Fit& fit) {
                      fit.weight[sim::StatisticKind::profile] = 1.0;
                      fit.weight[sim::StatisticKind::colour] = 0.5;
                      fit.weight[sim::StatisticKind::horizontal] = 0.3;
                      fit.weight[sim::StatisticKind::border] = 2.0;
                      fit.weight[sim::StatisticKind::image] = 0.4;
                    }),
                    smooth_rows, 0.03);
}

TEST(Comparison, JacobianOfProfilesAlongElevationAndFieldAgreesWithDifferences) {
  for (const char* along : {"elevation", "field"})
    expect_jacobian(with([&](sim::Fit& fit) {
                      fit.weight[sim::StatisticKind::profile] = 1.0;
                      fit.profile_along = tests::kind_named<sim::ProfileAlong>(along);
                    }),
                    0.0, 0.03);
}

TEST(Comparison, ProfileAloneIsTheLinearPart) {
  const sim::Scene scene = with([](sim::Fit& fit) { fit.weight[sim::StatisticKind::profile] = 1.0; });
  const std::unique_ptr<Comparison> comparison = compared(scene, photo_of_elsewhere());
  const Comparison::Point point = comparison->at(scene);
  EXPECT_EQ(point.residual(), point.solution.residual);
  EXPECT_EQ(point.chi2, point.solution.chi2);
  EXPECT_EQ(comparison->profile_part(point).used, comparison->linear().used());
  const Inflation inflation = comparison->error_inflation(point, 100);
  const Inflation expected =
      error_inflation(comparison->data(), comparison->linear().used(), point.residual(), 100);
  EXPECT_EQ(inflation.scale, expected.scale);
  EXPECT_EQ(inflation.correlated, expected.correlated);
}

/// Other statistics beside it change neither the profile nor, with next to no weight, the solution.
TEST(Comparison, ProfilePartIsThatOfAMix) {
  // A draw has the same film for either; the mean has wide cells where profiles alone are compared.
  const auto alone = with([](sim::Fit& fit) {
    fit.weight[sim::StatisticKind::profile] = 1.0;
    fit.model = sim::FitModel::draws;
  });
  const auto mixed = with([](sim::Fit& fit) {
    fit.weight[sim::StatisticKind::profile] = 1.0;
    fit.model = sim::FitModel::draws;
    fit.weight[sim::StatisticKind::image] = 1e-9;
    fit.weight[sim::StatisticKind::colour] = 1e-9;
  });
  const std::unique_ptr<Comparison> one = compared(alone, photo_of_elsewhere()),
                                    both = compared(mixed, photo_of_elsewhere());
  const Comparison::Point a = one->at(alone), b = both->at(mixed);
  const Comparison::ProfilePart part = both->profile_part(b);
  EXPECT_EQ(part.used, one->linear().used());
  ASSERT_EQ(part.residual.size(), a.residual().size());
  for (std::size_t k = 0; k < part.residual.size(); ++k) EXPECT_NEAR(part.residual[k], a.residual()[k], 1e-3);
  EXPECT_EQ(both->profile_model(b).size(), both->data().mean.size());
  EXPECT_EQ(both->shares(b).size(), 3u);
}

/// A sheet farther to the north stands lower in the picture; where the model is the photograph's own scene,
/// nothing is left. Cells of the film one pixel wide, as the photograph's are.
TEST(Comparison, BorderMovesWithTheSheet) {
  sim::Scene scene = with([](sim::Fit& fit) {
    fit.weight[sim::StatisticKind::border] = 1.0;
    fit.bands = 14;
  });
  scene.sheets[0].spacing_jitter = 0.0;
  const Photo photo = photo_of(scene);
  const std::unique_ptr<Comparison> comparison = compared(scene, photo);
  ASSERT_GT(comparison->residuals(), 10);
  EXPECT_EQ(comparison->coefficients(), 0) << "gains and sky cost the border nothing";
  const std::vector<double> at_truth = comparison->at(scene).residual();
  for (const double r : at_truth) EXPECT_LT(std::abs(r), 1.0);
  sim::Scene farther = scene;
  farther.sheets[0].center_km.north += 10.0;
  const std::vector<double> at_farther = comparison->at(farther).residual();
  for (const double r : at_farther) EXPECT_LT(r, -3.0) << "lower: at a larger row";
}

}  // namespace
}  // namespace vegard::fit::comparison_test
