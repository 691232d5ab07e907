#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"
#include "sim/emit/footprint/map/make_footprint.h"
#include "sim/emit/footprint/map/plane_flow.h"

namespace vegard::sim {
namespace shell_flow {

constexpr int kParts = 2;            // of a cell, along either edge
constexpr double kWidestSine = 0.9;  // of half the angle from the pole up to which the plane reaches

/// Lambert's azimuthal equal-area plane about a pole, seen from above: x to longitude 0, and y to 90° east
/// about the north pole, to 90° west about the south pole.
struct PolarPlane {
  double pole = 1.0;  ///< 1: north, -1: south
  double radius_km = 1.0;

  bool has(const double direction[3]) const {
    return 1.0 - pole * direction[2] < 2.0 * kWidestSine * kWidestSine;
  }
  void place(const double direction[3], double& east, double& north) const {
    const double scale = radius_km * std::sqrt(2.0 / std::max(1.0 + pole * direction[2], 1e-12));
    east = scale * direction[0];
    north = pole * scale * direction[1];
  }
  /// False beyond the other pole.
  bool direction(double east, double north, double out[3]) const {
    const double square = (east * east + north * north) / (radius_km * radius_km);
    if (!(square < 4.0)) return false;
    const double scale = std::sqrt(1.0 - 0.25 * square) / radius_km;
    out[0] = scale * east;
    out[1] = pole * scale * north;
    out[2] = pole * (1.0 - 0.5 * square);
    return true;
  }
};

/// Flux, and flux times ln E, at a direction, linear between the cells.
std::array<double, 2> sampled(const CubeFootprint<double>& cube, const double d[3]) {
  int axis = 0;
  for (int a = 1; a < 3; ++a)
    if (std::abs(d[a]) > std::abs(d[axis])) axis = a;
  const FootprintGrid<double>& grid = cube.face[2 * axis + (d[axis] < 0.0 ? 1 : 0)];
  const double size = std::abs(d[axis]);
  // The border's middle is at -1 - 1/n.
  const auto cell = [&](double coordinate) { return 0.5 * cube.face_cells * (coordinate + 1.0) + 0.5; };
  const double x = cell(d[(axis + 1) % 3] / size), y = cell(d[(axis + 2) % 3] / size);
  const int column = std::clamp(static_cast<int>(x), 0, grid.columns - 2),
            row = std::clamp(static_cast<int>(y), 0, grid.rows - 2);
  std::array<double, 2> sum{0.0, 0.0};
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const std::size_t at = static_cast<std::size_t>(row + j) * grid.columns + column + i;
      const double weight = (i == 0 ? 1.0 - (x - column) : x - column) * (j == 0 ? 1.0 - (y - row) : y - row);
      const double flux = weight * grid.flux_mw_m2[at];
      sum[0] += flux;
      if (!grid.ln_energy.empty()) sum[1] += flux * grid.ln_energy[at];
    }
  return sum;
}

template <class See>
void each_inner_cell(const CubeFootprint<double>& cube, int face, int row, const See& see) {
  const int n = cube.face_cells;
  for (int column = 0; column < n; ++column)
    see(static_cast<std::size_t>(row + 1) * (n + 2) + column + 1, face, column, row);
}

/// The hemisphere with more of the flux, and the largest distance of light from its pole in the plane.
PolarPlane plane_of(const CubeFootprint<double>& cube, double radius_km, double& reach_km) {
  const int n = cube.face_cells;
  double sum = 0.0, farthest[2] = {0.0, 0.0};
  for (int face = 0; face < 6; ++face)
    for (int row = 0; row < n; ++row)
      each_inner_cell(cube, face, row, [&](std::size_t at, int f, int column, int r) {
        const double flux = cube.face[f].flux_mw_m2[at];
        if (flux == 0.0) return;
        double d[3];
        direction_on_face(f, face_coordinate(column, n), face_coordinate(r, n), d);
        sum += flux * d[2];
        for (const int side : {0, 1}) {
          const double square = 1.0 - (side == 0 ? d[2] : -d[2]);
          if (square < 2.0 * kWidestSine * kWidestSine) farthest[side] = std::max(farthest[side], square);
        }
      });
  const PolarPlane plane{sum < 0.0 ? -1.0 : 1.0, radius_km};
  reach_km = radius_km * std::sqrt(2.0 * farthest[sum < 0.0 ? 1 : 0]);
  return plane;
}

}  // namespace shell_flow

