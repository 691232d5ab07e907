// Scenes on sparse grids: what is conserved, what is sampled, and what a scene makes of a file of its own.
#include "sim/render/volumes/scene_grid.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "sim/base/grid/vdb_io.h"
#include "sim/render/beams/points.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/render/volumes/volumes.h"
#include "sim/scene/file/volume_grid_file.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_scene.h"
#include "tests/support/temporary_folder.h"

namespace vegard::scene_grid_test {
namespace {

using namespace sim;

TEST(SceneGrid, HoldsThePhotonsOfTheBeams) {
  const Scene scene = tests::small_scene();
  std::vector<double> total(scene.emission.lines.size(), 0.0);
  double up = 0.0;
  stream_points(scene, {}, [&](const EmissionPoints& some) {
    for (std::size_t p = 0; p < some.size(); ++p) {
      for (int l = 0; l < some.lines; ++l) total[l] += some.photons_per_s[p * some.lines + l];
      up += static_cast<double>(some.photons_per_s[p * some.lines]) * some.position_in_enu_km[p * 3 + 2];
    }
  });
  for (const double voxel : {2.0, 11.0}) {
    SceneGridOptions options;
    options.voxel = voxel;
    const SceneGrid made = grid_of_scene(scene, options);
    ASSERT_EQ(made.grid.channels.size(), total.size() + 1);
    EXPECT_EQ(made.grid.channels[1].name, "emission_5577");
    for (std::size_t l = 0; l < total.size(); ++l)
      EXPECT_NEAR(made.grid.sum(static_cast<int>(l)) * voxel * voxel * voxel * 1e15 / total[l], 1.0, 1e-5);
    // Shares among neighbours keep the middle where it is.
    double height = 0.0, brightest = 0.0;
    for (const auto& [at, brick] : made.grid.bricks)
      for (int v = 0; v < SparseGrid::kVoxels; ++v) {
        height += brick[v] * (at.z * 8 + v % 8 + 0.5) * voxel;
        brightest = std::max(brightest, static_cast<double>(brick[total.size() * SparseGrid::kVoxels + v]));
      }
    EXPECT_NEAR(height / made.grid.sum(0), up / total[0], 1e-4 * up / total[0]);
    EXPECT_FALSE(made.absorbs);
    EXPECT_EQ(brightest, 1.0);
  }
}

TEST(SceneGrid, IsTheSameForEveryNumberOfThreads) {
  SceneGridOptions options;
  options.voxel = 4.0;
  options.threads = 1;
  const SceneGrid one = grid_of_scene(tests::small_scene(), options);
  options.threads = 2;
  EXPECT_EQ(one.grid.bricks, grid_of_scene(tests::small_scene(), options).grid.bricks);
}

TEST(SceneGrid, TakesTheLinesAndTheBoxThatAreAsked) {
  const Scene scene = tests::small_scene();
  SceneGridOptions options;
  options.voxel = 4.0;
  const SceneGrid whole = grid_of_scene(scene, options);
  options.lines = {1};
  options.box = Box3{{-50.0, 0.0, 0.0}, {50.0, 400.0, 120.0}};
  const SceneGrid part = grid_of_scene(scene, options);
  ASSERT_EQ(part.grid.channels.size(), 2u);
  EXPECT_EQ(part.grid.channels[0].name, "emission_5577");
  EXPECT_GT(part.grid.sum(0), 0.0);
  EXPECT_LT(part.grid.sum(0), 0.5 * whole.grid.sum(1));
  // A voxel away from the box's faces is as it was; one outside is dark.
  EXPECT_EQ(part.grid.value(0, 3, 47, 27), whole.grid.value(1, 3, 47, 27));
  for (const auto& [at, brick] : part.grid.bricks) EXPECT_LE(at.z * 32.0, 124.0);
}

TEST(SceneGrid, SaysWhatVoxelWouldDo) {
  SceneGridOptions options;
  options.voxel = 1.0;
  options.memory_limit = 2 << 20;
  const std::string text =
      tests::expect_error(ErrorKind::usage, [&] { grid_of_scene(tests::small_scene(), options); });
  const std::size_t at = text.find("Voxels of ");
  ASSERT_NE(at, std::string::npos) << text;
  options.voxel = std::stod(text.substr(at + 10));
  EXPECT_GT(options.voxel, 1.0);
  EXPECT_NO_THROW(grid_of_scene(tests::small_scene(), options)) << text;
}

/// A ball of light that fades towards its rim, some of it absorbing.
class Ball : public LightField {
 public:
  explicit Ball(double absorbs, double unit = 1e5) : absorbs_(absorbs), unit_(unit) {}
  double unit_cm() const override { return unit_; }
  Box3 bounds() const override { return {{-7.0, -4.0, 93.0}, {7.0, 10.0, 107.0}}; }
  bool is_dark(const Box3& box) const override {
    double square = 0.0;
    for (int a = 0; a < 3; ++a) {
      const double off = std::max({box.low[a] - middle_[a], middle_[a] - box.high[a], 0.0});
      square += off * off;
    }
    return square >= 49.0;
  }
  void sample(std::size_t count, const double* const point[3], float* const emission[],
              float* density) const override {
    for (std::size_t i = 0; i < count; ++i) {
      double square = 0.0;
      for (int a = 0; a < 3; ++a) square += (point[a][i] - middle_[a]) * (point[a][i] - middle_[a]);
      const float light = static_cast<float>(std::max(0.0, 1.0 - square / 49.0));
      for (int l = 0; l < 3; ++l) emission[l][i] = (l + 1) * light;
      density[i] = static_cast<float>(absorbs_ * light);
    }
  }

