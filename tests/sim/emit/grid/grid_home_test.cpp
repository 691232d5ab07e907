// Grids that are at home on the Sun, 1.5e8 km away: places, light, and derivatives by the Sun's numbers.
#include "sim/emit/grid/grid_home.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/emit/grid/grid_emitter.h"

namespace vegard::grid_home_test {
namespace {

using namespace sim;

const NumberAs<double> kPlain = [](const double& x) { return x; };
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Sun some_sun() {
  Sun sun;
  sun.shown = true;
  sun.azimuth_deg = 151.0;
  sun.elevation_deg = 23.0;
  sun.position_angle_deg = 17.0;
  sun.latitude_deg = -6.3;
  sun.longitude_deg = 211.0;
  return sun;
}

/// Voxels about a place at the limb, some 700 units from the Sun's middle, of what `of` says of their
/// centres.
template <class Of>
SparseGrid at_limb(const Sun& sun, int side, double voxel, const Of& of) {
  SparseGrid grid;
  grid.voxel = voxel;
  const double c = std::cos(0.4), s = std::sin(0.4);
  grid.axes = {{{c, s, 0.0}, {-s, c, 0.0}, {0.0, 0.0, 1.0}}};
  grid.channels = {{"density", ""}};
  const double right_up_near[3] = {500.0, 490.0, 30.0};
  SunFrame<double>(sun, kPlain).from_sky(right_up_near, grid.origin.data());
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = 0; k < side; ++k)
        grid.brick({i >> 3, j >> 3, k >> 3})[SparseGrid::within(i & 7, j & 7, k & 7)] = of(i, j, k);
  return grid;
}

GridBricks bricks_of(const SparseGrid& grid, int lines = 1, int density = -1) {
  return GridBricks(grid, std::vector<int>(lines, 0), density, "a.vdb", Site(), Site());
}

/// Towards the voxel (i, j, k), which may lie between voxels.
void aim(const Sun& sun, const SparseGrid& grid, double i, double j, double k, double enu[3]) {
  const SunFrame<double> frame(sun, kPlain);
  double observer[3], axis[3][3], to[3], length = 0.0;
  frame.observer(observer);
  const double at[3] = {i + 0.5, j + 0.5, k + 0.5};
  for (int c = 0; c < 3; ++c) {
    to[c] = grid.origin[c] - observer[c];
    for (int a = 0; a < 3; ++a) to[c] += grid.voxel * grid.axes[a][c] * at[a];
    length += to[c] * to[c];
  }
  for (int e = 0; e < 3; ++e) {
    double unit[3] = {e == 0 ? 1.0 : 0.0, e == 1 ? 1.0 : 0.0, e == 2 ? 1.0 : 0.0}, in_sky[3];
    frame.sky().turn(unit, in_sky);
    frame.from_sky(in_sky, axis[e]);
    enu[e] = 0.0;
    for (int c = 0; c < 3; ++c) enu[e] += axis[e][c] * to[c] / std::sqrt(length);
  }
}

double light_of(const Emitter<double>& emitter, const double enu[3], double* depth_km = nullptr) {
  double rayleigh = 0.0, kept = 1.0, entry = kInfinity, depth = kInfinity;
  emitter.march({1, {enu, enu + 1, enu + 2}, &kInfinity}, {1, &rayleigh, &kept, &entry, &depth});
  if (depth_km != nullptr) *depth_km = depth;
  return rayleigh;
}

TEST(GridHome, PlacesOnARayAreThoseOfTheSunsFrame) {
  const Sun sun = some_sun();
  const SparseGrid grid = at_limb(sun, 16, 0.5, [](int, int, int) { return 1.0f; });
  const GridBricks bricks = bricks_of(grid);
  Volume volume;
  volume.frame = VolumeFrame::sun;
  const GridHome<double> home = grid_home<double>(bricks, volume, &sun, kPlain);
  EXPECT_EQ(home.voxel_km, 500.0);
  double enu[3];
  aim(sun, grid, 5.25, 9.5, 3.0, enu);
  // By the ray's nearest place, which keeps its digits however far the observer is.
  const SkyRay<double> ray = SunFrame<double>(sun, kPlain).ray(enu);
  for (const double beside : {-3.0, 0.0, 4.0}) {
    const double s = 25.0 + beside, km = (s - ray.observer) * sun.unit_km;
    for (int a = 0; a < 3; ++a) {
      double by_home = home.from[a], by_frame = -0.5;
      for (int c = 0; c < 3; ++c) {
        by_home += home.turn[a][c] * enu[c] * km;
        by_frame += grid.axes[a][c] * (ray.nearest[c] + s * ray.direction[c] - grid.origin[c]) / grid.voxel;
      }
      // 3e5 voxels away, with numbers of 53 bits that are summed some ten times.
      EXPECT_NEAR(by_home, by_frame, 1e-9);
    }
  }
}

TEST(GridHome, DensityShinesByTheUnitOfTheSun) {
  const Sun sun = some_sun();
  const int side = 24;
  const SparseGrid grid = at_limb(sun, side, 0.5, [](int, int, int) { return 2.0f; });
  const GridBricks bricks = bricks_of(grid);
  Volume volume;
  volume.frame = VolumeFrame::sun;
  volume.density_rayleigh = {30.0};
  volume.gain = 1.5;
  volume.step_voxels = 0.05;
  const GridEmitter<double> emitter(bricks, volume, kPlain, &sun);
  // Through the middle, as far as the sides let it: L = the box's shortest way along the ray.
  double enu[3];
  aim(sun, grid, 11.3, 12.1, 11.7, enu);
  const GridHome<double> home = grid_home<double>(bricks, volume, &sun, kPlain);
  double enter = -kInfinity, leave = kInfinity;
  for (int a = 0; a < 3; ++a) {
    double along = 0.0;
    for (int c = 0; c < 3; ++c) along += home.turn[a][c] * enu[c];
    const double one = (-0.5 - home.from[a]) / along, other = (side - 0.5 - home.from[a]) / along;
    enter = std::max(enter, std::min(one, other));
    leave = std::min(leave, std::max(one, other));
  }
  double depth_km;
  const double units = (leave - enter) / sun.unit_km, light = light_of(emitter, enu, &depth_km);
  ASSERT_GT(units, 5.0);
  // Linear flanks count half a voxel each, whatever their slope; a step is 0.025 units.
  EXPECT_NEAR(light, 1.5 * 30.0 * 2.0 * units, 1.5 * 30.0 * 2.0 * 0.05);
  EXPECT_NEAR(depth_km, 0.5 * (enter + leave), 50.0);
  // The same grid on the ground counts kilometres, and emission photons.
  Volume on_ground = volume;
  on_ground.frame = VolumeFrame::site;
  EXPECT_EQ(grid_home<double>(bricks, on_ground, &sun, kPlain).light[0], 45.0);
  EXPECT_EQ(home.light[0], 0.045);
  on_ground.density_rayleigh.clear();
  EXPECT_DOUBLE_EQ(grid_home<double>(bricks, on_ground, &sun, kPlain).light[0], 0.15);
}

TEST(GridHome, AShiftIsInKilometresOfTheSunsFrame) {
  const Sun sun = some_sun();
  const SparseGrid grid = at_limb(sun, 16, 0.5, [](int, int, int) { return 1.0f; });
  SparseGrid moved = grid;
  Volume volume;
  volume.frame = VolumeFrame::sun;
  const GridHome<double> plain = grid_home<double>(bricks_of(grid), volume, &sun, kPlain);
  volume.shift_km = {3000.0, -500.0, 7000.0};
  const GridHome<double> shifted = grid_home<double>(bricks_of(grid), volume, &sun, kPlain);
  for (int c = 0; c < 3; ++c) moved.origin[c] += 1e-3 * volume.shift_km[c];
  volume.shift_km = {0.0, 0.0, 0.0};
  const GridHome<double> other = grid_home<double>(bricks_of(moved), volume, &sun, kPlain);
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(shifted.from[a], other.from[a], 1e-9);
    EXPECT_GT(std::abs(shifted.from[a] - plain.from[a]), 0.5);
  }
}

