#include "fit/map/curtains/ridge_trace.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vegard::fit {
namespace ridge_trace {
namespace {

constexpr int kReach_px = 4;  // to the next point of a ridge, over a gap

/// A ridge point and the direction in which the ridge is followed from it.
struct RidgeStep {
  int x = -1, y = -1;
  double dx = 0.0, dy = 0.0;
};

/// The ridge point within reach that goes on from `from` most nearly straight; none: x is -1.
RidgeStep next_on_ridge(const RidgeField& field, const std::vector<std::uint8_t>& used, const RidgeStep& from,
                        double low) {
  const auto [x, y, dx, dy] = from;
  RidgeStep best;
  double least = 1e9;
  for (int j = -kReach_px; j <= kReach_px; ++j)
    for (int i = -kReach_px; i <= kReach_px; ++i) {
      const int nx = x + i, ny = y + j;
      if ((i == 0 && j == 0) || nx < 1 || ny < 1 || nx + 1 >= field.raster.columns ||
          ny + 1 >= field.raster.rows)
        continue;
      const std::size_t n = field.index(nx, ny);
      if (!field.is_ridge[n] || used[n] || field.smooth[n] < low) continue;
      const double mx = field.at_x[n] - field.at_x[field.index(x, y)];
      const double my = field.at_y[n] - field.at_y[field.index(x, y)];
      const double step = std::hypot(mx, my);
      if (!(step > 0.0) || mx * dx + my * dy < 0.3 * step) continue;
      double ax = field.along_x[n], ay = field.along_y[n];
      if (ax * dx + ay * dy < 0.0) {
        ax = -ax;
        ay = -ay;
      }
      const double cost = step + 2.0 * std::acos(std::clamp(ax * dx + ay * dy, -1.0, 1.0)) +
                          1.0 * std::acos(std::clamp((mx * dx + my * dy) / step, -1.0, 1.0));
      if (cost < least) {
        least = cost;
        best = {nx, ny, ax, ay};
      }
    }
  return best;
}

}  // namespace
}  // namespace ridge_trace

RidgeField::RidgeField(const RasterGrid& r, std::vector<double> s)
    : raster(r),
      smooth(std::move(s)),
      is_ridge(r.size(), 0),
      along_x(r.size(), 0.0),
      along_y(r.size(), 0.0),
      at_x(r.size(), 0.0),
      at_y(r.size(), 0.0) {
  for (int y = 1; y + 1 < raster.rows; ++y)
    for (int x = 1; x + 1 < raster.columns; ++x) test(x, y);
}

void RidgeField::test(int x, int y) {
  const auto v = [&](int dx, int dy) { return smooth[index(x + dx, y + dy)]; };
  if (!(v(0, 0) > 0.0)) return;
  const double gx = 0.5 * (v(1, 0) - v(-1, 0)), gy = 0.5 * (v(0, 1) - v(0, -1));
  const double xx = v(1, 0) - 2.0 * v(0, 0) + v(-1, 0), yy = v(0, 1) - 2.0 * v(0, 0) + v(0, -1);
  const double xy = 0.25 * (v(1, 1) - v(1, -1) - v(-1, 1) + v(-1, -1));
  // The eigenvector of the most negative second derivative.
  const double half = 0.5 * (xx - yy), root = std::hypot(half, xy), least = 0.5 * (xx + yy) - root;
  if (!(least < 0.0)) return;
  double nx = xy, ny = least - xx;
  if (std::hypot(nx, ny) < 1e-12 * std::abs(least)) {
    nx = least - yy;
    ny = xy;
  }
  const double length = std::hypot(nx, ny);
  if (!(length > 0.0)) {
    nx = xx <= yy ? 1.0 : 0.0;
    ny = 1.0 - nx;
  } else {
    nx /= length;
    ny /= length;
  }
  const double t = -(gx * nx + gy * ny) / least;
  if (std::abs(t * nx) > 0.6 || std::abs(t * ny) > 0.6) return;
  const std::size_t i = index(x, y);
  is_ridge[i] = 1;
  along_x[i] = -ny;
  along_y[i] = nx;
  at_x[i] = x + t * nx;
  at_y[i] = y + t * ny;
}

RidgeLine followed_ridge(const RidgeField& field, std::vector<std::uint8_t>& used, int x0, int y0,
                         double low) {
  using namespace ridge_trace;
  const std::size_t first = field.index(x0, y0);
  used[first] = 1;
  const auto half = [&](double sign) {
    std::vector<sim::EastNorth> points;
    RidgeStep at{x0, y0, sign * field.along_x[first], sign * field.along_y[first]};
    for (;;) {
      const RidgeStep next = next_on_ridge(field, used, at, low);
      if (next.x < 0) return points;
      // What lies beside the step belongs to this ridge too.
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) used[field.index(at.x + i, at.y + j)] = 1;
      at = next;
      const std::size_t n = field.index(at.x, at.y);
      used[n] = 1;
      points.push_back(field.raster.place(field.at_x[n], field.at_y[n]));
    }
  };
  const std::vector<sim::EastNorth> ahead = half(1.0), behind = half(-1.0);
  std::vector<sim::EastNorth> line(behind.rbegin(), behind.rend());
  line.push_back(field.raster.place(field.at_x[first], field.at_y[first]));
  line.insert(line.end(), ahead.begin(), ahead.end());
  return line;
}

RidgeLine evenly_spaced(const RidgeLine& line, double step_km, double& length_km) {
  std::vector<sim::EastNorth> smooth = line;
  for (std::size_t i = 1; i + 1 < line.size(); ++i)
    smooth[i] = {0.25 * line[i - 1].east + 0.5 * line[i].east + 0.25 * line[i + 1].east,
                 0.25 * line[i - 1].north + 0.5 * line[i].north + 0.25 * line[i + 1].north};
  std::vector<double> at = {0.0};
  for (std::size_t i = 1; i < smooth.size(); ++i)
    at.push_back(at.back() +
                 std::hypot(smooth[i].east - smooth[i - 1].east, smooth[i].north - smooth[i - 1].north));
  length_km = at.back();
  const int steps = std::max(1, static_cast<int>(std::lround(length_km / step_km)));
  std::vector<sim::EastNorth> points;
  std::size_t i = 0;
  for (int k = 0; k <= steps; ++k) {
    const double wanted = length_km * k / steps;
    while (i + 2 < at.size() && at[i + 1] < wanted) ++i;
    const double t = at[i + 1] > at[i] ? std::clamp((wanted - at[i]) / (at[i + 1] - at[i]), 0.0, 1.0) : 0.0;
    points.push_back({smooth[i].east + t * (smooth[i + 1].east - smooth[i].east),
                      smooth[i].north + t * (smooth[i + 1].north - smooth[i].north)});
  }
  return points;
}

}  // namespace vegard::fit
