// Loops by a grid: their light beside that of strands, derivatives, and grids of what is on the Sun.
#include "sim/render/emitters/loop_grid.h"
#include "sim/render/emitters/emitter_makers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/base/error.h"
#include "sim/emit/grid/grid_filter.h"
#include "sim/emit/sun/sun_frame.h"
#include "sim/render/volumes/scene_grid.h"
#include "sim/scene/freedom/inert_parameter.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/expect_error.h"
#include "tests/support/free_paths.h"

namespace vegard::sim::loop_grid_test {
namespace {

const NumberAs<double> kPlain = [](const double& x) { return x; };

/// A loop on the limb of a Sun that is as near as a mountain.
Scene loop_scene() {
  Scene scene;
  scene.emission.lines = {557.7, 630.0};
  scene.sun.shown = true;
  scene.sun.distance_km = 1000.0;
  scene.sun.unit_km = 1.0;
  scene.sun.radius = 50.0;
  scene.sun.elevation_deg = 10.0;
  scene.sun.position_angle_deg = 20.0;
  Loop loop;
  loop.name = "a";
  loop.latitude_deg = 10.0;
  loop.longitude_deg = 80.0;
  loop.bearing_deg = 20.0;
  loop.height = 20.0;
  loop.width = 25.0;
  loop.strands = 5;
  loop.spread = 4.0;
  loop.strand_radius = 2.0;
  loop.root_noise = 0.5;
  loop.rayleigh = {10.0, 3.0};
  scene.loops = {loop};
  return scene;
}

constexpr int kAcross = 60;

/// [axis][ray], over the loop; angles in radians.
std::vector<double> directions(int axis) {
  std::vector<double> all;
  const double e0 = 10.0 * 0.017453292519943295;
  for (int j = 0; j < kAcross; ++j)
    for (int i = 0; i < kAcross; ++i) {
      const double a = 0.02 + 0.075 * (i + 0.5) / kAcross, e = e0 - 0.025 + 0.09 * (j + 0.5) / kAcross;
      const double enu[3] = {std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)};
      all.push_back(enu[axis]);
    }
  return all;
}

/// [ray] where they meet the photosphere, or infinity.
std::vector<double> ends(const Scene& scene) {
  const SunFrame<double> frame(scene.sun, kPlain);
  const std::vector<double> along[3] = {directions(0), directions(1), directions(2)};
  std::vector<double> all;
  for (std::size_t r = 0; r < along[0].size(); ++r) {
    const double enu[3] = {along[0][r], along[1][r], along[2][r]};
    const SkyRay<double> ray = frame.ray(enu);
    double half;
    all.push_back(meets_sphere(ray, scene.sun.radius, half) ? (-half - ray.observer) * frame.unit_km()
                                                            : std::numeric_limits<double>::infinity());
  }
  return all;
}

/// [line][ray], of everything on the Sun.
template <class T>
std::vector<T> light_of(const Scene& scene, const NumberAs<T>& number, const std::vector<double>& end) {
  const Emitters<T> emitters = make_emitters<T>(scene, {}, number, 1);
  constexpr std::size_t kRays = static_cast<std::size_t>(kAcross) * kAcross;
  std::vector<T> direction[3], all(2 * kRays, T(0.0));
  for (int axis = 0; axis < 3; ++axis)
    for (const double d : directions(axis)) direction[axis].push_back(T(d));
  for (const auto& emitter : emitters) {
    std::vector<T> light(2 * kRays, T(0.0)), kept(2 * kRays, T(1.0));
    std::vector<double> entry(kRays), depth(kRays);
    emitter->march({kRays, {direction[0].data(), direction[1].data(), direction[2].data()}, end.data()},
                   {2, light.data(), kept.data(), entry.data(), depth.data()});
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = all[i] + light[i];
  }
  return all;
}

double sum(const std::vector<double>& numbers) {
  double all = 0.0;
  for (const double x : numbers) all += x;
  return all;
}

/// Root of the mean square of the difference, over that of the first.
double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double off = 0.0, size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    off += (a[i] - b[i]) * (a[i] - b[i]);
    size += a[i] * a[i];
  }
  return std::sqrt(off / size);
}