TEST(GridHome, DerivativesByTheSunsNumbersAreThoseOfTheSum) {
  Sun sun = some_sun();
  sun.distance_km = 3e6;  // nearer, so that differences keep their digits
  const SparseGrid grid = at_limb(sun, 24, 4.0, [](int i, int j, int k) {
    return static_cast<float>(2.0 + std::sin(0.3 * i) + std::cos(0.4 * j) * std::sin(0.2 * k));
  });
  const GridBricks bricks = bricks_of(grid);
  Volume volume;
  volume.frame = VolumeFrame::sun;
  volume.density_rayleigh = {30.0};
  volume.gain = 1.5;
  double enu[3];
  aim(sun, grid, 11.3, 12.1, 11.7, enu);
  double* const free[] = {&sun.azimuth_deg,    &sun.elevation_deg,         &sun.position_angle_deg,
                          &sun.latitude_deg,   &sun.longitude_deg,         &sun.distance_km,
                          &volume.gain,        &volume.shift_km[0],        &volume.shift_km[1],
                          &volume.shift_km[2], &volume.density_rayleigh[0]};
  constexpr int kFree = 11;
  const auto light = [&](bool with_derivatives) {
    const GridEmitter<FreeDual> emitter(
        bricks, volume,
        [&](const double& x) {
          FreeDual out(x);
          for (int i = 0; i < kFree; ++i)
            if (with_derivatives && free[i] == &x) out.d.t[i] = 1.0;
          return out;
        },
        &sun);
    const FreeDual d[3] = {FreeDual(enu[0]), FreeDual(enu[1]), FreeDual(enu[2])};
    FreeDual rayleigh(0.0), kept(1.0);
    double entry = kInfinity, depth = kInfinity;
    emitter.march({1, {d, d + 1, d + 2}, &kInfinity}, {1, &rayleigh, &kept, &entry, &depth});
    return rayleigh;
  };
  const FreeDual all = light(true);
  ASSERT_GT(all.v, 0.0);
  for (int i = 0; i < kFree; ++i) {
    // So far that the grid moves by some 1e-6 of a voxel.
    const double was = *free[i], h = i < 3 ? 1e-7 : i < 5 ? 1e-6 : i == 6 || i == 10 ? 1e-4 : 1e-2;
    *free[i] = was + h;
    const double more = light(false).v;
    *free[i] = was - h;
    const double slope = (more - light(false).v) / (2.0 * h);
    *free[i] = was;
    EXPECT_NEAR(all.d.t[i], slope, 1e-4 * std::abs(slope) + 1e-7 * all.v) << i;
  }
}

