// Footprints, profiles and rays for the tests of the march.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "sim/base/number/random.h"
#include "sim/emit/footprint/footprint_emitter.h"
#include "tests/support/glow.h"
#include "tests/support/kind_named.h"

namespace vegard::sim::march_case {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline double uniform(std::uint32_t seed, std::uint32_t i, std::uint32_t j = 0) {
  return philox4x32({i, j, 0, 0}, {seed, 0})[0] / 4294967296.0;
}

/// A profile of two lines by the altitude.
inline ProfileTable drawn(const std::function<double(double)>& rate) {
  ProfileTable table;
  table.of_energy.push_back(dark_profile(2));
  HeightProfile& profile = table.of_energy[0];
  for (int row = 0; row < HeightProfile::kAltitudes; ++row) {
    const double here = rate(HeightProfile::altitude_km(row));
    profile.rate[static_cast<std::size_t>(row) * profile.stride] = static_cast<float>(here);
    profile.rate[static_cast<std::size_t>(row) * profile.stride + 1] = static_cast<float>(0.25 * here);
  }
  return table;
}

/// Of 3 keV, three lines.
inline ProfileTable maxwellian(double energy_kev = 3.0) {
  ProfileTable table;
  table.of_energy.push_back(maxwellian_profile(tests::glow(), {630.0, 557.7, 427.8}, energy_kev));
  return table;
}

inline CubeFootprint<double> cube(int cells, const std::function<double(const double d[3])>& flux) {
  CubeFootprint<double> map;
  map.face_cells = cells;
  for (int face = 0; face < 6; ++face) {
    FootprintGrid<double>& grid = map.face[face];
    grid.columns = grid.rows = cells + 2;
    grid.flux_mw_m2.resize(grid.cells());
    for (int row = 0; row < grid.rows; ++row)
      for (int column = 0; column < grid.columns; ++column) {
        const int a = face / 2;
        double d[3];
        d[a] = face % 2 == 0 ? 1.0 : -1.0;
        d[(a + 1) % 3] = (column - 0.5) * 2.0 / cells - 1.0;
        d[(a + 2) % 3] = (row - 0.5) * 2.0 / cells - 1.0;
        const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        for (double& x : d) x /= length;
        grid.flux_mw_m2[static_cast<std::size_t>(row) * grid.columns + column] = flux(d);
      }
  }
  return map;
}

inline PlaneFootprint<double> plane(double west_km, double south_km, double cell_km, int columns, int rows,
                                    const std::function<double(double east, double north)>& flux) {
  PlaneFootprint<double> map;
  map.west_km = west_km;
  map.south_km = south_km;
  map.cell_km = cell_km;
  map.grid.columns = columns;
  map.grid.rows = rows;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      map.grid.flux_mw_m2.push_back(
          flux(west_km + (column + 0.5) * cell_km, south_km + (row + 0.5) * cell_km));
  return map;
}

inline Scene scene_at(double altitude_km, const char* shape, const char* fall = "field") {
  Scene scene;
  scene.site.altitude_m = altitude_km * 1000.0;
  Footprint footprint;
  footprint.shape = tests::kind_named<FootprintShape>(shape);
  footprint.fall = tests::kind_named<FootprintFall>(fall);
  scene.footprints.push_back(footprint);
  return scene;
}

inline std::unique_ptr<Emitter<double>> emitter(const Scene& scene, const PlaneFootprint<double>& map,
                                                const ProfileTable& profiles, MarchBy by = MarchBy::lanes) {
  return plane_footprint_emitter<double>(
      scene, scene.footprints[0], map, profiles, {}, [](const double& x) { return x; }, 1, by);
}
inline std::unique_ptr<Emitter<double>> emitter(const Scene& scene, const CubeFootprint<double>& map,
                                                const ProfileTable& profiles, MarchBy by = MarchBy::lanes) {
  return cube_footprint_emitter<double>(
      scene, scene.footprints[0], map, profiles, {}, [](const double& x) { return x; }, 1, by);
}

struct Light {
  std::vector<double> rayleigh, kept, entry_km, depth_km;  ///< rayleigh: [line][ray]
};

struct Rays {
  std::vector<double> direction[3], end_km;

  void add(double elevation_deg, double azimuth_deg, double end = kInfinity) {
    constexpr double kDegree = 0.017453292519943295;
    const double e = elevation_deg * kDegree, a = azimuth_deg * kDegree;
    const double d[3] = {std::cos(e) * std::sin(a), std::cos(e) * std::cos(a), std::sin(e)};
    for (int i = 0; i < 3; ++i) direction[i].push_back(d[i]);
    end_km.push_back(end);
  }
  std::size_t count() const { return end_km.size(); }

  Light through(const Emitter<double>& emitter, int lines) const {
    Light light;
    light.rayleigh.assign(lines * count(), 0.0);
    light.kept.assign(lines * count(), 1.0);
    light.entry_km.assign(count(), kInfinity);
    light.depth_km.assign(count(), kInfinity);
    emitter.march(
        {count(), {direction[0].data(), direction[1].data(), direction[2].data()}, end_km.data()},
        {lines, light.rayleigh.data(), light.kept.data(), light.entry_km.data(), light.depth_km.data()});
    return light;
  }
};

}  // namespace vegard::sim::march_case
