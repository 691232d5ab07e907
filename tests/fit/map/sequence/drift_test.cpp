#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "fit/map/map_problem.h"
#include "fit/map/sequence/drift_fit.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/two_stations.h"

namespace vegard::fit::drift_test {
namespace {

using sim::kGroundEnergies;

sim::GroundGrid rings() { return sim::GroundGrid(sim::rings_resolved(0.02, 2.0, 160.0)); }

/// All nodes with one velocity.
DriftField even_drift(const sim::GroundGrid& grid, double east_km_s, double north_km_s) {
  DriftField drift = drift_before(DriftNet::over(grid));
  for (Eigen::Index n = 0; n < drift.growth_per_s.size(); ++n)
    drift.velocity_km_s.segment<2>(2 * n) << east_km_s, north_km_s;
  return drift;
}

/// A Gaussian spot of the flux in one energy, and its mean place and sum.
std::vector<float> spot(const sim::GroundGrid& grid, sim::EastNorth at, double sigma_km) {
  std::vector<float> map(static_cast<std::size_t>(grid.cells()) * kGroundEnergies, 0.0f);
  for (int c = 0; c < grid.cells(); ++c) {
    const sim::EastNorth p = grid.middle_km(c);
    const double d = std::hypot(p.east - at.east, p.north - at.north) / sigma_km;
    if (d < 4.0)
      map[static_cast<std::size_t>(c) * kGroundEnergies + 5] = static_cast<float>(std::exp(-0.5 * d * d));
  }
  return map;
}

struct Mean {
  double flux = 0.0, east = 0.0, north = 0.0;
};
Mean mean_of(const sim::GroundGrid& grid, const std::vector<float>& map) {
  Mean mean;
  for (int c = 0; c < grid.cells(); ++c) {
    const double q = grid.area_km2(c) * map[static_cast<std::size_t>(c) * kGroundEnergies + 5];
    mean.flux += q;
    mean.east += q * grid.middle_km(c).east;
    mean.north += q * grid.middle_km(c).north;
  }
  mean.east /= mean.flux;
  mean.north /= mean.flux;
  return mean;
}

// A spot goes as far as the drift takes it, by less than a cell as well as by many; 16 drawn points in a cell
// leave a few hundredths of its 2 to 5 km in the mean of some hundred cells.
TEST(DriftField, TakesAMapAlong) {
  const sim::GroundGrid grid = rings();
  const CellPoints points(grid);
  const std::vector<float> before = spot(grid, {-10.0, 90.0}, 9.0);
  const Mean begin = mean_of(grid, before);
  for (const double seconds : {0.5, 3.0, 40.0, -20.0}) {
    const Mean end = mean_of(grid, points.after(even_drift(grid, 0.4, -0.25), seconds, 1).moved(before, 1));
    EXPECT_NEAR(end.east - begin.east, 0.4 * seconds, 0.1) << seconds;
    EXPECT_NEAR(end.north - begin.north, -0.25 * seconds, 0.1) << seconds;
    EXPECT_NEAR(end.flux / begin.flux, 1.0, 0.01) << seconds;
  }
}

TEST(DriftField, GrowsLight) {
  const sim::GroundGrid grid = rings();
  DriftField drift = even_drift(grid, 0.0, 0.0);
  drift.growth_per_s.setConstant(0.01);
  const std::vector<float> before = spot(grid, {0.0, 100.0}, 9.0);
  const std::vector<float> after = CellPoints(grid).after(drift, 20.0, 1).moved(before, 1);
  EXPECT_NEAR(mean_of(grid, after).flux / mean_of(grid, before).flux, std::exp(0.2), 2e-3);  // cells are arcs
}

TEST(DriftField, ForgetsWhatItKnew) {
  DriftField drift = even_drift(rings(), 0.5, 0.0);
  const double known = 0.01;
  drift.covariance *= known;
  const DriftField soon = drift_later(drift, 1.0), late = drift_later(drift, 1e5);
  EXPECT_NEAR(soon.velocity_km_s(0), 0.5, 0.01);
  EXPECT_GT(soon.covariance(0, 0), drift.covariance(0, 0));
  EXPECT_NEAR(late.velocity_km_s(0), 0.0, 1e-6);
  EXPECT_NEAR(late.covariance(0, 0), drift.covariance(0, 0) / known, 1e-6);
}

/// A camera's small picture and what it sees of the ground.
class DriftFit : public testing::Test {
 protected:
  DriftFit()
      : scene_(sim::parse_scene("[site]\nlatitude_deg = 67.0\n[field]\ninclination_deg = 78.0\n[camera]\n"
                                "width = 90\nheight = 60\nhfov_deg = 66\nelevation_deg = 33\n[emission]\n"
                                "flux_law = \"linear\"\nuncertainty = \"none\"\n[sensor]\n"
                                "gain_per_kilorayleigh = 0.01\n[sky]\nlevel = [0.003, 0.006, 0.008]\n",
                                "scene")),
        photos_{tests::photo_of(scene_, 0.001, 3)},
        problem_(scene_, photos_, options_),
        picture_(problem_.pictures(1)),
        grid_(sim::SquareCells{-300.0, 20.0, 5.0, 120, 86}) {
    problem_.look(picture_, grid_);
  }

