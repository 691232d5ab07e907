#include "fit/border/sky_cells.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/constants.h"
#include "sim/base/parallel.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr double kWidestHoleDeg = 1.0;
constexpr double kFinestRow_deg = 0.08, kFinestTiltedRow_deg = 0.25;
constexpr double kLowestTilted_deg = 40.0;  // of the sky that is looked at about a tilted pole

/// The vectors (east, north, up) of a frame's pole, of its column 0 and of the column to the right of that.
struct FrameAxes {
  double pole[3], ahead[3], right[3];

  explicit FrameAxes(const SkyFrame& frame) {
    const double t = frame.tilt_deg * sim::kRadiansPerDegree, a = frame.towards_deg * sim::kRadiansPerDegree;
    pole[0] = std::sin(t) * std::sin(a), pole[1] = std::sin(t) * std::cos(a), pole[2] = std::cos(t);
    ahead[0] = -std::cos(t) * std::sin(a), ahead[1] = -std::cos(t) * std::cos(a), ahead[2] = std::sin(t);
    for (int i = 0; i < 3; ++i)
      right[i] = ahead[(i + 1) % 3] * pole[(i + 2) % 3] - ahead[(i + 2) % 3] * pole[(i + 1) % 3];
  }

  /// Along a column, for a weight of the column's direction at the horizon and one of the pole.
  void along(double column_deg, double level, double up, double enu[3]) const {
    const double u = column_deg * sim::kRadiansPerDegree;
    for (int i = 0; i < 3; ++i)
      enu[i] = level * (std::cos(u) * ahead[i] + std::sin(u) * right[i]) + up * pole[i];
  }
};

/// Sums of the light around one place of the picture.
struct BorderSample {
  double light = 0.0, weight = 0.0;
  int asked = 0, outside = 0;
};

void take_border_sample(const Photo& photo, int channel, const sim::CameraView<double>& view,
                        const sim::Direction& direction, BorderSample& sample) {
  double enu[3], x = 0.0, y = 0.0;
  sim::enu_of_direction(direction, enu);
  ++sample.asked;
  if (!sim::pixel_of_enu(view, enu, x, y) || !(x >= 0.0 && y >= 0.0) || x >= photo.linear.width ||
      y >= photo.linear.height) {
    ++sample.outside;
    return;
  }
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  for (int i = 0; i < 4; ++i) {
    const int column = std::clamp(static_cast<int>(left) + i % 2, 0, photo.linear.width - 1);
    const int row = std::clamp(static_cast<int>(top) + i / 2, 0, photo.linear.height - 1);
    const std::size_t at = photo.linear.index(column, row, channel);
    const double in_x = x - 0.5 - left, in_y = y - 0.5 - top;
    const double weight = (i % 2 == 1 ? in_x : 1.0 - in_x) * (i / 2 == 1 ? in_y : 1.0 - in_y);
    if (photo.usable[at] == 0) continue;
    sample.light += weight * photo.linear.data[at];
    sample.weight += weight;
  }
}

}  // namespace

sim::Direction SkyFrame::direction(double column_deg, double row_deg) const {
  if (is_upright()) return {column_deg, row_deg};
  const double v = row_deg * sim::kRadiansPerDegree;
  double enu[3];
  FrameAxes(*this).along(column_deg, std::cos(v), std::sin(v), enu);
  return sim::direction_of_enu(enu);
}

double SkyFrame::downwards(double column_deg, double row_deg, double slope) const {
  const double v = row_deg * sim::kRadiansPerDegree;
  const FrameAxes axes(*this);
  double place[3], down[3], right[3];
  axes.along(column_deg, std::cos(v), std::sin(v), place);
  axes.along(column_deg, std::sin(v), -std::cos(v), down);
  axes.along(column_deg + 90.0, 1.0, 0.0, right);
  // The line goes cos(v) to the right and `slope` up, so what is across it has as much of right as it rises.
  const double level = std::cos(v), length = std::hypot(level, slope);
  const double across = (level * down[2] + slope * right[2]) / length;
  // Downwards to the horizon is the vertical's part across the line of sight.
  return -across / std::max(1e-9, std::sqrt(std::max(0.0, 1.0 - place[2] * place[2])));
}

