#include "fit/parameters/phase_anchor.h"
#include "fit/uncertainty/sampled_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fit/compare/observation.h"
#include "tests/support/free_paths.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::phase_anchor_test {
namespace {

constexpr double kPi = 3.141592653589793;

/// Two sheets of which everything of the sine may move, and an energy that has nothing to do with it.
sim::Scene two_sines() {
  sim::Scene scene = tests::small_scene();
  scene.blur.width_deg = {0.43, 0.25, 0.3};
  scene.fit.bands = 6;
  scene.sheets[0].name = "near";
  scene.sheets[0].beams = 2000;
  scene.sheets[0].phase_rad = 0.7;
  scene.sheets.push_back(scene.sheets[0]);
  scene.sheets[1].name = "far";
  scene.sheets[1].center_km = {-20.0, 225.0};
  scene.sheets[1].bearing_deg = 95.0;
  scene.sheets[1].wavelength_km = 80.0;
  for (const char* path : {"sheet.near.phase_rad", "sheet.far.wavelength_km", "sheet.near.energy_kev",
                           "sheet.near.wavelength_km", "sheet.far.phase_rad", "sheet.far.thickness_km"})
    scene.fit.free.push_back(tests::free_entry(path));
  // Limits bend the coordinates, so that slopes are not 1.
  scene.fit.free[1].min = 40.0;
  scene.fit.free[1].max = 200.0;
  return scene;
}

struct Fitting {
  sim::Scene scene = two_sines();
  std::vector<FreeNumber> free = free_numbers(scene);
  Photo photo;
  std::vector<Observation> observations;
  EvaluationLog log;

