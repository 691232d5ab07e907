// Light from grids along rays: against what is known of a linear field, against a sum without bricks, and its
// derivatives against differences.
#include "sim/emit/grid/grid_emitter.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <functional>
#include <limits>

#include "sim/scene/structs/site_axes.h"
#include "tests/support/expect_error.h"

namespace vegard::grid_emitter_test {
namespace {

using namespace sim;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Voxels from `low` to below `high` along each axis, of what the functions say of their centres.
SparseGrid filled(int low, int high, double voxel,
                  const std::vector<std::function<float(const double[3])>>& of) {
  SparseGrid grid;
  grid.voxel = voxel;
  grid.origin = {1.3, 2.7, -0.4};
  for (std::size_t c = 0; c < of.size(); ++c) grid.channels.push_back({"channel", ""});
  for (int i = low; i < high; ++i)
    for (int j = low; j < high; ++j)
      for (int k = low; k < high; ++k) {
        const double at[3] = {grid.origin[0] + (i + 0.5) * voxel, grid.origin[1] + (j + 0.5) * voxel,
                              grid.origin[2] + (k + 0.5) * voxel};
        auto& brick = grid.brick({i >> 3, j >> 3, k >> 3});
        for (std::size_t c = 0; c < of.size(); ++c)
          brick[c * SparseGrid::kVoxels + SparseGrid::within(i & 7, j & 7, k & 7)] = of[c](at);
      }
  return grid;
}

/// Linear interpolation between voxels' centres, straight from the voxels.
double looked_up(const SparseGrid& grid, int channel, const double at[3]) {
  double u[3], sum = 0.0;
  int low[3];
  for (int a = 0; a < 3; ++a) {
    u[a] = (at[a] - grid.origin[a]) / grid.voxel - 0.5;
    low[a] = static_cast<int>(std::floor(u[a]));
  }
  for (int p = 0; p < 8; ++p) {
    double weight = 1.0;
    int v[3];
    for (int a = 0; a < 3; ++a) {
      const int up = p >> a & 1;
      v[a] = low[a] + up;
      weight *= up ? u[a] - low[a] : 1.0 - (u[a] - low[a]);
    }
    sum += weight * grid.value(channel, v[0], v[1], v[2]);
  }
  return sum;
}

struct Light {
  std::vector<double> rayleigh, kept;
  double entry_km, depth_km;
};

Light light_of(const Emitter<double>& emitter, const double direction[3], int lines,
               double end_km = kInfinity) {
  Light out{std::vector<double>(lines, 0.0), std::vector<double>(lines, 1.0), kInfinity, kInfinity};
  emitter.march({1, {direction, direction + 1, direction + 2}, &end_km},
                {lines, out.rayleigh.data(), out.kept.data(), &out.entry_km, &out.depth_km});
  return out;
}

GridBricks bricks_of(const SparseGrid& grid, int lines, int density = -1) {
  std::vector<int> emission;
  for (int l = 0; l < lines; ++l) emission.push_back(l);
  return GridBricks(grid, emission, density, "a.vdb", Site(), Site());
}

const NumberAs<double> kPlain = [](const double& x) { return x; };

double bumps(const double at[3]) {
  return 1.5 + std::sin(at[0]) * std::cos(1.3 * at[1]) + 0.5 * std::sin(2.0 * at[2]);
}

const double kDirections[4][3] = {{0.6, 0.8, 0.0}, {0.48, 0.64, 0.6}, {0.36, 0.48, 0.8}, {0.0, 1.0, 0.0}};

TEST(GridEmitter, SumsWhatTheVoxelsHold) {
  for (const int lines : {1, 3, 5}) {
    std::vector<std::function<float(const double[3])>> of;
    for (int l = 0; l < lines; ++l)
      of.push_back([l](const double at[3]) { return static_cast<float>((l + 1) * bumps(at)); });
    const SparseGrid grid = filled(-5, 14, 0.31, of);
    const GridBricks bricks = bricks_of(grid, lines);
    EXPECT_EQ(bricks.stride(), lines == 1 ? 1 : lines == 3 ? 4 : 8);
    Volume volume;
    volume.gain = 2.0;
    volume.step_voxels = 0.37;
    const GridEmitter<double> emitter(bricks, volume, kPlain);
    for (const auto& d : kDirections) {
      const double step = volume.step_voxels * grid.voxel;
      std::vector<double> sum(lines, 0.0);
      double first = kInfinity, weight = 0.0, weighted = 0.0;
      for (int k = 0; k < 200; ++k) {
        const double t = (k + 0.5) * step, at[3] = {t * d[0], t * d[1], t * d[2]};
        for (int l = 0; l < lines; ++l) {
          const double light = looked_up(grid, l, at);
          sum[l] += light;
          weight += light;
          weighted += light * t;
          if (light > 0.0) first = std::min(first, t);
        }
      }
      const Light light = light_of(emitter, d, lines);
      // Places within a brick and sums over one are floats: 8 voxels of 24 bits, some 30 numbers.
      for (int l = 0; l < lines; ++l)
        EXPECT_NEAR(light.rayleigh[l], 0.2 * step * sum[l], 2e-6 * light.rayleigh[l] + 1e-9);
      ASSERT_GT(weight, 0.0);
      EXPECT_NEAR(light.depth_km, weighted / weight, 1e-5);
      EXPECT_LE(light.entry_km, first + step);
    }
  }
}

TEST(GridEmitter, RaysEndAtTheirEnd) {
  const SparseGrid grid =
      filled(0, 16, 0.31, {[](const double at[3]) { return static_cast<float>(bumps(at)); }});
  const GridBricks bricks = bricks_of(grid, 1);
  const GridEmitter<double> emitter(bricks, Volume(), kPlain);
  const double* d = kDirections[0];
  const double whole = light_of(emitter, d, 1).rayleigh[0];
  double before = 0.0;
  for (const double end : {0.0, 3.5, 4.5, 5.5, 40.0}) {
    const double light = light_of(emitter, d, 1, end).rayleigh[0];
    EXPECT_GE(light, before);
    before = light;
  }
  EXPECT_EQ(light_of(emitter, d, 1, 0.0).rayleigh[0], 0.0);
  EXPECT_LT(light_of(emitter, d, 1, 4.5).rayleigh[0], 0.9 * whole);
  EXPECT_EQ(before, whole);
}

TEST(GridEmitter, EmptySpaceIsPassedOver) {
  // Two far bricks: the sum is that of either alone.
  SparseGrid near = filled(0, 8, 0.5, {[](const double[3]) { return 1.0f; }}), both = near, far = near;
  far.bricks.clear();
  for (const auto& [at, numbers] : near.bricks) {
    far.bricks[{at.x + 60, at.y + 80, at.z}] = numbers;
    both.bricks[{at.x + 60, at.y + 80, at.z}] = numbers;
  }
  const auto light = [](const SparseGrid& grid) {
    const GridBricks bricks = bricks_of(grid, 1);
    const double d[3] = {0.6, 0.8, 0.0};
    return light_of(GridEmitter<double>(bricks, Volume(), kPlain), d, 1).rayleigh[0];
  };
  EXPECT_GT(light(near), 0.0);
  EXPECT_GT(light(far), 0.0);
  EXPECT_NEAR(light(both), light(near) + light(far), 1e-6 * light(both));  // sums of some forty floats
}

TEST(GridEmitter, ASlabAbsorbsAsItMust) {
  // Uniform light e and extinction k through a length L: 0.1 e (1 - exp(-k L)) / k, kept exp(-k L). Along an
  // axis through voxels' centres L is the voxels' extent: the linear flanks count half a voxel each.
  const SparseGrid grid =
      filled(0, 40, 0.25, {[](const double[3]) { return 3.0f; }, [](const double[3]) { return 2.0f; }});
  const GridBricks bricks = bricks_of(grid, 1, 1);
  Volume volume;
  volume.step_voxels = 0.05;
  volume.extinction_per_km = 0.2;
  volume.shift_km = {-6.0, 4.0, -4.0};
  const GridEmitter<double> emitter(bricks, volume, kPlain);
  ASSERT_TRUE(emitter.absorbs());
  const double d[3] = {0.0, 1.0, 0.0};
  const Light light = light_of(emitter, d, 1);
  const double k = 0.4, length = 40 * 0.25;
  EXPECT_NEAR(light.kept[0], std::exp(-k * length), 1e-6);
  // What the flanks do to the light is of second order in their depth, 0.05 each.
  EXPECT_NEAR(light.rayleigh[0], 0.3 * (1.0 - std::exp(-k * length)) / k, 1e-3);
}

TEST(GridEmitter, DerivativesAreThoseOfTheSum) {
  const SparseGrid grid = filled(0, 24, 0.31,
                                 {[](const double at[3]) { return static_cast<float>(bumps(at)); },
                                  [](const double at[3]) { return static_cast<float>(0.3 + 0.1 * at[0]); }});
  const GridBricks bricks = bricks_of(grid, 1, 1);
  for (const double extinction : {0.0, 0.3}) {
    Volume volume;
    volume.gain = 1.7;
    volume.extinction_per_km = extinction;
    volume.shift_km = {0.21, -0.13, 0.05};
    double direction[3] = {0.48, 0.64, 0.6};
    // The numbers that are free: gain, shift, direction, and the extinction where there is one.
    std::vector<double*> free = {&volume.gain,  &volume.shift_km[0], &volume.shift_km[1], &volume.shift_km[2],
                                 &direction[0], &direction[1],       &direction[2]};
    if (extinction > 0.0) free.push_back(&volume.extinction_per_km);
    const auto dual = [&](const double& x) {
      FreeDual out(x);
      for (std::size_t i = 0; i < free.size(); ++i)
        if (free[i] == &x) out.d.t[i] = 1.0;
      return out;
    };
    const GridEmitter<FreeDual> emitter(bricks, volume, dual);
    const FreeDual d[3] = {dual(direction[0]), dual(direction[1]), dual(direction[2])};
    FreeDual rayleigh(0.0), kept(1.0);
    double entry = kInfinity, depth = kInfinity;
    const double end = kInfinity;
    emitter.march({1, {d, d + 1, d + 2}, &end}, {1, &rayleigh, &kept, &entry, &depth});
    const auto value = [&](bool of_kept) {
      // By the same sum in doubles: what differs are 1e-6 of floats where nothing absorbs.
      const NumberAs<FreeDual> none = [](const double& x) { return FreeDual(x); };
      const GridEmitter<FreeDual> plain(bricks, volume, none);
      const FreeDual at[3] = {direction[0], direction[1], direction[2]};
      FreeDual light(0.0), through(1.0);
      plain.march({1, {at, at + 1, at + 2}, &end}, {1, &light, &through, &entry, &depth});
      return of_kept ? through.v : light.v;
    };
    EXPECT_EQ(rayleigh.v, value(false));
    const double plain = light_of(GridEmitter<double>(bricks, volume, kPlain), direction, 1).rayleigh[0];
    EXPECT_NEAR(plain, rayleigh.v, 2e-6 * plain);
    for (std::size_t i = 0; i < free.size(); ++i) {
      // Short, so that hardly a sample passes from one cell to the next, where the slope has a step.
      const double was = *free[i], h = 1e-7;
      double slope[2];
      for (const bool of_kept : {false, true}) {
        *free[i] = was + h;
        const double more = value(of_kept);
        *free[i] = was - h;
        slope[of_kept] = (more - value(of_kept)) / (2.0 * h);
        *free[i] = was;
      }
      EXPECT_NEAR(rayleigh.d.t[i], slope[0], 2e-6 * (1.0 + std::abs(slope[0]))) << i << " " << extinction;
      EXPECT_NEAR(kept.d.t[i], slope[1], 2e-6 * (1.0 + std::abs(slope[1]))) << i << " " << extinction;
    }
  }
}

TEST(GridEmitter, GivesTheSameBitsForEveryInstructionSet) {
  const SparseGrid grid = filled(-9, 21, 0.31,
                                 {[](const double at[3]) { return static_cast<float>(bumps(at)); },
                                  [](const double at[3]) { return static_cast<float>(at[1]); },
                                  [](const double at[3]) { return static_cast<float>(at[2]); }});
  const GridBricks bricks = bricks_of(grid, 3);
  const GridEmitter<double> emitter(bricks, Volume(), kPlain);
  const auto all = [&] {
    std::vector<double> out;
    for (const auto& d : kDirections) {
      const Light light = light_of(emitter, d, 3);
      out.insert(out.end(), light.rayleigh.begin(), light.rayleigh.end());
      out.push_back(light.depth_km);
    }
    return out;
  };
  const std::vector<double> best = all();
  EXPECT_GT(best[0], 0.0);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_EQ(all(), best) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(GridEmitter, AnotherSiteSeesTheSamePlace) {
  Site home, there;
  home.latitude_deg = 65.0;
  home.longitude_deg = 10.0;
  home.altitude_m = 200.0;
  there.latitude_deg = 66.0;
  there.longitude_deg = 12.5;
  there.altitude_m = 1500.0;
  const SiteTurn turn = turn_between(home, there);
  // The same point from the Earth's centre, by either frame.
  const double point[3] = {40.0, -30.0, 120.0};
  double moved[3];
  for (int i = 0; i < 3; ++i) {
    moved[i] = turn.shift_km[i];
    for (int j = 0; j < 3; ++j) moved[i] += turn.turn[i][j] * point[j];
  }
  const SiteAxes a = axes_at(home), b = axes_at(there);
  for (int k = 0; k < 3; ++k) {
    double one = a.axis[2][k] * (kEarthRadiusKm + 0.2), other = b.axis[2][k] * (kEarthRadiusKm + 1.5);
    for (int i = 0; i < 3; ++i) {
      one += a.axis[i][k] * point[i];
      other += b.axis[i][k] * moved[i];
    }
    EXPECT_NEAR(one, other, 1e-9);
  }
  // A blob about that point is seen where it is, and nowhere else.
  SparseGrid grid;
  grid.voxel = 1.0;
  grid.origin = {point[0] - 4.0, point[1] - 4.0, point[2] - 4.0};
  grid.channels = {{"channel", ""}};
  for (float& x : grid.brick({0, 0, 0})) x = 1.0f;
  const GridBricks bricks(grid, {0}, -1, "a.vdb", home, there);
  const GridEmitter<double> emitter(bricks, Volume(), kPlain);
  const double r = std::sqrt(moved[0] * moved[0] + moved[1] * moved[1] + moved[2] * moved[2]);
  const double towards[3] = {moved[0] / r, moved[1] / r, moved[2] / r};
  const Light light = light_of(emitter, towards, 1);
  EXPECT_GT(light.rayleigh[0], 0.7);
  EXPECT_NEAR(light.depth_km, r, 0.5);
  const double away[3] = {towards[0], -towards[1], towards[2]};
  EXPECT_EQ(light_of(emitter, away, 1).rayleigh[0], 0.0);
}

TEST(GridField, IsTheGridAndDarkWhereItIsDark) {
  SparseGrid grid = filled(-9, 21, 0.31, {[](const double at[3]) { return static_cast<float>(bumps(at)); }});
  const double c = std::cos(0.3), s = std::sin(0.3);
  Volume volume;
  volume.gain = 3.0;
  volume.shift_km = {2.0, -1.0, 0.5};
  {
    const GridBricks bricks = bricks_of(grid, 1);
    const GridField field(bricks, volume);
    for (int n = 0; n < 50; ++n) {
      const double at[3] = {0.1 * n, 0.07 * n - 1.0, 0.13 * n - 2.0};
      const double unmoved[3] = {at[0] - 2.0, at[1] + 1.0, at[2] - 0.5};
      float light, density;
      float* const emission[] = {&light};
      const double* const points[] = {at, at + 1, at + 2};
      field.sample(1, points, emission, &density);
      EXPECT_NEAR(light, 3.0 * looked_up(grid, 0, unmoved), 1e-5);
    }
  }
  grid.axes = {{{c, s, 0.0}, {-s, c, 0.0}, {0.0, 0.0, 1.0}}};
  const GridBricks bricks = bricks_of(grid, 1);
  const GridField field(bricks, volume);
  const Box3 box = field.bounds();
  int lit_boxes = 0, dark_boxes = 0;
  for (int n = 0; n < 27 * 64; ++n) {
    const int cell[3] = {n % 12, n / 12 % 12, n / 144};
    Box3 part;
    for (int a = 0; a < 3; ++a) {
      const double edge = (box.high[a] - box.low[a]) / 12.0;
      part.low[a] = box.low[a] + cell[a] * edge;
      part.high[a] = part.low[a] + edge;
    }
    float most = 0.0f;
    for (int p = 0; p < 27; ++p) {
      const double at[3] = {part.low[0] + (p % 3) * 0.5 * (part.high[0] - part.low[0]),
                            part.low[1] + (p / 3 % 3) * 0.5 * (part.high[1] - part.low[1]),
                            part.low[2] + (p / 9) * 0.5 * (part.high[2] - part.low[2])};
      float light, density;
      float* const emission[] = {&light};
      const double* const points[] = {at, at + 1, at + 2};
      field.sample(1, points, emission, &density);
      most = std::max(most, light);
    }
    if (field.is_dark(part)) {
      EXPECT_EQ(most, 0.0f);
      ++dark_boxes;
    } else {
      ++lit_boxes;
    }
  }
  EXPECT_GT(lit_boxes, 0);
  EXPECT_GT(dark_boxes, 0);
}

TEST(GridWalk, ARayThatIsNoneMeetsNothing) {
  const SparseGrid grid = filled(-5, 14, 0.31, {[](const double*) { return 1.0f; }});
  const GridBricks bricks = bricks_of(grid, 1);
  const double nan = std::nan("");
  const auto met = [&](const GridRay& given) {
    GridRay ray = given;
    ray.aim();
    int count = 0;
    walk_bricks(bricks, ray, kInfinity, [&](std::int32_t, const int*, double enter, double leave) {
      EXPECT_TRUE(std::isfinite(enter) && std::isfinite(leave));
      ++count;
    });
    return count;
  };
  EXPECT_GT(met({{1.0, 1.0, 1.0}, {0.0, 0.0, 1.0}, {}}), 0);
  EXPECT_GT(met({{1.0, 1.0, 1.0}, {0.0, 1e-310, 1.0}, {}}), 0);
  for (int a = 0; a < 3; ++a)
    for (const double bad : {nan, kInfinity, -kInfinity}) {
      GridRay ray = {{1.0, 1.0, 1.0}, {0.6, 0.0, 0.8}, {}};
      ray.from[a] = bad;
      EXPECT_EQ(met(ray), 0) << a << " " << bad;
      ray.from[a] = 1.0;
      ray.along[a] = bad;
      EXPECT_EQ(met(ray), 0) << a << " " << bad;
    }
  EXPECT_EQ(met({{1.0, 1.0, 1.0}, {0.0, 0.0, 0.0}, {}}), 0) << "it stands still within";
  EXPECT_EQ(first_sample(1e300, 1e10), first_sample(kInfinity, 1.0)) << "a number for all that is too far";
}

TEST(GridBricks, RefuseWhatTakesTooMuch) {
  // Each voxel is at a corner that eight bricks share.
  SparseGrid grid;
  grid.channels = {{"channel", ""}};
  for (int i = 0; i < 5; ++i) grid.brick({2 * i, 0, 0})[0] = 1.0f;
  const std::uint64_t bytes = 5 * 512 * 4 + 5 * 8 * 729 * 4;
  const auto made = [&](std::uint64_t most) {
    return GridBricks(grid, {0}, -1, "a.vdb", Site(), Site(), most).bricks();
  };
  EXPECT_EQ(made(bytes), 40u);
  const std::string text = tests::expect_error(ErrorKind::unreadable_input, [&] { made(bytes - 1); });
  EXPECT_NE(text.find("a.vdb"), std::string::npos) << text;
}

}  // namespace
}  // namespace vegard::grid_emitter_test
