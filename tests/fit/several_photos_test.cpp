// Several photographs in one cost: its Jacobian, what is shared and what is private, two stations.
#include <gtest/gtest.h>

#include <cmath>

#include "fit/compare/observation.h"
#include "fit/compare/profile_cost.h"
#include "fit/fit.h"
#include "fit/parameters/photo_frame.h"
#include "tests/support/two_stations.h"

namespace vegard::fit::several_photos_test {
namespace {

sim::FreeParameter free_path(const std::string& path, const std::string& photo = "") {
  sim::FreeParameter free;
  free.path = path;
  free.photo = photo;
  return free;
}

/// A cost of the full model over the photographs of a scene that has moved on since.
struct TwoPhotographs {
  sim::Scene scene;
  std::vector<Photo> photos;
  std::vector<FreeNumber> free;
  std::vector<Observation> observations;
  EvaluationLog log;
  std::unique_ptr<ProfileCost> cost;

  explicit TwoPhotographs(sim::Scene with) : scene(std::move(with)) {
    sim::Scene elsewhere = scene;
    elsewhere.sheets[0].center_km.north += 4.0;
    elsewhere.sheets[0].energy_kev *= 1.1;
    photos = tests::photos_of(elsewhere);
    free = free_numbers(scene);
    for (std::size_t i = 0; i < photos.size(); ++i) {
      const FramedScene framed = framed_scene(scene, scene.fit.photos[i]);
      observations.push_back(observed(framed.scene, photos[i], 2, framed.frame));
    }
    cost = std::make_unique<ProfileCost>(free, cost_terms(observations, free, Detail::full), log);
  }

