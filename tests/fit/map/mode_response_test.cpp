#include "fit/map/mode_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "fit/map/map_grid.h"
#include "fit/map/map_solver.h"
#include "sim/base/number/dense_solvers.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/two_stations.h"

namespace vegard::fit::mode_response_test {
namespace {

const std::vector<double> kEnergies = {1.0, 2.0, 4.0, 8.0};

/// A picture of a band that a map of few steps explains, and this map.
struct Solved {
  std::vector<MapObservation> pictures;
  std::unique_ptr<sim::GroundGrid> grid;
  std::vector<double> modes;
  std::vector<float> map;

  Solved() {
    const std::string camera =
        "[site]\nlatitude_deg = 67.0\n[field]\ninclination_deg = 78.0\n[camera]\nwidth = 90\nheight = 60\n"
        "hfov_deg = 66\nelevation_deg = 33\n[sensor]\ngain_per_kilorayleigh = 0.01\n[sky]\nlevel = [0.003, "
        "0.006, 0.008]\n";
    const sim::Scene scene = sim::parse_scene(camera, "scene");
    const sim::Scene band = sim::parse_scene(
        camera +
            "[[footprint]]\nname = \"band\"\nsource = \"spline\"\ncenter_km = [0, 190]\nsize_km = [420, "
            "120]\ncell_km = 1.0\nwidth_km = 3.0\nenergy_kev = 4.0\nenergy_flux_mw_m2 = 12.0\n"
            "east_km = [-200, 200]\nnorth_km = [5, -5]\n",
        "scene");
    MapObservationOptions o;
    o.threads = 1;
    pictures.emplace_back(scene, tests::photo_of(band, 0.0015, 5), o);
    grid = std::make_unique<sim::GroundGrid>(map_grid(pictures, scene.site, 500.0, 3.0));
    pictures[0].look_at(scene.site, *grid, kEnergies, 1.0);
    const auto rates = std::make_shared<sim::ModeRates>(scene, kEnergies, 1.0, 1.0, sim::ElectronSpectrum());
    modes.assign(static_cast<std::size_t>(rates->modes()), 0.0);
    pictures[0].set_light(rates, modes);
    MapSolverOptions solver;
    solver.steps = 60;
    std::vector<float> start(static_cast<std::size_t>(grid->cells()) * sim::kGroundEnergies, 0.0f);
    for (std::size_t i = 0; i < start.size(); ++i)
      if (i % sim::kGroundEnergies < kEnergies.size()) start[i] = 0.05f;
    map = solve_map(pictures, MapNeighbours(*grid), 4, start, solver).map;
  }
};

/// The weighted square of the light that a shift of the modes, and the map's answer to it, add: by a
/// difference of two pictures.
double square_of_change(Solved& solved, const Eigen::VectorXd& shift, const std::vector<float>& answer) {
  constexpr double kStep = 0.02;  // of which the second order is 1 % where a mode changes light by half
  std::vector<MapLight> light(2);
  for (const int side : {0, 1}) {
    const double step = side == 0 ? -kStep : kStep;
    std::vector<double> modes = solved.modes;
    std::vector<float> map = solved.map;
    for (std::size_t k = 0; k < modes.size(); ++k) modes[k] += step * shift(static_cast<Eigen::Index>(k));
    for (std::size_t i = 0; i < answer.size(); ++i) map[i] += static_cast<float>(step) * answer[i];
    solved.pictures[0].set_modes(modes);
    solved.pictures[0].forward(map, light[static_cast<std::size_t>(side)]);
  }
  solved.pictures[0].set_modes(solved.modes);
  for (std::size_t i = 0; i < light[0].size(); ++i)
    light[0][i] = static_cast<float>((light[1][i] - light[0][i]) / (2.0 * kStep));
  MapLight weighted;
  solved.pictures[0].take_sky_away(light[0], weighted);
  return dot(light[0], weighted);
}

TEST(ModeResponse, IsWhatTheLightChangesByWhereTheMapAnswers) {
  Solved solved;
  MapSolverOptions options;
  options.modes = options.modes_centre = solved.modes;
  const MapModes learnt = solved_modes(solved.pictures, MapNeighbours(*solved.grid), 4, solved.map, options);
  const ModeResponse& response = learnt.response;
  ASSERT_GT(response.directions.cols(), 1);
  const auto modes = static_cast<Eigen::Index>(solved.modes.size());
  double fell = 0.0;
  for (Eigen::Index j = 0; j < response.directions.cols(); ++j) {
    const Eigen::VectorXd shift = response.directions.col(j);
    const double left = shift.dot(response.information * shift);
    EXPECT_NEAR(left, square_of_change(solved, shift, response.answer(shift)), 0.01 * left + 1e-3);
    const double alone = square_of_change(solved, shift, {});
    EXPECT_LT(left, alone);
    fell += 1.0 - left / alone;
  }
  EXPECT_GT(fell / static_cast<double>(response.directions.cols()), 0.3);  // else the map has no answer
  // What is learnt is no less than nothing, and no error is larger than the prior's.
  const Eigen::MatrixXd covariance = learnt.spread * learnt.spread.transpose();
  const sim::SymmetricEigen axes = sim::symmetric_eigen(covariance);
  for (Eigen::Index k = 0; k < modes; ++k) {
    EXPECT_GT(axes.values(k), 0.0);
    EXPECT_LT(axes.values(k), 1.0 + 1e-6);
  }
  EXPECT_LT(axes.values.minCoeff(), 0.8);
}

}  // namespace
}  // namespace vegard::fit::mode_response_test