void wind_up_shell(const Footprint& f, double sphere_km, double turns, std::uint64_t seed, int index,
                   int threads, CubeFootprint<double>& cube) {
  using namespace shell_flow;
  const int n = cube.face_cells;
  const double radius_km = sphere_km + kFootAltitudeKm, cell_km = 0.5 * kPi * radius_km / n;
  if (turns <= 0.0 || cube.face[0].flux_mw_m2.empty()) return;
  double reach_km = 0.0;
  const PolarPlane polar = plane_of(cube, radius_km, reach_km);
  PlaneFootprint<double> plane;
  const int half = static_cast<int>(std::ceil(reach_km / cell_km)) + 2;
  plane.cell_km = cell_km;
  plane.west_km = plane.south_km = -half * cell_km;
  plane.grid.columns = plane.grid.rows = 2 * half;
  plane.grid.flux_mw_m2.assign(plane.grid.cells(), 0.0);
  parallel_for(plane.grid.rows, threads, [&](std::size_t row, int) {
    for (int column = 0; column < plane.grid.columns; ++column) {
      double d[3];
      if (polar.direction(plane.west_km + (column + 0.5) * cell_km,
                          plane.south_km + (static_cast<double>(row) + 0.5) * cell_km, d) &&
          polar.has(d))
        plane.grid.flux_mw_m2[row * plane.grid.columns + column] = sampled(cube, d)[0];
    }
  });
  const PlaneFlow flow = wind_up(plane, f, turns, seed, index, polar.pole > 0.0, threads);
  if (flow.columns == 0) return;
  const CubeFootprint<double> before = cube;
  const bool has_energy = !cube.face[0].ln_energy.empty();
  for (int face = 0; face < 6; ++face)
    parallel_for(n, threads, [&](std::size_t row, int) {
      FlowCubic cubic(flow.columns, flow.rows);
      each_inner_cell(before, face, static_cast<int>(row), [&](std::size_t at, int, int column, int r) {
        double d[3];
        direction_on_face(face, face_coordinate(column, n), face_coordinate(r, n), d);
        if (!polar.has(d)) return;
        std::array<double, 2> sum{0.0, 0.0};
        for (int part = 0; part < kParts * kParts; ++part) {
          const auto offset = [](int i) { return (i + 0.5) / kParts - 0.5; };
          double from[3], east = 0.0, north = 0.0;
          direction_on_face(face, face_coordinate(column + offset(part % kParts), n),
                            face_coordinate(r + offset(part / kParts), n), from);
          polar.place(from, east, north);
          double flow_column = (east - flow.west_km) / flow.cell_km - 0.5,
                 flow_row = (north - flow.south_km) / flow.cell_km - 0.5;
          cubic.follow(flow.stretches, flow_column, flow_row);
          if (!polar.direction(flow.west_km + (flow_column + 0.5) * flow.cell_km,
                               flow.south_km + (flow_row + 0.5) * flow.cell_km, from))
            continue;
          const std::array<double, 2> here = sampled(before, from);
          for (int k = 0; k < 2; ++k) sum[k] += here[k] / (kParts * kParts);
        }
        cube.face[face].flux_mw_m2[at] = sum[0];
        if (has_energy) cube.face[face].ln_energy[at] = sum[0] > 0.0 ? sum[1] / sum[0] : 0.0;
      });
    });
  fill_borders(cube);
}

}  // namespace vegard::sim