  std::vector<double> start() const {
    std::vector<double> u;
    for (const FreeNumber& number : free) u.push_back(number.coordinate(number.start));
    return u;
  }
  std::vector<double> residuals(const std::vector<double>& u, std::vector<double>* jacobian = nullptr) const {
    std::vector<double> r(cost->num_residuals());
    const double* parameters[] = {u.data()};
    if (jacobian != nullptr) jacobian->resize(r.size() * u.size());
    double* rows[] = {jacobian != nullptr ? jacobian->data() : nullptr};
    EXPECT_TRUE(cost->Evaluate(parameters, r.data(), jacobian != nullptr ? rows : nullptr));
    return r;
  }
  /// Norm of a column of the Jacobian over one photograph's residuals.
  double weight(const std::vector<double>& jacobian, std::size_t column, std::size_t photo) const {
    std::size_t first = 0;
    for (std::size_t o = 0; o < photo; ++o) first += observations[o].full->residuals();
    double sum = 0.0;
    for (int k = 0; k < observations[photo].full->residuals(); ++k)
      sum += std::pow(jacobian[(first + k) * free.size() + column], 2);
    return std::sqrt(sum);
  }
};

sim::Scene moving_scene() {
  sim::Scene scene = tests::two_stations();
  scene.sheets[0].profile = sim::ProfileKind::maxwellian;
  scene.sheets[0].beams = 3000;
  scene.sheets[0].length_km = 260.0;
  scene.sheets[0].bearing_deg = 83.0;
  // The other camera stands to the side too, has a filter, and is later: the sheet has drifted.
  scene.sheets[0].drift_km_s = {0.1, -0.2};
  scene.fit.photos[1].set.emplace_back("site.longitude_deg", "20.7");
  scene.fit.photos[1].set.emplace_back("emission.lines", "[557.7, 427.8]");
  scene.fit.photos[1].set.emplace_back("blur.width_deg", "[0.25, 0.3]");
  scene.fit.photos[1].set.emplace_back("time.start_s", "20.0");
  scene.blur.width_deg = {0.43, 0.25, 0.3};
  return scene;
}

TEST(SeveralPhotographs, JacobianAgreesWithDifferences) {
  sim::Scene scene = moving_scene();
  for (const char* path : {"sheet.main.center_km", "sheet.main.bearing_deg", "sheet.main.energy_kev",
                           "sheet.main.wavelength_km", "sheet.main.length_km"})
    scene.fit.free.push_back(free_path(path));
  scene.fit.free.push_back(free_path("camera.roll_deg", "north"));
  scene.fit.free.push_back(free_path("blur.width_deg.4278", "south"));
  const TwoPhotographs two(scene);
  const std::vector<double> u = two.start();
  std::vector<double> jacobian;
  two.residuals(u, &jacobian);
  for (std::size_t j = 0; j < u.size(); ++j) {
    SCOPED_TRACE(two.free[j].label());
    const std::string& key = two.free[j].id.row->key;
    // About a hundredth of a pixel, as tests/fit/profile_cost_test.cpp has it.
    const double by_value = key == "center_km"    ? 0.004
                            : key == "length_km"  ? 0.01
                            : key == "energy_kev" ? 2e-3
                                                  : 1.5e-3;
    const double step = by_value / two.free[j].slope(u[j]);
    std::vector<double> more = u, less = u;
    more[j] += step;
    less[j] -= step;
    const std::vector<double> up = two.residuals(more), down = two.residuals(less);
    double error = 0.0, size = 0.0;
    for (std::size_t k = 0; k < up.size(); ++k) {
      const double difference = (up[k] - down[k]) / (2 * step);
      error += std::pow(jacobian[k * u.size() + j] - difference, 2);
      size += difference * difference;
    }
    EXPECT_GT(size, 0.0);
    EXPECT_LT(std::sqrt(error / size), 0.03);  // floats and the splat's kinks, as there
  }
}

TEST(SeveralPhotographs, APrivateNumberMovesItsOwnPhotographAlone) {
  sim::Scene scene = moving_scene();
  scene.fit.free = {free_path("sheet.main.energy_kev"), free_path("camera.elevation_deg", "north"),
                    free_path("camera.elevation_deg", "south"), free_path("blur.width_deg.6300", "south")};
  const TwoPhotographs two(scene);
  ASSERT_EQ(two.free.size(), 4u);
  EXPECT_EQ(two.free[1].start, 50.0) << "each starts from what its photograph has";
  EXPECT_EQ(two.free[2].start, 35.0);
  EXPECT_EQ(two.free[1].label(), "camera.elevation_deg of north");
  std::vector<double> jacobian;
  const std::vector<double> u = two.start(), before = two.residuals(u, &jacobian);
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_EQ(two.weight(jacobian, j, 0) > 0.0, j != 1) << j;
    EXPECT_EQ(two.weight(jacobian, j, 1) > 0.0, j <= 1) << j;
  }
  std::vector<double> moved = u;
  moved[1] += 0.01;
  const std::vector<double> after = two.residuals(moved);
  const auto of_south = static_cast<std::size_t>(two.observations[0].full->residuals());
  EXPECT_TRUE(
      std::equal(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(of_south), after.begin()));
  EXPECT_NE(before, after);
}

double distance_km(const FitResult& result) { return result.derived.at(0).value; }

// The height of the light is taken as unknown: one camera has only the shape of the profile to tell near and
// low from far and high, two see it under different angles. The truth has beams in other random places than
// the model, and noise (seeds 7 and 8). tests/recovery/two_stations_test.cpp has more of them.
TEST(SeveralPhotographs, TwoStationsTellTheDistanceWithoutTheHeight) {
  sim::Scene truth = tests::two_stations();
  truth.camera.width = 96;
  truth.camera.height = 72;
  truth.sheets[0].layers = 1;
  truth.sheets[0].beams = 4000;
  truth.fit.bands = 6;
  const std::vector<Photo> photos = tests::photos_of(truth, 0.002, 7);
  sim::Scene start = tests::with_unknown_height(truth);
  start.sheets[0].beams = 800;
  const FitResult two = fit_photos(start, photos, {});
  start.fit.photos.clear();
  const FitResult one = fit_photo(start, photos[0], {});
  ASSERT_EQ(two.photos.size(), 2u);
  ASSERT_TRUE(one.derived[0].sigma && two.derived[0].sigma);
  EXPECT_GT(*one.derived[0].sigma, 5.0 * *two.derived[0].sigma);
  EXPECT_LT(std::abs(distance_km(two) - 180.0), 3.0 * *two.derived[0].sigma);
  // Each sees the answer from where it stands.
  EXPECT_EQ(two.photos[0].best.sheets[0].center_km.north, two.best.sheets[0].center_km.north);
  EXPECT_NEAR(two.photos[1].best.sheets[0].center_km.north,
              two.best.sheets[0].center_km.north - 100.0 / 6371.0 * 6481.0, 0.1);
}

}  // namespace
}  // namespace vegard::fit::several_photos_test