  Fitting() {
    sim::Scene elsewhere = scene;
    elsewhere.sheets[0].phase_rad += 0.2;
    elsewhere.sheets[1].wavelength_km *= 1.05;
    photo = tests::rendered_photo(elsewhere);
    observations.push_back(observed(scene, photo, 2));
  }
  ProfileCost cost(const std::vector<PhaseAnchor>& anchors) {
    ProfileCost::Options options;
    options.anchors = anchors;
    return ProfileCost(free, cost_terms(observations, free, Detail::full), log, options);
  }
  std::vector<double> start() const {
    std::vector<double> values;
    for (const FreeNumber& number : free) values.push_back(number.start);
    return values;
  }
};

TEST(PhaseAnchor, IsWhereTheCameraLooksAtTheSheet) {
  sim::Scene scene = tests::small_scene();
  scene.sheets[0].bearing_deg = 90.0;
  scene.sheets[0].center_km = {20.0, 200.0};
  scene.sheets[0].length_km = 300.0;
  scene.fit.free = {tests::free_entry("sheet.main.wavelength_km"), tests::free_entry("sheet.main.phase_rad")};
  const std::vector<FreeNumber> free = free_numbers(scene);
  const auto distance_km = [&](double azimuth_deg) {
    scene.camera.azimuth_deg = azimuth_deg;
    const std::vector<PhaseAnchor> anchors = phase_anchors(scene, free, {60.0, 0.0});
    EXPECT_EQ(anchors.size(), 1u);
    EXPECT_EQ(anchors[0].wavelength, 0);
    EXPECT_EQ(anchors[0].phase, 1);
    EXPECT_EQ(anchors[0].start_wavelength_km, 60.0);
    return anchors[0].distance_km;
  };
  // The line runs east, 200 km north of the camera, and starts at 20 - 150 km east.
  EXPECT_NEAR(distance_km(0.0), 130.0, 1e-9);
  EXPECT_NEAR(distance_km(std::atan2(50.0, 200.0) * 180.0 / kPi), 180.0, 1e-9);
  EXPECT_NEAR(distance_km(180.0), 150.0, 1e-9) << "seen from behind: the middle";
  EXPECT_NEAR(distance_km(60.0), 150.0, 1e-9) << "beyond the sheet's end: the middle";
  EXPECT_NEAR(distance_km(89.0), 150.0, 1e-9) << "along the sheet: the middle";
  scene.fit.free.pop_back();
  EXPECT_TRUE(phase_anchors(scene, free_numbers(scene), {60.0}).empty()) << "no phase is free";
}

TEST(PhaseAnchor, HoldsTheSineInViewWhileTheWavelengthMoves) {
  Fitting fit;
  const std::vector<PhaseAnchor> anchors = phase_anchors(fit.scene, fit.free, fit.start());
  ASSERT_EQ(anchors.size(), 2u);
  const ProfileCost cost = fit.cost(anchors);
  const std::vector<double> start = fit.start();
  std::vector<double> u = cost.coordinates(start);
  for (const PhaseAnchor& a : anchors) u[a.wavelength] += 0.3;
  const std::vector<double> moved = cost.values(u.data());
  for (const PhaseAnchor& a : anchors) {
    EXPECT_GT(std::abs(moved[a.wavelength] - start[a.wavelength]), 1.0);
    const auto in_view = [&](const std::vector<double>& values) {
      return 2.0 * kPi * a.distance_km / values[a.wavelength] + values[a.phase];
    };
    EXPECT_NEAR(in_view(moved), in_view(start), 1e-9);
  }
}

TEST(PhaseAnchor, CoordinatesGoThereAndBack) {
  Fitting fit;
  const std::vector<double> start = fit.start();
  const ProfileCost cost = fit.cost(phase_anchors(fit.scene, fit.free, start));
  std::vector<double> elsewhere = start;
  elsewhere[0] += 0.4;
  elsewhere[1] *= 1.03;
  elsewhere[3] *= 0.98;
  elsewhere[4] -= 1.0;
  for (const std::vector<double>& values : {start, elsewhere}) {
    const std::vector<double> back = cost.values(cost.coordinates(values).data());
    for (std::size_t j = 0; j < values.size(); ++j)
      EXPECT_NEAR(back[j], values[j], 1e-9 * std::max(1.0, std::abs(values[j]))) << fit.free[j].label();
  }
}

/// Away from where the anchors were set, so that their own derivatives are not those at the start. The
/// tolerance is that of profile_cost_test.cpp: what a film in floats shows of a step of a hundredth pixel.
TEST(PhaseAnchor, JacobianByCoordinatesAgreesWithDifferences) {
  Fitting fit;
  std::vector<double> values = fit.start();
  const ProfileCost cost = fit.cost(phase_anchors(fit.scene, fit.free, values));
  values[0] += 0.3;
  values[1] *= 1.04;
  values[3] *= 0.97;
  const std::vector<double> u = cost.coordinates(values);
  const std::size_t p = u.size(), n = static_cast<std::size_t>(cost.num_residuals());
  const auto residuals = [&](const std::vector<double>& at, std::vector<double>* jacobian) {
    std::vector<double> r(n);
    if (jacobian != nullptr) jacobian->resize(n * p);
    double* rows[] = {jacobian != nullptr ? jacobian->data() : nullptr};
    const double* blocks[] = {at.data()};
    EXPECT_TRUE(cost.Evaluate(blocks, r.data(), jacobian != nullptr ? rows : nullptr));
    return r;
  };
  std::vector<double> jacobian;
  residuals(u, &jacobian);
  for (std::size_t j = 0; j < p; ++j) {
    SCOPED_TRACE(fit.free[j].label());
    const double step = 2e-3;
    std::vector<double> more = u, less = u;
    more[j] += step;
    less[j] -= step;
    const std::vector<double> up = residuals(more, nullptr), down = residuals(less, nullptr);
    double error = 0.0, size = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const double difference = (up[k] - down[k]) / (2.0 * step);
      error += std::pow(jacobian[k * p + j] - difference, 2);
      size += difference * difference;
    }
    ASSERT_GT(size, 0.0);
    EXPECT_LT(std::sqrt(error / size), 0.03);
  }
}

