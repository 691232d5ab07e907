#include "sim/emit/footprint/map/make_footprint.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/number/dual.h"
#include "sim/base/parallel.h"
#include "sim/emit/footprint/map/bulge.h"
#include "sim/emit/footprint/map/curve.h"
#include "sim/emit/footprint/map/footprint_map.h"
#include "sim/scene/structs/footprint.h"

namespace vegard::sim {
namespace {

constexpr int kBandRows = 64;

template <class T, int axes>
void set_cargo(const Footprint& f, std::size_t i, const NumberAs<T>& number, CurveNode<T, axes>& point) {
  point.flux = number(f.energy_flux_mw_m2);
  if (!f.point_flux.empty()) point.flux = point.flux * number(f.point_flux[i]);
  point.ln_energy = f.point_energy.empty() ? T(0.0) : logarithm(number(f.point_energy[i]));
}

/// Sums of ln E times flux become means.
template <class T>
void divide(const std::vector<T>& flux, std::vector<T>& energy) {
  for (std::size_t i = 0; i < energy.size(); ++i)
    energy[i] = value_of(flux[i]) > 0.0 ? energy[i] / flux[i] : T(0.0);
}

/// The Gaussian of a piece along an axis, over the cells that it reaches.
template <class T>
struct Reach {
  int first = 0;
  std::vector<T> weight;

  void set(const T& centre_cells, const T& width_cells, int from, int to) {
    const double reach = kGaussianReach * value_of(width_cells);
    first = std::max(from, static_cast<int>(std::ceil(value_of(centre_cells) - reach)));
    const int last = std::min(to - 1, static_cast<int>(std::floor(value_of(centre_cells) + reach)));
    weight.clear();
    const T inverse = 1.0 / width_cells;
    for (int i = first; i <= last; ++i) {
      const T x = (centre_cells - static_cast<double>(i)) * inverse;
      weight.push_back(exponential(x * x * -0.5));
    }
  }
};

}  // namespace

template <class T>
PlaneFootprint<T> spline_plane(const Footprint& f, const NumberAs<T>& number, int threads,
                               bool centre_moves) {
  PlaneFootprint<T> plane = plane_grid<T>(f);
  FootprintGrid<T>& grid = plane.grid;
  const T east = centre_moves ? number(f.center_km.east) : T(f.center_km.east),
          north = centre_moves ? number(f.center_km.north) : T(f.center_km.north);
  std::vector<CurveNode<T, 2>> points(f.east_km.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].at = {east + number(f.east_km[i]), north + number(f.north_km[i])};
    set_cargo(f, i, number, points[i]);
  }
  const T width = number(f.width_km);
  const T drawn = value_of(width) < kNarrowestCells * f.cell_km ? T(kNarrowestCells * f.cell_km) : width;
  const std::vector<CurvePiece<T, 2>> pieces =
      curve_pieces<T, 2>(points, f.closed, longest_piece_km(f, kEarthRadiusKm), false).pieces;
  grid.flux_mw_m2.assign(grid.cells(), T(0.0));
  const bool has_energy = !f.point_energy.empty();
  if (has_energy) grid.ln_energy.assign(grid.cells(), T(0.0));
  const T peak_per_km = width / (drawn * drawn * kSqrtTwoPi), width_cells = drawn / f.cell_km;
  // A band of rows takes the pieces in their order: sums do not depend on the threads.
  const std::size_t bands = (grid.rows + kBandRows - 1) / kBandRows;
  parallel_for(bands, threads, [&](std::size_t band, int) {
    const int first_row = static_cast<int>(band) * kBandRows;
    const int end_row = std::min(grid.rows, first_row + kBandRows);
    Reach<T> across, up;
    for (const CurvePiece<T, 2>& piece : pieces) {
      up.set((piece.middle.at[1] - plane.south_km) / f.cell_km - 0.5, width_cells, first_row, end_row);
      if (up.weight.empty()) continue;
      across.set((piece.middle.at[0] - plane.west_km) / f.cell_km - 0.5, width_cells, 0, grid.columns);
      const T light = piece.middle.flux * piece.length * peak_per_km;
      for (std::size_t r = 0; r < up.weight.size(); ++r) {
        const T of_row = light * up.weight[r];
        const std::size_t at = static_cast<std::size_t>(up.first + r) * grid.columns + across.first;
        for (std::size_t c = 0; c < across.weight.size(); ++c) {
          const T here = of_row * across.weight[c];
          grid.flux_mw_m2[at + c] = grid.flux_mw_m2[at + c] + here;
          if (has_energy) grid.ln_energy[at + c] = grid.ln_energy[at + c] + here * piece.middle.ln_energy;
        }
      }
    }
  });
  divide(grid.flux_mw_m2, grid.ln_energy);
  return plane;
}

