#include "fit/photo/mask/horizon.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"

namespace vegard::fit {
namespace {

sim::Error bad_drawn_line(const std::string& key, const std::string& problem) {
  return sim::Error(sim::ErrorKind::usage, problem)
      .key(key)
      .expected("at least two points x,y at different x");
}

}  // namespace

Horizon drawn_horizon(std::vector<PicturePoint> points, int width, const std::string& key) {
  if (points.size() < 2) throw bad_drawn_line(key, "a line has at least two points");
  std::sort(points.begin(), points.end(),
            [](const PicturePoint& a, const PicturePoint& b) { return a.x_px < b.x_px; });
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i].x_px == points[i - 1].x_px) throw bad_drawn_line(key, "two points are at one x");
  Horizon horizon;
  std::size_t piece = 1;
  for (int column = 0; column < width; ++column) {
    const double x = column + 0.5;
    while (piece + 1 < points.size() && x > points[piece].x_px) ++piece;
    const PicturePoint &a = points[piece - 1], &b = points[piece];
    horizon.y_px.push_back(a.y_px + (x - a.x_px) / (b.x_px - a.x_px) * (b.y_px - a.y_px));
  }
  return horizon;
}

PixelSet below(const Horizon& horizon, int height, double margin_px) {
  PixelSet set(static_cast<int>(horizon.y_px.size()), height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < set.width; ++x) set.at(x, y) = y + 0.5 > horizon.y_px[x] - margin_px;
  return set;
}

std::string horizon_csv(const Horizon& horizon, const std::string& picture) {
  std::string text =
      sim::csv_comment("picture: " + picture) +
      sim::csv_comment("the sky's lower edge per column; the centre of the first pixel is at 0.5, 0.5") +
      "x_px,y_px\n";
  for (std::size_t x = 0; x < horizon.y_px.size(); ++x)
    text += sim::csv_number(x + 0.5) + "," + sim::csv_number(horizon.y_px[x]) + "\n";
  return text;
}

}  // namespace vegard::fit