void bridge_holes(SkyCells& cells) {
  const int widest = static_cast<int>(kWidestHoleDeg / cells.elevation_step_deg);
  for (int c = 0; c < cells.columns; ++c) {
    int last = -1;
    for (int r = 0; r < cells.rows; ++r) {
      if (!std::isfinite(cells.light[cells.index(c, r)])) continue;
      if (last >= 0 && r - last > 1 && r - last - 1 <= widest) {
        const double from = cells.light[cells.index(c, last)], to = cells.light[cells.index(c, r)];
        for (int k = last + 1; k < r; ++k) {
          cells.light[cells.index(c, k)] = from + (to - from) * (k - last) / (r - last);
          cells.limit[cells.index(c, k)] = BorderLimit::none;
        }
      }
      last = r;
    }
  }
}

SkyCells sky_cells(const Photo& photo, const sim::Camera& camera, const BorderSettings& settings,
                   const SkyFrame& frame) {
  SkyCells cells;
  cells.frame = frame;
  const double scale = sim::pixels_per_degree(camera);
  cells.columns = static_cast<int>(std::lround(360.0 / settings.azimuth_step_deg));
  cells.azimuth_step_deg = 360.0 / cells.columns;
  cells.lowest_deg = settings.lowest_elevation_deg;
  const double span = settings.highest_elevation_deg - settings.lowest_elevation_deg;
  cells.rows = static_cast<int>(std::ceil(
      span / std::clamp(1.0 / scale, frame.is_upright() ? kFinestRow_deg : kFinestTiltedRow_deg, 1.0)));
  cells.elevation_step_deg = span / cells.rows;
  const std::size_t size = static_cast<std::size_t>(cells.columns) * cells.rows;
  cells.light.assign(size, sim::kNaN);
  cells.limit.assign(size, BorderLimit::none);
  const sim::CameraView<double> view = sim::camera_view(camera);
  // The tilted frames look for what is wide: fewer samples do.
  const int most_up = frame.is_upright() ? 6 : 2, most_across = frame.is_upright() ? 16 : 6;
  const int up = std::clamp(static_cast<int>(std::lround(cells.elevation_step_deg * scale)), 1, most_up);
  sim::parallel_for(static_cast<std::size_t>(cells.rows), 0, [&](std::size_t row, int) {
    const int r = static_cast<int>(row);
    const double level = std::cos(cells.elevation_deg(r) * sim::kRadiansPerDegree);
    const int across =
        std::clamp(static_cast<int>(std::ceil(cells.azimuth_step_deg * level * scale)), 1, most_across);
    for (int c = 0; c < cells.columns; ++c) {
      const std::size_t at = cells.index(c, r);
      if (!frame.is_upright() &&
          !(frame.direction(cells.azimuth_deg(c), cells.elevation_deg(r)).elevation_deg >
            kLowestTilted_deg)) {
        cells.limit[at] = BorderLimit::frame;
        continue;
      }
      BorderSample sample;
      for (int i = 0; i < across * up; ++i) {
        const double aside = (i % across + 0.5) / across - 0.5, above = (i / across + 0.5) / up - 0.5;
        take_border_sample(photo, settings.channel, view,
                           frame.direction(cells.azimuth_deg(c) + aside * cells.azimuth_step_deg,
                                           cells.elevation_deg(r + above)),
                           sample);
      }
      if (sample.weight >= 0.5 * sample.asked)
        cells.light[at] = sample.light / sample.weight;
      else
        cells.limit[at] = 2 * sample.outside >= sample.asked ? BorderLimit::frame : BorderLimit::mask;
    }
  });
  return cells;
}

}  // namespace vegard::fit