 private:
  double middle_[3] = {0.0, 3.0, 100.0};
  double absorbs_, unit_;
};

TEST(SceneGrid, SamplesFieldsAtVoxelsCentres) {
  Scene scene;
  scene.emission.lines = {630.0, 557.7, 427.8};
  const Ball ball(0.25, 3.0857e18);
  SceneGridOptions options;
  options.voxel = 0.5;
  const SceneGrid made = grid_of_fields(scene, {&ball}, options);
  EXPECT_TRUE(made.absorbs);
  EXPECT_EQ(made.unit_cm, 3.0857e18);
  // 8 pi R^3 / 15 of the brightest; voxels of a fourteenth of the radius sum a smooth field to 1e-3.
  const double integral = 8.0 * std::acos(-1.0) * 343.0 / 15.0;
  for (int l = 0; l < 3; ++l) EXPECT_NEAR(made.grid.sum(l) * 0.125 / ((l + 1) * integral), 1.0, 1e-3);
  EXPECT_NEAR(made.grid.sum(3) * 0.125 / (0.25 * integral), 1.0, 1e-3);
  // 2744 bricks would be the box; the ball takes about half of it.
  EXPECT_LT(made.grid.bricks.size(), 300u);
  const double at[3] = {(2 + 0.5) * 0.5, (7 + 0.5) * 0.5, (201 + 0.5) * 0.5};
  float expected[3], density;
  float* const emission[] = {expected, expected + 1, expected + 2};
  const double* const points[] = {at, at + 1, at + 2};
  ball.sample(1, points, emission, &density);
  for (int l = 0; l < 3; ++l) EXPECT_EQ(made.grid.value(l, 2, 7, 201), expected[l]);
  EXPECT_EQ(made.grid.value(3, 2, 7, 201), density);
  options.memory_limit = 100000;
  EXPECT_NE(tests::expect_error(ErrorKind::usage, [&] { grid_of_fields(scene, {&ball}, options); })
                .find("would do"),
            std::string::npos);
}

/// A ball whose parts are counted.
class CountedBall : public Ball {
 public:
  explicit CountedBall(bool lit) : Ball(0.25), lit_(lit) {}
  bool is_dark(const Box3& box) const override {
    ++asked;
    return Ball::is_dark(box);
  }
  void sample(std::size_t count, const double* const point[3], float* const emission[],
              float* density) const override {
    ++sampled;
    if (lit_) return Ball::sample(count, point, emission, density);
    for (std::size_t i = 0; i < count; ++i)
      emission[0][i] = emission[1][i] = emission[2][i] = density[i] = 0.0f;
  }
  mutable std::atomic<int> asked{0}, sampled{0};