TEST(LoopGrid, IsSeenAsItsStrandsAre) {
  Scene scene = loop_scene();
  const std::vector<double> strands = light_of<double>(scene, kPlain, ends(scene));
  ASSERT_GT(sum(strands), 0.0);
  double before = 1.0;
  for (const double voxel : {1.0, 0.5, 0.25}) {
    scene.loops[0].voxel = voxel;
    const std::vector<double> grid = light_of<double>(scene, kPlain, ends(scene));
    const double now = apart(strands, grid);
    EXPECT_LT(now, 0.6 * before) << voxel;  // linear interpolation: the error falls as the square
    before = now;
    for (std::size_t i = 0; i < grid.size() / 2; ++i)
      EXPECT_NEAR(grid[i + grid.size() / 2], 0.3 * grid[i], 1e-9 + 1e-6 * grid[i]);
  }
  EXPECT_LT(before, 0.02);
}

TEST(LoopGrid, BlurSpreadsAndSharpenGathersTheSameLight) {
  Scene scene = loop_scene();
  scene.loops[0].voxel = 0.5;
  const SparseGrid plain = loop_grid(scene, 0, 0.0, 2);
  scene.loops[0].blur = 2;
  const SparseGrid blurred = loop_grid(scene, 0, 0.0, 2);
  scene.loops[0].blur = 1;
  scene.loops[0].sharpen = 1;
  const SparseGrid back = loop_grid(scene, 0, 0.0, 2);
  EXPECT_NEAR(blurred.sum(0), plain.sum(0), 1e-5 * plain.sum(0));
  const auto square = [](const SparseGrid& grid) {
    double all = 0.0;
    for (const auto& [at, brick] : grid.bricks)
      for (const float x : brick) all += static_cast<double>(x) * x;
    return all;
  };
  EXPECT_LT(square(blurred), 0.9 * square(plain));
  EXPECT_GT(square(back), square(blurred));
  SparseGrid by_hand = plain;
  filter_grid(by_hand, blur_mask(), 1);
  filter_grid(by_hand, sharpen_mask(), 1);
  EXPECT_EQ(by_hand.bricks, back.bricks);
}

TEST(LoopGrid, DoesNotDependOnThreads) {
  Scene scene = loop_scene();
  scene.loops[0].voxel = 0.5;
  scene.loops[0].blur = 1;
  scene.loops[0].sharpen = 1;
  EXPECT_EQ(loop_grid(scene, 0, 0.0, 1).bricks, loop_grid(scene, 0, 0.0, 2).bricks);
}

TEST(LoopGrid, DerivativesByTheSunAreThoseOfCentralDifferences) {
  Scene scene = loop_scene();
  scene.loops[0].voxel = 0.5;
  // Where rays are stopped is a plain number, which does not move with the Sun.
  const std::vector<double> end = ends(scene);
  for (const char* name : {"sun.azimuth_deg", "sun.elevation_deg", "sun.position_angle_deg"}) {
    const ParameterPath path = [&] {
      for (const tests::FreePath& free : tests::free_paths(scene))
        if (free.path.text == name) return free.path;
      throw std::runtime_error(name);
    }();
    const double* at = real_value(scene, path);
    const std::vector<FreeDual> dual = light_of<FreeDual>(
        scene,
        [&](const double& x) {
          FreeDual d(x);
          if (&x == at) d.d.t[0] = 1.0;
          return d;
        },
        end);
    Scene more = scene, less = scene;
    const double step = 1e-4;
    *real_value(more, path) += step;
    *real_value(less, path) -= step;
    const std::vector<double> high = light_of<double>(more, kPlain, end),
                              low = light_of<double>(less, kPlain, end);
    std::vector<double> exact, difference;
    for (std::size_t i = 0; i < high.size(); ++i) {
      difference.push_back((high[i] - low[i]) / (2.0 * step));
      exact.push_back(dual[i].d.t[0]);
    }
    // Samples that pass from cell to cell have another slope there: one in a thousand.
    EXPECT_LT(apart(difference, exact), 0.02) << name;
  }
}