TEST(GridHome, AFieldOfTheSunIsInItsUnit) {
  const Sun sun = some_sun();
  const SparseGrid grid = at_limb(sun, 16, 0.5, [](int i, int, int) { return static_cast<float>(i); });
  const GridBricks bricks = bricks_of(grid);
  Volume volume;
  volume.frame = VolumeFrame::sun;
  volume.density_rayleigh = {30.0};
  volume.shift_km = {2000.0, 0.0, 0.0};
  const GridField field(bricks, volume, &sun);
  EXPECT_EQ(field.unit_cm(), 1e8);
  double at[3];
  for (int c = 0; c < 3; ++c) {
    at[c] = grid.origin[c] + (c == 0 ? 2.0 : 0.0);
    const double voxel[3] = {7.5, 8.5, 9.5};
    for (int a = 0; a < 3; ++a) at[c] += grid.voxel * grid.axes[a][c] * voxel[a];
  }
  float light, density;
  float* const emission[] = {&light};
  const double* const points[] = {at, at + 1, at + 2};
  field.sample(1, points, emission, &density);
  // 7 of density, of which a unit of a megametre gives 30 R: a kilometre of 1 photon cm^-3 s^-1 gives 0.1 R.
  EXPECT_NEAR(light, 7.0 * 30.0 / 100.0, 1e-5);
  const Box3 box = field.bounds();
  for (int c = 0; c < 3; ++c) {
    EXPECT_LT(box.low[c], at[c]);
    EXPECT_GT(box.high[c], at[c]);
  }
}

}  // namespace
}  // namespace vegard::grid_home_test
