#include "fit/photo/pointing/calibration.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "tests/support/expect_error.h"
#include "tests/support/star_field.h"

namespace vegard::tests::calibration_test {
namespace {

using sim::LensModel;

const fit::Frame kFrame{640, 480, true};

/// The largest distance between where two cameras see the stars.
double farthest_px(const fit::SkyCamera& a, const fit::SkyCamera& b,
                   const std::vector<fit::StarSighting>& stars) {
  double farthest = 0.0;
  for (const fit::StarSighting& star : stars) {
    double ax = 0.0, ay = 0.0, bx = 1e9, by = 1e9;
    EXPECT_TRUE(fit::place_of_star(a, star.enu, ax, ay));
    EXPECT_TRUE(fit::place_of_star(b, star.enu, bx, by));
    farthest = std::max(farthest, std::hypot(ax - bx, ay - by));
  }
  return farthest;
}

fit::LensSettings only(LensModel model, int radial = 0, bool decentring = false, bool aspect = false) {
  fit::LensSettings settings;
  settings.model = model;
  settings.form = fit::LensForm{model, radial, decentring, aspect};
  return settings;
}

struct Case {
  const char* name;
  LensModel model;
  double focal_px, azimuth_deg, elevation_deg, roll_deg;
  bool mirrored;
  double k1;
};

class EveryLens : public testing::TestWithParam<Case> {};

// Without a guess of anything, and without noise: the camera itself comes out.
TEST_P(EveryLens, IsFoundFromNothing) {
  const Case& one = GetParam();
  fit::SkyCamera truth =
      known_camera(one.model, one.focal_px, one.azimuth_deg, one.elevation_deg, one.roll_deg);
  truth.mirrored = one.mirrored;
  truth.numbers[fit::radial_1_number] = one.k1;
  const auto stars = star_field(truth, 15, 0.0, 11);
  ASSERT_EQ(stars.size(), 15u);
  const fit::Calibration found =
      fit::calibrate(only(one.model, one.k1 != 0.0 ? 1 : 0), stars, kFrame, "stars");
  EXPECT_EQ(found.used(), 15);
  EXPECT_EQ(found.camera.mirrored, one.mirrored);
  EXPECT_LT(found.rms_px, 1e-6);
  EXPECT_LT(farthest_px(found.camera, truth, stars), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    Lenses, EveryLens,
    testing::Values(Case{"pinhole", LensModel::pinhole, 500, 210, 30, 5, false, 0},
                    Case{"telephoto", LensModel::pinhole, 4000, 40, 60, -30, false, 0},
                    Case{"brown", LensModel::pinhole, 400, 300, 45, 0, false, -0.08},
                    Case{"equidistant", LensModel::equidistant, 150, 20, 88, 100, false, 0},
                    Case{"mirrored", LensModel::equidistant, 150, 320, 85, -170, true, 0},
                    Case{"equisolid", LensModel::equisolid, 170, 150, 40, 3, false, 0},
                    Case{"stereographic", LensModel::stereographic, 130, 90, 89.9, 10, false, 0},
                    Case{"orthographic", LensModel::orthographic, 220, 250, 80, 0, false, 0},
                    Case{"polynomial", LensModel::polynomial, 160, 60, 87, 45, false, -0.05}),
    [](const auto& given) { return given.param.name; });

// Noise of 0.2 px: of all lenses the one that took the picture.
TEST(LensChoice, ChoosesTheLensThatTookThePicture) {
  const fit::SkyCamera truth = known_camera(LensModel::equisolid, 165.0, 200.0, 84.0, 12.0);
  const fit::Calibration found = fit::calibrate({}, star_field(truth, 40, 0.2, 1), kFrame, "stars");
  EXPECT_EQ(found.form.model, LensModel::equisolid);
  EXPECT_EQ(found.candidates.size(), 44u);
}

// A term that is not there has chi2 of one degree of freedom, and is taken if that is above ln 80 + 2 = 6.4,
// in 1.2 % of draws; two in one in exp(-(2 ln 80 + 2) / 2) = 0.5 %. Of 20 draws that is 0.3: more than three
// would come in less than one in a thousand times.
TEST(LensChoice, AddsNoTermsToIt) {
  const fit::SkyCamera truth = known_camera(LensModel::equisolid, 165.0, 200.0, 84.0, 12.0);
  int plain = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    fit::LensSettings settings;
    settings.model = LensModel::equisolid;
    settings.start = truth;
    plain +=
        fit::words_of(fit::calibrate(settings, star_field(truth, 40, 0.2, seed), kFrame, "stars").form) ==
        "equisolid";
  }
  EXPECT_GE(plain, 17);
}

// And terms that are there are found. (Most of what decentring does a tilt does as well.)
TEST(LensChoice, FindsTheTermsThatAreThere) {
  fit::SkyCamera truth = known_camera(LensModel::equisolid, 165.0, 200.0, 84.0, 12.0);
  truth.numbers[fit::decentring_1_number] = 0.02;
  truth.numbers[fit::decentring_2_number] = -0.015;
  fit::LensSettings settings;
  settings.model = LensModel::equisolid;
  settings.start = truth;
  const fit::Calibration found = fit::calibrate(settings, star_field(truth, 40, 0.1, 9), kFrame, "stars");
  EXPECT_EQ(fit::words_of(found.form), "equisolid, p1 p2");
}

// What the error bars promise: over 60 draws the numbers' deviations, weighed by the covariance, have the
// mean square that chi2 has. n = 60 x 6: the standard deviation of the mean of chi2 / 6 is sqrt(2 / 360) =
// 0.075; four of those, and 0.03 for the noise's own estimate (a t-distribution of 54 degrees of freedom).
TEST(ErrorBars, AreThoseOfManyDraws) {
  const fit::SkyCamera truth = known_camera(LensModel::equidistant, 150.0, 130.0, 70.0, 25.0);
  const fit::Pointing pointing = fit::pointing_of(truth);
  double sum = 0.0, in_sigma = 0.0;
  constexpr int kDraws = 60;
  for (int draw = 0; draw < kDraws; ++draw) {
    fit::LensSettings settings = only(LensModel::equidistant);
    settings.start = truth;
    const fit::Calibration found =
        fit::calibrate(settings, star_field(truth, 30, 0.3, 100 + draw), kFrame, "stars");
    std::vector<double> deviations;
    std::vector<double> sigmas;
    const double truths[6] = {
        pointing.azimuth_deg, pointing.elevation_deg, pointing.roll_deg, 150.0, 7.0, -4.0};
    int i = 0;
    for (const fit::CameraEstimate& estimate : found.estimates) {
      if (!estimate.free) continue;
      deviations.push_back((estimate.value - truths[i++]) / estimate.sigma);
    }
    ASSERT_EQ(deviations.size(), 6u);
    const Eigen::VectorXd d = Eigen::Map<Eigen::VectorXd>(deviations.data(), 6);
    sum += d.dot(found.correlation.ldlt().solve(d)) / 6.0;
    in_sigma += found.sigma_px;
  }
  EXPECT_NEAR(sum / kDraws, 1.0, 4 * 0.075 + 0.03);
  // 60 draws of 54 degrees of freedom: 0.3 / sqrt(2 x 60 x 54) = 0.0037.
  EXPECT_NEAR(in_sigma / kDraws, 0.3, 4 * 0.0037 + 0.3 / (4 * 54));
}

TEST(MistakenStar, IsLeftOutAndTheAnswerStays) {
  const fit::SkyCamera truth = known_camera(LensModel::equisolid, 165.0, 200.0, 84.0, 12.0);
  const auto stars = star_field(truth, 20, 0.2, 5);
  const fit::Calibration before = fit::calibrate(only(LensModel::equisolid), stars, kFrame, "stars");
  ASSERT_EQ(before.used(), 20);
  for (const std::size_t which : {0u, 7u, 19u}) {
    auto moved = stars;
    moved[which].x_px += 12.0;
    moved[which].y_px -= 16.0;
    const fit::Calibration after = fit::calibrate(only(LensModel::equisolid), moved, kFrame, "stars");
    EXPECT_EQ(after.used(), 19);
    EXPECT_FALSE(after.residuals[which].used);
    // As far as one star in twenty may move it: a leverage of 6 / 40 of noise of 0.2 px, three times over.
    EXPECT_LT(farthest_px(before.camera, after.camera, stars), 0.3);
  }
}

// A fit without the star, against the algebra of least squares (Cook and Weisberg 1982): r / (1 - H).
TEST(LeaveOneOut, IsWhatTheLeveragesSay) {
  const fit::SkyCamera truth = known_camera(LensModel::equidistant, 150.0, 130.0, 70.0, 25.0);
  const auto stars = star_field(truth, 12, 0.1, 3);
  const fit::Calibration found = fit::calibrate(only(LensModel::equidistant), stars, kFrame, "stars");
  ASSERT_EQ(found.used(), 12);
  const auto free = fit::free_numbers(found.form, true);
  const Eigen::MatrixXd j = fit::place_jacobian(found.camera, free, stars);
  const Eigen::MatrixXd hat = j * (j.transpose() * j).ldlt().solve(j.transpose());
  for (int i = 0; i < 12; ++i) {
    const fit::StarResidual& one = found.residuals[i];
    const Eigen::Matrix2d left = Eigen::Matrix2d::Identity() - hat.block<2, 2>(2 * i, 2 * i);
    const Eigen::Vector2d without = left.inverse() * Eigen::Vector2d(one.dx_px, one.dy_px);
    // To the curvature of the lens over a tenth of a pixel.
    EXPECT_NEAR(one.without_dx_px, without[0], 2e-3);
    EXPECT_NEAR(one.without_dy_px, without[1], 2e-3);
  }
}

TEST(Jacobian, IsTheDifferences) {
  fit::SkyCamera camera = known_camera(LensModel::polynomial, 160.0, 60.0, 80.0, 45.0);
  camera.mirrored = true;
  camera.numbers[fit::radial_1_number] = -0.05;
  camera.numbers[fit::decentring_1_number] = 0.002;
  camera.numbers[fit::aspect_ratio_number] = 1.01;
  const auto stars = star_field(camera, 5, 0.0, 2);
  const auto free = fit::free_numbers({LensModel::polynomial, 3, true, true}, true);
  const Eigen::MatrixXd exact = fit::place_jacobian(camera, free, stars);
  for (std::size_t j = 0; j < free.size(); ++j) {
    const double step = 1e-5 * std::max(1.0, std::abs(camera.numbers[free[j]]));
    fit::SkyCamera more = camera, less = camera;
    more.numbers[free[j]] += step;
    less.numbers[free[j]] -= step;
    for (std::size_t i = 0; i < stars.size(); ++i) {
      double x1 = 0.0, y1 = 0.0, x0 = 0.0, y0 = 0.0;
      ASSERT_TRUE(fit::place_of_star(more, stars[i].enu, x1, y1) &&
                  fit::place_of_star(less, stars[i].enu, x0, y0));
      const double size = 1.0 + std::abs(exact(2 * i, j)) + std::abs(exact(2 * i + 1, j));
      EXPECT_NEAR(exact(2 * i, j), (x1 - x0) / (2.0 * step), 1e-6 * size) << fit::name_of(free[j]);
      EXPECT_NEAR(exact(2 * i + 1, j), (y1 - y0) / (2.0 * step), 1e-6 * size) << fit::name_of(free[j]);
    }
  }
}

TEST(Pointing, IsItsRotation) {
  for (const double elevation_deg : {-20.0, 5.0, 60.0, 89.0}) {
    fit::SkyCamera camera;
    camera.camera_from_enu = fit::rotation_of(230.0, elevation_deg, -100.0);
    const fit::Pointing pointing = fit::pointing_of(camera);
    EXPECT_NEAR(pointing.azimuth_deg, 230.0, 1e-9);
    EXPECT_NEAR(pointing.elevation_deg, elevation_deg, 1e-9);
    EXPECT_NEAR(pointing.roll_deg, -100.0, 1e-9);
    for (int j = 0; j < 3; ++j) {
      constexpr double kStep = 1e-6;
      fit::SkyCamera more = camera, less = camera;
      more.numbers[j] = kStep;
      less.numbers[j] = -kStep;
      const fit::Pointing p = fit::pointing_of(fit::with_rotation_applied(more));
      const fit::Pointing m = fit::pointing_of(fit::with_rotation_applied(less));
      const double scale = 1.0 + std::abs(pointing.by_turns(0, j));
      EXPECT_NEAR(pointing.by_turns(0, j), (p.azimuth_deg - m.azimuth_deg) / (2 * kStep), 1e-5 * scale);
      EXPECT_NEAR(pointing.by_turns(1, j), (p.elevation_deg - m.elevation_deg) / (2 * kStep), 1e-5 * scale);
      EXPECT_NEAR(pointing.by_turns(2, j), (p.roll_deg - m.roll_deg) / (2 * kStep), 1e-5 * scale);
    }
  }
}

TEST(StarCheck, RefusesStarsThatTellNothing) {
  const fit::SkyCamera truth = known_camera(LensModel::equidistant, 150.0, 130.0, 70.0, 25.0);
  const auto stars = star_field(truth, 12, 0.1, 3);
  const auto refused = [&](const std::vector<fit::StarSighting>& some) {
    return expect_error(sim::ErrorKind::unreadable_input,
                        [&] { fit::calibrate({}, some, kFrame, "stars.csv"); });
  };
  EXPECT_TRUE(tests::has_facts(refused({}), "0 stars | 6 numbers"));
  EXPECT_NE(refused({stars.begin(), stars.begin() + 4}).find("expected at least 5"), std::string::npos);
  auto line = stars, point = stars, same_star = stars;
  for (std::size_t i = 0; i < line.size(); ++i) {
    line[i].y_px = 2.0 * line[i].x_px;
    point[i].x_px = 10.0 + 0.01 * i;
    point[i].y_px = 20.0;
    same_star[i].enu = stars[0].enu;
  }
  EXPECT_NE(refused(line).find("one line"), std::string::npos);
  EXPECT_TRUE(tests::has_facts(refused(point), "one point | picture"));
  EXPECT_TRUE(tests::has_facts(refused(same_star), "one point | sky"));
}

TEST(HeldLens, OnlyTheRotationMoves) {
  fit::SkyCamera truth = known_camera(LensModel::polynomial, 160.0, 60.0, 88.0, 45.0);
  truth.numbers[fit::radial_1_number] = -0.05;
  const auto stars = star_field(truth, 8, 0.0, 4);
  fit::LensSettings settings;
  settings.start = truth;
  settings.start->camera_from_enu = fit::rotation_of(60.0, 87.0, 48.0);
  settings.only = {fit::turn_about_right, fit::turn_about_down, fit::turn_about_forward};
  const fit::Calibration found = fit::calibrate(settings, stars, kFrame, "stars");
  EXPECT_LT(found.rms_px, 1e-6);
  EXPECT_EQ(found.camera.numbers, truth.numbers);
  EXPECT_EQ(found.candidates.size(), 1u);
}

}  // namespace
}  // namespace vegard::tests::calibration_test