  /// The picture of a map, with noise of seed 8.
  void show(const std::vector<float>& map) {
    MapLight light, residual;
    picture_.front().forward(map, light);
    picture_.front().residual(light, residual);
    const MapLight sky = picture_.front().sky();
    std::mt19937_64 random(8);
    std::normal_distribution<float> normal;
    for (std::size_t i = 0; i < light.size(); ++i)
      light[i] += 0.008f + picture_.front().noise()[i] * normal(random);
    picture_.front().set_data(light);
  }
  DriftField fitted(const std::vector<float>& before, double seconds) {
    return fitted_drift(picture_.front(), CellPoints(grid_), grid_, MapNeighbours(grid_),
                        cells_in_view(picture_.front(), scene_.site, grid_), before,
                        drift_before(DriftNet::over(grid_)), seconds, true, 1);
  }

  sim::Scene scene_;
  std::vector<Photo> photos_;
  MapOptions options_;
  MapProblem problem_;
  std::vector<MapObservation> picture_;
  sim::GroundGrid grid_;
};

TEST_F(DriftFit, FindsHowASpotMoves) {
  std::vector<float> before = spot(grid_, {-10.0, 190.0}, 12.0);
  for (float& x : before) x *= 20.0f;
  show(CellPoints(grid_).after(even_drift(grid_, 0.5, -0.3), 20.0, 1).moved(before, 1));
  const DriftField found = fitted(before, 20.0);
  const sim::EastNorth place{-5.0, 187.0};
  const Drift drift = found.at(place);
  const Eigen::Matrix2d covariance = found.covariance_at(place);
  // A tenth of the speed, which is a km of the 12 that the light moves.
  EXPECT_NEAR(drift.east_km_s, 0.5, 0.06);
  EXPECT_NEAR(drift.north_km_s, -0.3, 0.06);
  EXPECT_LT(std::sqrt(covariance(0, 0)), 0.2);
  EXPECT_LT(std::sqrt(covariance(1, 1)), 0.2);
}

// Nothing is seen of motion along a band that is the same everywhere, but what its cells pretend: its error
// is much larger than that across the band.
TEST_F(DriftFit, KnowsLittleAlongAnEvenBand) {
  std::vector<float> before(static_cast<std::size_t>(grid_.cells()) * kGroundEnergies, 0.0f);
  for (int c = 0; c < grid_.cells(); ++c) {
    const double d = (grid_.middle_km(c).north - 190.0) / 10.0;
    if (std::abs(d) < 4.0)
      before[static_cast<std::size_t>(c) * kGroundEnergies + 5] =
          static_cast<float>(20.0 * std::exp(-0.5 * d * d));
  }
  show(CellPoints(grid_).after(even_drift(grid_, 0.6, 0.3), 20.0, 1).moved(before, 1));
  const DriftField found = fitted(before, 20.0);
  const Eigen::Matrix2d covariance = found.covariance_at({0.0, 196.0});
  EXPECT_NEAR(found.at({0.0, 196.0}).north_km_s, 0.3, 0.06);
  EXPECT_GT(covariance(0, 0), 4.0 * covariance(1, 1));
}

}  // namespace
}  // namespace vegard::fit::drift_test