TEST(LoopGrid, ItsOwnNumbersMayNotBeFree) {
  Scene scene = loop_scene();
  for (const ParameterPath& path : all_paths(scene)) {
    if (path.row->table != "loop" || !path.row->can_be_free) continue;
    scene.loops[0].voxel = 0.5;
    EXPECT_TRUE(inert_parameter_complaint(scene, path)) << path.text;
    // By strands its place and shape may be, and everything else that this loop has.
    scene.loops[0].voxel = 0.0;
    const std::string& key = path.row->key;
    if (key == "height" || key == "width" || key == "tilt_deg" || key == "strand_radius" ||
        key == "latitude_deg") {
      EXPECT_FALSE(inert_parameter_complaint(scene, path)) << path.text;
    }
  }
}

TEST(LoopGrid, RefusesMoreMemoryThanItMayHave) {
  Scene scene = loop_scene();
  scene.loops[0].voxel = 0.1;
  try {
    loop_grid(scene, 0, 0.0, 1, 1 << 20);
    FAIL() << "it took what it wanted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    EXPECT_EQ(error.details().key, "loop.a.voxel");
  }
}

TEST(LoopGrid, RefusesMoreMemoryThanItMayHaveAfterBlur) {
  Scene scene = loop_scene();
  scene.loops[0].voxel = 0.5;
  const std::uint64_t bytes = loop_grid(scene, 0, 0.0, 1).bricks.size() * SparseGrid::kVoxels * sizeof(float);
  EXPECT_NO_THROW(loop_grid(scene, 0, 0.0, 1, bytes));
  scene.loops[0].blur = 4;
  try {
    loop_grid(scene, 0, 0.0, 1, bytes);
    FAIL() << "it took what it wanted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    EXPECT_EQ(error.details().key, "loop.a.voxel");
    EXPECT_NE(error.details().problem.find("blur"), std::string::npos);
  }
}

TEST(SceneGrid, WhatIsOnTheSunGoesIntoOneGridWhateverItsUnit) {
  Scene scene = loop_scene();
  SceneGridOptions options;
  options.voxel = 1.0;
  const SceneGrid strands = grid_of_scene(scene, options);
  EXPECT_GT(strands.grid.sum(0), 0.0);
  EXPECT_FALSE(strands.absorbs);

  Corona corona;
  corona.reach = 1.4;
  corona.rayleigh = {1.0, 1.0};
  scene.coronae = {corona};
  const SceneGrid both = grid_of_scene(scene, options);
  scene.loops.clear();
  const SceneGrid alone = grid_of_scene(scene, options);
  EXPECT_NEAR(both.grid.sum(0), strands.grid.sum(0) + alone.grid.sum(0), 1e-5 * both.grid.sum(0));

  // Kilometres on the Sun are not kilometres about the observer.
  EXPECT_EQ(both.unit_cm, 1e5);
  scene.sheets.emplace_back();
  EXPECT_THROW(grid_of_scene(scene, options), Error);
  scene.sheets.clear();
  scene.nodes.emplace_back();
  Nebula nebula;
  nebula.gas = "node";
  nebula.inner_rayleigh = nebula.outer_rayleigh = {1.0, 1.0};
  scene.nebulae = {nebula};
  EXPECT_THROW(grid_of_scene(scene, options), Error);
}

