#include "sim/emit/grid/grid_lamp.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "sim/base/number/constants.h"
#include "sim/base/number/gauss_quadrature.h"
#include "sim/base/number/vec3.h"
#include "sim/base/parallel.h"
#include "sim/emit/grid/grid_home.h"
#include "sim/emit/grid/grid_trilinear.h"
#include "sim/emit/grid/grid_walk.h"
#include "sim/emit/sun/solar_rotation.h"

namespace vegard::sim {
namespace {

/// A direction or a place of the volume's frame in voxels, without the place of their origin.
void in_voxels(const GridBricks& grid, const double frame[3], double voxels[3]) {
  for (int a = 0; a < 3; ++a) {
    voxels[a] = 0.0;
    for (int c = 0; c < 3; ++c) voxels[a] += grid.place().turn[a][c] * frame[c];
  }
}

/// Turns a vector from east, north, up of the volume's home to those of the observer.
void from_home(const GridBricks& grid, const double home[3], double here[3]) {
  for (int c = 0; c < 3; ++c) {
    here[c] = 0.0;
    for (int k = 0; k < 3; ++k) here[c] += grid.place().from_home[c][k] * home[k];
  }
}

/// Aims a ray from a voxel at the lamp; its unit is a voxel's edge. Returns false if no light comes from
/// there.
bool aim_at_lamp(const LampPlace& lamp, const double voxel[3], GridRay& ray, double& end) {
  double length = 1.0;
  end = std::numeric_limits<double>::infinity();
  if (lamp.is_far) {
    for (int a = 0; a < 3; ++a) ray.along[a] = lamp.at[a];
  } else {
    length = 0.0;
    for (int a = 0; a < 3; ++a) {
      ray.along[a] = lamp.at[a] - voxel[a];
      length += ray.along[a] * ray.along[a];
    }
    length = std::sqrt(length);
    end = length - lamp.stop;
    if (!(end > 0.0)) return false;
  }
  for (int a = 0; a < 3; ++a) {
    ray.from[a] = voxel[a];
    ray.along[a] /= length;
  }
  ray.aim();
  return true;
}

/// The integral of the density along the ray. Within a cell that is a polynomial of third degree, for which
/// two Gauss-Legendre nodes are exact.
double column(const GridBricks& grid, const GridRay& ray, double end) {
  static const GaussLegendre<2> nodes;
  double sum = 0.0;
  walk_bricks(grid, ray, end, [&](std::int32_t brick, const int at[3], double enter, double leave) {
    int low[3], high[3];
    for (int a = 0; a < 3; ++a) {
      low[a] = at[a] * GridBricks::kEdge;
      high[a] = low[a] + GridBricks::kEdge;
    }
    walk_cells(ray, 1.0, low, high, enter, leave, [&](const int[3], double in, double out) {
      for (int n = 0; n < 2; ++n) {
        const double t = in + (out - in) * nodes.place[n];
        double local[3];
        for (int a = 0; a < 3; ++a) local[a] = ray.from[a] + t * ray.along[a] - low[a];
        sum += GridCell(local).value(grid.density(brick), 1) * nodes.weight[n] * (out - in);
      }
    });
  });
  return sum;
}

}  // namespace

LampPlace lamp_place(const GridBricks& grid, const Volume& volume, const Sun* sun, double turned_rad) {
  LampPlace lamp;
  const bool on_sun = volume.frame == VolumeFrame::sun && sun != nullptr;
  const double unit_km = on_sun ? sun->unit_km : 1.0;
  lamp.is_far = volume.lamp == VolumeLamp::direction || (volume.lamp == VolumeLamp::sun && !on_sun);
  if (lamp.is_far) {
    const bool is_sun = volume.lamp == VolumeLamp::sun;
    const double azimuth = (is_sun ? sun->azimuth_deg : volume.lamp_azimuth_deg) * kRadiansPerDegree,
                 elevation = (is_sun ? sun->elevation_deg : volume.lamp_elevation_deg) * kRadiansPerDegree;
    const double high = std::sin(elevation), level = std::cos(elevation);
    const double east_north_up[3] = {level * std::sin(azimuth), level * std::cos(azimuth), high};
    const Vec3<double> heliographic =
        turned_west(Vec3<double>{level * std::cos(azimuth), level * std::sin(azimuth), high}, -turned_rad);
    double here[3];
    if (on_sun)
      std::copy(heliographic.begin(), heliographic.end(), here);
    else if (is_sun)
      std::copy(east_north_up, east_north_up + 3, here);  // the scene's Sun stands in the observer's sky
    else
      from_home(grid, east_north_up, here);
    in_voxels(grid, here, lamp.at);
    const double length =
        std::sqrt(lamp.at[0] * lamp.at[0] + lamp.at[1] * lamp.at[1] + lamp.at[2] * lamp.at[2]);
    for (double& one : lamp.at) one /= length;
    return lamp;
  }
  // The shift moves the grid; in its voxels the lamp goes the other way.
  Vec3<double> place = {0.0, 0.0, 0.0};
  double shift[3], off[3];
  if (volume.lamp == VolumeLamp::point && on_sun) place = turned_west(volume.lamp_km, -turned_rad);
  if (volume.lamp == VolumeLamp::point && !on_sun) from_home(grid, volume.lamp_km.data(), place.data());
  shift_of_volume(grid, volume, unit_km, plain_number, shift);
  for (int c = 0; c < 3; ++c) place[c] -= shift[c];
  in_voxels(grid, place.data(), off);
  for (int a = 0; a < 3; ++a) lamp.at[a] = off[a] + grid.place().shift[a];
  if (volume.lamp == VolumeLamp::sun) lamp.stop = sun->radius / grid.voxel_km();
  return lamp;
}

std::vector<double> lamp_flux(const GridBricks& grid, const Volume& volume, const Sun* sun) {
  const bool is_point = volume.lamp == VolumeLamp::point;
  const bool on_sun = volume.frame == VolumeFrame::sun && sun != nullptr;
  std::vector<double> flux = volume.lamp_flux;
  double share = is_point ? 1.0 / (grid.voxel_km() * grid.voxel_km()) : 1.0;  // at 1 unit, and at a voxel
  if (volume.lamp == VolumeLamp::sun) {
    flux = sun->photosphere_rayleigh;
    const double ratio =
        on_sun ? sun->radius / grid.voxel_km() : sun->radius * sun->unit_km / sun->distance_km;
    share = 0.25 * ratio * ratio * (1.0 - sun->limb_darkening / 3.0 - sun->limb_darkening_square / 6.0);
  }
  for (double& one : flux) one *= share;
  flux.resize(static_cast<std::size_t>(grid.lines()), 0.0);
  return flux;
}

LampColumns::LampColumns(const GridBricks& grid, const LampPlace& lamp, double voxel_km, int threads) {
  columns_.assign(grid.bricks() * GridBricks::kVoxels, 0.0f);
  struct Place {
    std::int32_t brick;
    int at[3];
  };
  std::vector<Place> places;
  constexpr int kCoarse = GridBricks::kCoarse;
  for (int x = grid.low(0) * kCoarse; x < grid.high(0) * kCoarse; ++x)
    for (int y = grid.low(1) * kCoarse; y < grid.high(1) * kCoarse; ++y)
      for (int z = grid.low(2) * kCoarse; z < grid.high(2) * kCoarse; ++z)
        if (const std::int32_t brick = grid.brick(x, y, z); brick >= 0) places.push_back({brick, {x, y, z}});
  parallel_for(places.size(), threads, [&](std::size_t p, int) {
    float* to = columns_.data() + static_cast<std::size_t>(places[p].brick) * GridBricks::kVoxels;
    for (int i = 0; i < GridBricks::kSide; ++i)
      for (int j = 0; j < GridBricks::kSide; ++j)
        for (int k = 0; k < GridBricks::kSide; ++k, ++to) {
          const double voxel[3] = {static_cast<double>(places[p].at[0] * GridBricks::kEdge + i),
                                   static_cast<double>(places[p].at[1] * GridBricks::kEdge + j),
                                   static_cast<double>(places[p].at[2] * GridBricks::kEdge + k)};
          GridRay ray;
          double end;
          if (aim_at_lamp(lamp, voxel, ray, end)) *to = static_cast<float>(column(grid, ray, end) * voxel_km);
        }
  });
}

}  // namespace vegard::sim