/// The covariance of the phases at the sheets' starts is T C T', T being what the coordinates do to each
/// other: here by differences of the transforms themselves.
TEST(PhaseAnchor, WithoutAnchorsTheCovarianceIsThatOfThePhaseAtTheStart) {
  Fitting fit;
  const std::vector<double> values = fit.start();
  const std::vector<PhaseAnchor> anchors = phase_anchors(fit.scene, fit.free, values);
  const ProfileCost anchored = fit.cost(anchors), plain = fit.cost({});
  const std::size_t p = values.size();
  const std::vector<double> u = anchored.coordinates(values);
  std::vector<std::vector<double>> t(p, std::vector<double>(p));
  for (std::size_t j = 0; j < p; ++j) {
    const double step = 1e-5;
    std::vector<double> more = u, less = u;
    more[j] += step;
    less[j] -= step;
    const std::vector<double> up = plain.coordinates(anchored.values(more.data())),
                              down = plain.coordinates(anchored.values(less.data()));
    for (std::size_t i = 0; i < p; ++i) t[i][j] = (up[i] - down[i]) / (2.0 * step);
  }
  EXPECT_GT(std::abs(t[0][3]), 0.1) << "the wavelength turns the phase";
  EXPECT_GT(std::abs(t[4][1]), 0.1);

  Uncertainty u_bars;  // any covariance will do: L L' of a lower triangle
  u_bars.covariance.assign(p, std::vector<double>(p, 0.0));
  u_bars.correlation = u_bars.covariance;
  const auto lower = [](std::size_t i, std::size_t k) {
    return k > i ? 0.0 : 0.02 * (1.0 + static_cast<double>(i)) * std::cos(3.0 * i + 5.0 * k);
  };
  for (std::size_t i = 0; i < p; ++i)
    for (std::size_t j = 0; j < p; ++j)
      for (std::size_t k = 0; k < p; ++k) u_bars.covariance[i][j] += lower(i, k) * lower(j, k);
  const std::vector<std::vector<double>> c = u_bars.covariance;
  u_bars.sigma.resize(p);
  for (std::size_t j = 0; j < p; ++j) u_bars.sigma[j] = std::sqrt(c[j][j]);
  u_bars.undetermined = {{0.0, 1.0, 0.0, 0.0, 0.5, 0.0}};

  without_anchors(anchors, fit.free, values, u_bars);
  const auto expected = [&](std::size_t i, std::size_t j) {
    double sum = 0.0;
    for (std::size_t k = 0; k < p; ++k)
      for (std::size_t l = 0; l < p; ++l) sum += t[i][k] * c[k][l] * t[j][l];
    return sum;
  };
  for (std::size_t i = 0; i < p; ++i)
    for (std::size_t j = 0; j < p; ++j) {
      const double both = std::sqrt(expected(i, i) * expected(j, j));
      EXPECT_NEAR(u_bars.covariance[i][j], expected(i, j), 1e-6 * both) << i << ", " << j;
      EXPECT_NEAR(u_bars.correlation[i][j], expected(i, j) / both, 1e-6);
      if (i == j) {
        EXPECT_NEAR(u_bars.sigma[i], both / u_bars.sigma[i], 1e-6 * u_bars.sigma[i]);
      }
    }
  for (std::size_t i = 0; i < p; ++i) {
    double direction = t[i][1] + 0.5 * t[i][4];
    EXPECT_NEAR(u_bars.undetermined[0][i], direction, 1e-6 * std::max(1.0, std::abs(direction)));
  }
}

TEST(PhaseAnchor, APhaseHasNoErrorBarAtTheStartWithoutItsWavelengths) {
  Fitting fit;
  const std::vector<double> values = fit.start();
  const std::vector<PhaseAnchor> anchors = phase_anchors(fit.scene, fit.free, values);
  const std::size_t p = values.size();
  Uncertainty u;
  u.sigma.assign(p, 0.1);
  u.covariance.assign(p, std::vector<double>(p, 0.0));
  u.correlation = u.covariance;
  for (std::size_t j = 0; j < p; ++j) u.covariance[j][j] = 0.01;
  u.sigma[3] = std::numeric_limits<double>::quiet_NaN();  // the near sheet's wavelength
  without_anchors(anchors, fit.free, values, u);
  EXPECT_TRUE(std::isnan(u.sigma[0])) << "the near sheet's phase";
  EXPECT_TRUE(std::isnan(u.sigma[3]));
  EXPECT_FALSE(std::isnan(u.sigma[4])) << "the far sheet's is none of its business";
  EXPECT_EQ(u.sigma[2], 0.1);
  for (std::size_t j = 0; j < p; ++j) EXPECT_EQ(u.correlation[0][j], 0.0);
}

}  // namespace
}  // namespace vegard::fit::phase_anchor_test