CubeFootprint<double> spline_cube(const Footprint& f, double sphere_km, int threads, const Substorm& substorm,
                                  double instant_s) {
  const double radius = sphere_km + kFootAltitudeKm;
  const NumberAs<double>& number = plain_number;
  std::vector<CurveNode<double, 3>> points(f.latitude_deg.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double latitude = f.latitude_deg[i] * kRadiansPerDegree,
                 longitude = f.longitude_deg[i] * kRadiansPerDegree;
    points[i].at = {radius * std::cos(latitude) * std::cos(longitude),
                    radius * std::cos(latitude) * std::sin(longitude), radius * std::sin(latitude)};
    set_cargo(f, i, number, points[i]);
  }
  const double drawn = drawn_width_km(f, sphere_km), longest_km = longest_piece_km(f, sphere_km);
  const std::vector<CurvePiece<double, 3>> pieces =
      curve_pieces<double, 3>(with_bulge(f, substorm, instant_s, points, longest_km), f.closed, longest_km,
                              true)
          .pieces;
  const bool has_energy = !f.point_energy.empty();
  CubeFootprint<double> cube = cube_grid<double>(f.face_cells, has_energy);
  const double reach = kGaussianReach * drawn / radius;  // a chord of the unit sphere
  const double farthest = std::min(std::max(1.0 - 0.5 * reach * reach, -1.0), 1.0);  // its cosine
  const double sharpness = radius * radius / (drawn * drawn);
  std::vector<CapOnFace> caps(pieces.size());
  const int n = f.face_cells;
  const std::size_t bands = (n + kBandRows - 1) / kBandRows;
  for (int face = 0; face < 6; ++face) {
    FootprintGrid<double>& grid = cube.face[face];
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      double unit[3];
      for (int a = 0; a < 3; ++a) unit[a] = pieces[p].middle.at[a] / radius;
      caps[p] = cap_on_face(face, n, unit, farthest);
    }
    parallel_for(bands, threads, [&](std::size_t band, int) {
      const int first_row = static_cast<int>(band) * kBandRows, end_row = std::min(n, first_row + kBandRows);
      for (std::size_t p = 0; p < pieces.size(); ++p) {
        const CapOnFace& cap = caps[p];
        const CurvePiece<double, 3>& piece = pieces[p];
        const double light = piece.middle.flux * piece.length * f.width_km / (drawn * drawn * kSqrtTwoPi);
        for (int r = std::max(cap.first_row, first_row); r < std::min(cap.end_row, end_row); ++r) {
          const double v = face_coordinate(r, n);
          const double on_row = cap.on_axis + cap.on_v * v, row_square = 1.0 + v * v;
          const std::size_t row_at = static_cast<std::size_t>(r + 1) * grid.columns + 1;
          for (int c = cap.first_column; c < cap.end_column; ++c) {
            const double u = face_coordinate(c, n);
            const double cosine_here = (on_row + cap.on_u * u) / std::sqrt(row_square + u * u);
            if (cosine_here < farthest) continue;
            const double here = light * std::exp((cosine_here - 1.0) * sharpness);
            grid.flux_mw_m2[row_at + c] += here;
            if (has_energy) grid.ln_energy[row_at + c] += here * piece.middle.ln_energy;
          }
        }
      }
    });
    divide(grid.flux_mw_m2, grid.ln_energy);
  }
  fill_borders(cube);
  return cube;
}

template PlaneFootprint<double> spline_plane(const Footprint&, const NumberAs<double>&, int, bool);
template PlaneFootprint<FreeDual> spline_plane(const Footprint&, const NumberAs<FreeDual>&, int, bool);

}  // namespace vegard::sim