TEST(SceneGrid, RefusesVoxelsThatStrandsWouldFallBetween) {
  Scene scene = loop_scene();
  SceneGridOptions options;
  options.voxel = 2.0;
  EXPECT_NO_THROW(grid_of_scene(scene, options));
  options.voxel = 2.01;
  std::string text = tests::expect_error(ErrorKind::usage, [&] { grid_of_scene(scene, options); });
  EXPECT_TRUE(tests::has_facts(text, "loop 'a' | radius 2 | 2.01")) << text;
  EXPECT_NE(text.find("--voxel"), std::string::npos) << text;
  Bundle bundle;
  bundle.name = "b";
  bundle.foot_radius = 3.0;
  bundle.top_radius = 1.5;
  Ejection rope;
  rope.name = "c";
  rope.age_s = 0.0;
  scene.bundles = {bundle};
  options.voxel = 1.6;
  text = tests::expect_error(ErrorKind::usage, [&] { grid_of_scene(scene, options); });
  EXPECT_TRUE(tests::has_facts(text, "bundle 'b' | 1.5")) << text;
  // At its top a rope's strand has 0.1 of the rope's radius, which is a quarter of the front's height of 20;
  // at its feet three tenths of that, and a bit more where its first piece ends.
  scene.loops.clear();
  scene.bundles.clear();
  scene.ejections = {rope};
  options.voxel = 0.5;
  text = tests::expect_error(ErrorKind::usage, [&] { grid_of_scene(scene, options); });
  EXPECT_NE(text.find("ejection 'c'"), std::string::npos) << text;
  EXPECT_GT(thinnest_part(scene).radius, 0.3 * 0.5);
  EXPECT_LT(thinnest_part(scene).radius, 0.5 * 0.5);
  scene.ejections[0].kind = EjectionKind::shell;
  EXPECT_TRUE(thinnest_part(scene).what.empty());
  scene.ejections[0].kind = EjectionKind::rope;
  scene.sun.shown = false;
  EXPECT_TRUE(thinnest_part(scene).what.empty());
}

TEST(SceneGrid, ChoosesAVoxelByWhatThereIs) {
  Scene scene = loop_scene();
  SceneGridOptions options;
  options.voxel = 0.0;
  options.lines = {0};
  // Strands of radius 2 about 25 wide and 20 high: 300 to a side are finer than half the radius.
  const double fine = grid_of_scene(scene, options).grid.voxel;
  EXPECT_GT(fine, 25.0 / 300.0);
  EXPECT_LT(fine, 45.0 / 300.0);
  // In thin strands the radius counts.
  scene.loops[0].strand_radius = 0.1;
  EXPECT_DOUBLE_EQ(grid_of_scene(scene, options).grid.voxel, 0.05);
  // With more around a whole radius, where half of it would be too many voxels.
  Corona corona;
  corona.reach = 1.4;
  corona.rayleigh = {1.0, 1.0};
  scene.coronae = {corona};
  scene.loops[0].strand_radius = 0.2;
  options.memory_limit = 1 << 24;
  const std::string text = tests::expect_error(ErrorKind::usage, [&] { grid_of_scene(scene, options); });
  EXPECT_NE(text.find("0.2"), std::string::npos) << text;
  EXPECT_NE(text.find("--of NAME"), std::string::npos) << text;
  // Alone it is 140 wide.
  scene.loops.clear();
  options.memory_limit = std::uint64_t{4} << 30;
  options.box = Box3{{-70.0, -70.0, -3.0}, {70.0, 70.0, 3.0}};
  EXPECT_NEAR(grid_of_scene(scene, options).grid.voxel, 140.0 / 300.0, 0.011);
}

TEST(SceneGrid, OfALoopByAGridHoldsWhatItsStrandsDo) {
  Scene scene = loop_scene();
  SceneGridOptions options;
  options.voxel = 0.5;
  const SparseGrid strands = grid_of_scene(scene, options).grid;
  scene.loops[0].voxel = 0.5;  // whose voxels are the scene's
  const SparseGrid voxels = grid_of_scene(scene, options).grid;
  EXPECT_GT(strands.sum(0), 0.0);
  EXPECT_NEAR(voxels.sum(0), strands.sum(0), 1e-5 * strands.sum(0));
  // The loop's own voxels reach below the photosphere, and there the scene's are dark.
  const auto within = [](const SparseGrid& grid) {
    double sum = 0.0;
    for (const auto& [at, brick] : grid.bricks)
      for (int v = 0; v < SparseGrid::kVoxels; ++v) {
        const double x = 0.5 * (at.x * 8 + v / 64 + 0.5), y = 0.5 * (at.y * 8 + v / 8 % 8 + 0.5),
                     z = 0.5 * (at.z * 8 + v % 8 + 0.5);
        if (x * x + y * y + z * z < 2500.0) sum += brick[v];
      }
    return sum;
  };
  EXPECT_GT(within(loop_grid(scene, 0, 0.0, 1)), 0.0);
  EXPECT_EQ(within(voxels), 0.0);
}

}  // namespace
}  // namespace vegard::sim::loop_grid_test
