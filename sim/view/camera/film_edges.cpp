#include "sim/view/camera/film_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace vegard::sim {
namespace {

using Vector = std::array<double, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector unit(Vector a) {
  const double length = std::sqrt(dot(a, a));
  for (double& x : a) x /= length;
  return a;
}

void put(FilmEdges& edges, const Vector& outward) {
  std::copy(outward.begin(), outward.end(), edges.outward[edges.count++]);
}

/// Directions along the rectangle's border; empty if some of it is outside of the lens's picture.
std::vector<Vector> border(const Lens<double>& lens, double left, double top, double right, double bottom) {
  constexpr int kPieces = 48;
  std::vector<Vector> all;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < kPieces; ++i) {
      const double share = static_cast<double>(i) / kPieces;
      const double along = side < 2 ? share : 1.0 - share;
      const double x = side % 2 == 0 ? left + along * (right - left) : (side == 1 ? right : left);
      const double y = side % 2 == 1 ? top + along * (bottom - top) : (side == 0 ? top : bottom);
      Vector direction;
      if (!unproject(lens, x, y, direction.data())) return {};
      all.push_back(direction);
    }
  return all;
}

}  // namespace

FilmEdges film_edges(const Lens<double>& lens, const FilmGeometry& film) {
  FilmEdges edges;
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
  const std::vector<Vector> seen = border(lens, left, top, right, bottom);
  if (seen.empty()) return edges;
  // About the middle of the border, the smallest box of tangents that holds all of it.
  Vector middle{};
  for (const Vector& direction : seen)
    for (int i = 0; i < 3; ++i) middle[i] += direction[i];
  if (!(dot(middle, middle) > 1e-6)) return edges;
  middle = unit(middle);
  const Vector first =
      unit(cross(middle, std::abs(middle[0]) < 0.7 ? Vector{1.0, 0.0, 0.0} : Vector{0.0, 1.0, 0.0}));
  const Vector second = cross(middle, first);
  constexpr double kNarrowest = 0.17;  // cosine of 80 degrees
  double low[2] = {1e30, 1e30}, high[2] = {-1e30, -1e30};
  for (const Vector& direction : seen) {
    const double forward = dot(direction, middle);
    if (forward < kNarrowest) return edges;
    const double tangent[2] = {dot(direction, first) / forward, dot(direction, second) / forward};
    for (int i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], tangent[i]);
      high[i] = std::max(high[i], tangent[i]);
    }
  }
  // A border that runs around the back of the camera has its middle there, and all that the film sees is
  // beyond it.
  double inside[3];
  if (!unproject(lens, 0.5 * (left + right), 0.5 * (top + bottom), inside)) return edges;
  const Vector centre = {inside[0], inside[1], inside[2]};
  const double forward = dot(centre, middle);
  if (forward < kNarrowest) return edges;
  const double at[2] = {dot(centre, first) / forward, dot(centre, second) / forward};
  for (int i = 0; i < 2; ++i)
    if (at[i] < low[i] || at[i] > high[i]) return edges;
  // The border bulges between the points that were looked at.
  constexpr double kBulge = 0.02;
  for (int i = 0; i < 2; ++i) {
    const Vector& axis = i == 0 ? first : second;
    const double room = kBulge * (high[i] - low[i]);
    Vector lower, upper;
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