 private:
  bool lit_;
};

TEST(SceneGrid, RefusesTooManyVoxelsBeforeTheyAreListed) {
  Scene scene;
  scene.emission.lines = {630.0, 557.7, 427.8};
  const CountedBall ball(true);
  SceneGridOptions options;
  options.voxel = 0.001;  // some 10^9 bricks
  options.memory_limit = 4 << 20;
  const std::string text =
      tests::expect_error(ErrorKind::usage, [&] { grid_of_fields(scene, {&ball}, options); });
  EXPECT_LT(ball.asked, 20000);
  EXPECT_LT(ball.sampled, 1000);
  const std::size_t at = text.find("Voxels of ");
  ASSERT_NE(at, std::string::npos) << text;
  options.voxel = std::stod(text.substr(at + 10));
  EXPECT_NO_THROW(grid_of_fields(scene, {&ball}, options)) << text;
}

TEST(SceneGrid, WhatOnlyMayBeLitIsNotRefused) {
  Scene scene;
  scene.emission.lines = {630.0, 557.7, 427.8};
  const CountedBall ball(false);
  SceneGridOptions options;
  options.voxel = 0.1;  // some 2800 bricks, and memory for 280
  options.memory_limit = 4 << 20;
  EXPECT_TRUE(grid_of_fields(scene, {&ball}, options).grid.bricks.empty());
}

TEST(SceneGrid, StopsWhileItListsVoxels) {
  Scene scene;
  scene.emission.lines = {630.0, 557.7, 427.8};
  const CountedBall ball(true);
  const std::atomic<bool> stop{true};
  SceneGridOptions options;
  options.voxel = 0.001;
  options.stop = &stop;
  EXPECT_TRUE(grid_of_fields(scene, {&ball}, options).grid.bricks.empty());
  EXPECT_LT(ball.asked, 5000);
}

/// Writes the grid of one ball and names it in a scene.
Scene scene_with_file(const tests::TemporaryFolder& folder, const std::string& name,
                      const std::string& channel) {
  SparseGrid grid;
  grid.voxel = 1.0;
  grid.channels = {{channel, ""}};
  for (float& x : grid.brick({0, 0, 12})) x = 2.0f;
  write_vdb(folder / name, std::move(grid), {}, {});
  Scene scene;
  scene.file = folder / "scene.toml";
  scene.volumes.resize(1);
  scene.volumes[0].file = name;
  return scene;
}

TEST(VolumeFiles, GridsAreFoundByTheLinesNames) {
  const tests::TemporaryFolder folder;
  const Scene green = scene_with_file(folder, "green.vdb", "emission_5577");
  const VolumeGridFile file = read_volume_grid(green, green.volumes[0]);
  EXPECT_EQ(file.emission, (std::vector<int>{-1, 0, -1}));
  EXPECT_EQ(file.density, -1);
  EXPECT_EQ(file.site.latitude_deg, green.site.latitude_deg);
  const Scene smoke = scene_with_file(folder, "smoke.vdb", "density");
  EXPECT_EQ(read_volume_grid(smoke, smoke.volumes[0]).emission, (std::vector<int>{0, 0, 0}));
  const Scene other = scene_with_file(folder, "other.vdb", "emission_3914");
  const std::string text =
      tests::expect_error(ErrorKind::unreadable_input, [&] { read_volume_files(other); });
  EXPECT_NE(text.find("emission_3914"), std::string::npos) << text;
  EXPECT_NE(text.find("volume.volume.file"), std::string::npos) << text;
  Scene missing = green;
  missing.volumes[0].file = "none.vdb";
  EXPECT_NE(
      tests::expect_error(ErrorKind::unreadable_input, [&] { read_volume_files(missing); }).find("none.vdb"),
      std::string::npos);
}

/// The file `name` in a folder again, with an entry more.
void write_with_number(const tests::TemporaryFolder& folder, const std::string& name, const std::string& key,
                       double number) {
  SparseGrid grid;
  grid.channels = {{"emission_5577", ""}};
  grid.brick({0, 0, 12})[0] = 2.0f;
  VdbMetadata metadata;
  metadata.numbers[key] = number;
  VdbOptions options;
  options.overwrite = true;
  write_vdb(folder / name, std::move(grid), metadata, options);
}

TEST(VolumeFiles, ASiteThatIsNoneIsRefused) {
  const tests::TemporaryFolder folder;
  const Scene scene = scene_with_file(folder, "a.vdb", "emission_5577");
  for (const char* key : {"site_latitude_deg", "site_longitude_deg", "site_altitude_m", "unit_cm"})
    for (const double number : {std::nan(""), HUGE_VAL, -1e300}) {
      write_with_number(folder, "a.vdb", key, number);
      const std::string text =
          tests::expect_error(ErrorKind::unreadable_input, [&] { read_volume_files(scene); });
      EXPECT_NE(text.find("volume.volume.file"), std::string::npos) << text;
    }
  write_with_number(folder, "a.vdb", "site_latitude_deg", 90.0);
  EXPECT_NO_THROW(read_volume_files(scene));
}

TEST(VolumeFiles, ThereIsNoDensityBelowNothing) {
  const tests::TemporaryFolder folder;
  Scene scene = scene_with_file(folder, "a.vdb", "emission_5577");
  scene.volumes[0].extinction_per_km = 1.0;
  SparseGrid grid;
  grid.channels = {{"emission_5577", ""}, {"density", ""}};
  SparseGrid::Brick& brick = grid.brick({0, 0, 12});
  for (int v = 0; v < SparseGrid::kVoxels; ++v) {
    brick[v] = -2.0f;
    brick[SparseGrid::kVoxels + v] = v % 2 ? -3.0f : 3.0f;
  }
  VdbOptions options;
  options.overwrite = true;
  write_vdb(folder / "a.vdb", std::move(grid), {}, options);
  const VolumeGridFile file = read_volume_grid(scene, scene.volumes[0]);
  ASSERT_GE(file.density, 0);
  EXPECT_EQ(file.grid.value(file.density, 0, 0, 96), 3.0f);
  EXPECT_EQ(file.grid.value(file.density, 0, 0, 97), 0.0f);
  EXPECT_EQ(file.grid.value(file.emission[1], 0, 0, 97), -2.0f) << "light may be below the mean";
}

TEST(VolumeFiles, ANebulasFrameIsRefused) {
  const tests::TemporaryFolder folder;
  const Scene scene = scene_with_file(folder, "nebula.vdb", "emission_5577");
  SparseGrid grid;
  grid.channels = {{"emission_5577", ""}};
  grid.brick({0, 0, 0})[0] = 1.0f;
  VdbMetadata metadata;
  metadata.numbers["unit_cm"] = 3.0857e18;
  VdbOptions options;
  options.overwrite = true;
  write_vdb(folder / "nebula.vdb", std::move(grid), metadata, options);
  EXPECT_NE(
      tests::expect_error(ErrorKind::unreadable_input, [&] { read_volume_files(scene); }).find("nebula"),
      std::string::npos);
}

/// Rayleighs of the volumes alone, of all cells of a small film.
std::vector<double> seen(const Scene& scene) {
  FilmGeometry film;
  film.columns = film.rows = 40;
  film.cell_width_px = scene.camera.width / 40.0;
  film.cell_height_px = scene.camera.height / 40.0;
  const VolumeLight light = Volumes(scene, 1).light(scene, film);
  return {light.rayleigh.begin(), light.rayleigh.end()};
}

TEST(SceneGrid, AFootprintIsSeenAlikeByItsGrid) {
  const tests::TemporaryFolder folder;
  Scene scene;
  scene.file = folder / "scene.toml";
  scene.emission.lines = {557.7};
  scene.blur.width_deg = {0.0};
  scene.camera.elevation_deg = 40.0;
  scene.footprints.resize(1);
  Footprint& arc = scene.footprints[0];
  arc.east_km = {-60.0, 0.0, 60.0};
  arc.north_km = {-10.0, 5.0, -10.0};
  arc.center_km = {0.0, 150.0};
  arc.size_km = {200.0, 100.0};
  arc.width_km = 6.0;
  arc.energy_kev = 1.0;
  arc.top_km = 200.0;
  scene.march.step_km = 0.5;
  const std::vector<double> itself = seen(scene);
  SceneGridOptions options;
  options.voxel = 2.0;
  SceneGrid made = grid_of_scene(scene, options);
  write_vdb(folder / "arc.vdb", std::move(made.grid), {}, {});
  scene.footprints.clear();
  scene.volumes.resize(1);
  scene.volumes[0].file = "arc.vdb";
  const std::vector<double> by_grid = seen(scene);
  double sum = 0.0, sum_by_grid = 0.0, peak = 0.0, most_off = 0.0;
  for (std::size_t i = 0; i < itself.size(); ++i) {
    sum += itself[i];
    sum_by_grid += by_grid[i];
    peak = std::max(peak, itself[i]);
    most_off = std::max(most_off, std::abs(by_grid[i] - itself[i]));
  }
  ASSERT_GT(peak, 100.0);
  // Lines between centres 2 km apart, a third of the arc's standard deviation and a tenth of its light's
  // height, are 1 % off at the worst, and less in the mean.
  EXPECT_NEAR(sum_by_grid / sum, 1.0, 5e-3);
  EXPECT_LT(most_off, 0.03 * peak);
}

TEST(SceneGrid, ANebulaAndAuroraDoNotMix) {
  Scene scene;
  scene.nodes.resize(1);
  scene.nebulae.resize(1);
  scene.nebulae[0].gas = "node";
  scene.nebulae[0].inner_rayleigh = scene.nebulae[0].outer_rayleigh = {1.0, 2.0, 3.0};
  SceneGridOptions options;
  options.voxel = 0.1;
  const SceneGrid alone = grid_of_scene(scene, options);
  EXPECT_GT(alone.grid.sum(1), 0.0);
  EXPECT_GT(alone.unit_cm, 3e18);
  scene.sheets.resize(1);
  EXPECT_NE(tests::expect_error(ErrorKind::usage, [&] { grid_of_scene(scene, options); }).find("--of"),
            std::string::npos);
}

TEST(SceneGrid, AFileOfItsOwnComesBack) {
  const tests::TemporaryFolder folder;
  const Scene scene = scene_with_file(folder, "green.vdb", "emission_5577");
  SceneGridOptions options;
  options.voxel = 1.0;
  options.lines = {1};
  const SceneGrid again = grid_of_scene(scene, options);
  // The same voxels again: sampled at the centres they are what they were.
  EXPECT_EQ(again.grid.value(0, 3, 3, 99), 2.0f);
  EXPECT_EQ(again.grid.value(0, 3, 3, 104), 0.0f);
  EXPECT_NEAR(again.grid.sum(0), 2.0 * 512.0, 1e-3);
}

}  // namespace
}  // namespace vegard::scene_grid_test
