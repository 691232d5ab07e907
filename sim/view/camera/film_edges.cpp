#include "sim/view/camera/film_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/base/number/vec3.h"

namespace vegard::sim {
namespace {

Vec3<double> unit(Vec3<double> a) {
  const double length = std::sqrt(dot3(a, a));
  for (double& x : a) x /= length;
  return a;
}

void put(FilmEdges& edges, const Vec3<double>& outward) {
  std::copy(outward.begin(), outward.end(), edges.outward[edges.count++]);
}

/// Directions along the rectangle's border; empty if some of it is outside of the lens's picture.
std::vector<Vec3<double>> border(const Lens<double>& lens, double left, double top, double right,
                                 double bottom) {
  constexpr int kPieces = 48;
  std::vector<Vec3<double>> all;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < kPieces; ++i) {
      const double share = static_cast<double>(i) / kPieces;
      const double along = side < 2 ? share : 1.0 - share;
      const double x = side % 2 == 0 ? left + along * (right - left) : (side == 1 ? right : left);
      const double y = side % 2 == 1 ? top + along * (bottom - top) : (side == 0 ? top : bottom);
      Vec3<double> direction;
      if (!unproject(lens, x, y, direction.data())) return {};
      all.push_back(direction);
    }
  return all;
}

}  // namespace

FilmEdges film_edges(const Lens<double>& lens, const FilmGeometry& film) {
  FilmEdges edges;
  if (is_panorama(lens.model)) return edges;
  const double left = film.x0_px - film.cell_width_px, top = film.y0_px - film.cell_height_px;
  const double right = film.x0_px + (film.columns + 1) * film.cell_width_px;
  const double bottom = film.y0_px + (film.rows + 1) * film.cell_height_px;
  if (is_plain_pinhole(lens)) {
    const double fx = lens.focal_px * lens.side, fy = lens.focal_px * lens.aspect;
    const double a = (left - lens.principal_x_px) / fx, b = (right - lens.principal_x_px) / fx;
    put(edges, {-1.0, 0.0, std::min(a, b)});
    put(edges, {1.0, 0.0, -std::max(a, b)});
    put(edges, {0.0, -1.0, (top - lens.principal_y_px) / fy});
    put(edges, {0.0, 1.0, -(bottom - lens.principal_y_px) / fy});
    return edges;
  }
  const std::vector<Vec3<double>> seen = border(lens, left, top, right, bottom);
  if (seen.empty()) return edges;
  // About the middle of the border, the smallest box of tangents that holds all of it.
  Vec3<double> middle{};
  for (const Vec3<double>& direction : seen)
    for (int i = 0; i < 3; ++i) middle[i] += direction[i];
  if (!(dot3(middle, middle) > 1e-6)) return edges;
  middle = unit(middle);
  const Vec3<double> first = unit(
      cross3(middle, std::abs(middle[0]) < 0.7 ? Vec3<double>{1.0, 0.0, 0.0} : Vec3<double>{0.0, 1.0, 0.0}));
  const Vec3<double> second = cross3(middle, first);
  constexpr double kNarrowest = 0.17;  // cosine of 80 degrees
  double low[2] = {1e30, 1e30}, high[2] = {-1e30, -1e30};
  for (const Vec3<double>& direction : seen) {
    const double forward = dot3(direction, middle);
    if (forward < kNarrowest) return edges;
    const double tangent[2] = {dot3(direction, first) / forward, dot3(direction, second) / forward};
    for (int i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], tangent[i]);
      high[i] = std::max(high[i], tangent[i]);
    }
  }
  // A border that runs around the back of the camera has its middle there, and all that the film sees is
  // beyond it.
  double inside[3];
  if (!unproject(lens, 0.5 * (left + right), 0.5 * (top + bottom), inside)) return edges;
  const Vec3<double> centre = {inside[0], inside[1], inside[2]};
  const double forward = dot3(centre, middle);
  if (forward < kNarrowest) return edges;
  const double at[2] = {dot3(centre, first) / forward, dot3(centre, second) / forward};
  for (int i = 0; i < 2; ++i)
    if (at[i] < low[i] || at[i] > high[i]) return edges;
  // The border bulges between the points that were looked at.
  constexpr double kBulge = 0.02;
  for (int i = 0; i < 2; ++i) {
    const Vec3<double>& axis = i == 0 ? first : second;
    const double room = kBulge * (high[i] - low[i]);
    Vec3<double> lower, upper;
    for (int k = 0; k < 3; ++k) {
      lower[k] = (low[i] - room) * middle[k] - axis[k];
      upper[k] = axis[k] - (high[i] + room) * middle[k];
    }
    put(edges, lower);
    put(edges, upper);
  }
  return edges;
}

}  // namespace vegard::sim
