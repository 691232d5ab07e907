#include "fit/photo/pointing/skyline_doubt.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "fit/photo/pointing/catalogue_sky.h"
#include "fit/photo/pointing/star_finder.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr double kHighSkyline_deg = 10.0, kHighAzimuths_deg = 20.0;
constexpr double kStarElevation_deg = 3.0;  // lower ones are dimmed by the air
constexpr double kStarMagnitude = 4.0;
constexpr double kRoughOver_deg = 0.5;  // half the width of what an outline is compared with
constexpr double kSmooth_deg = 0.1;
constexpr int kStarsThatShow = 3;

struct SkylineColumn {
  double x_px, y_px, azimuth_deg, elevation_deg;
};

/// The median distance of the line from its neighbours' mean, in pixels.
double roughness_px(const std::vector<SkylineColumn>& line, std::size_t reach) {
  std::vector<double> off;
  for (std::size_t i = reach; i + reach < line.size(); ++i) {
    if (line[i + reach].x_px - line[i - reach].x_px > 2.5 * static_cast<double>(reach)) continue;  // a gap
    off.push_back(std::abs(line[i].y_px - 0.5 * (line[i - reach].y_px + line[i + reach].y_px)));
  }
  return sim::median(off);
}

void count_stars_below(const std::vector<SkylineColumn>& line, const sim::Camera& camera, const Photo& photo,
                       const SkyOfPicture& sky, SkylineDoubt& doubt) {
  const int width = photo.linear.width, height = photo.linear.height;
  const double radius_px = std::max(2.5, 0.08 * sim::pixels_per_degree(camera));
  std::vector<char> below(static_cast<std::size_t>(width) * height, 0);
  double area_px2 = 0.0;
  for (const SkylineColumn& column : line) {
    const int x = std::clamp(static_cast<int>(column.x_px), 0, width - 1);
    // The edge itself is no star.
    for (int y = std::max(0, static_cast<int>(column.y_px + 4.0 * radius_px)); y < height; ++y) {
      below[static_cast<std::size_t>(y) * width + x] = 1;
      area_px2 += 1.0;
    }
  }
  const std::vector<FoundStar> points = find_stars(photo.linear, {}, below);
  const sim::CameraView<double> view = sim::camera_view(camera);
  int asked = 0;
  for (const StarSighting& star :
       catalogue_sky(*sky.observer, *sky.julian_date, kStarMagnitude, kStarElevation_deg)) {
    double x = 0.0, y = 0.0;
    if (!sim::pixel_of_enu(view, star.enu.data(), x, y) || x < 0.0 || y < 0.0 || x >= width || y >= height ||
        below[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] == 0)
      continue;
    ++asked;
    doubt.stars_below += std::any_of(points.begin(), points.end(), [&](const FoundStar& point) {
      return std::hypot(point.x_px - x, point.y_px - y) <= radius_px;
    });
  }
  if (area_px2 > 0.0)
    doubt.by_chance =
        asked *
        (1.0 - std::exp(-static_cast<double>(points.size()) * sim::kPi * radius_px * radius_px / area_px2));
}

}  // namespace

bool SkylineDoubt::has_stars() const {
  return stars_below >= kStarsThatShow && stars_below > 3.0 * by_chance;
}

std::optional<SkylineDoubt> skyline_doubt(const std::vector<PixelPoint>& skyline, const sim::Camera& camera,
                                          const Photo& photo, const SkyOfPicture& sky) {
  std::vector<SkylineColumn> high;
  SkylineDoubt doubt;
  for (const PixelPoint& point : skyline) {
    const sim::Direction at = sim::direction_of_pixel(camera, point.x_px, point.y_px);
    const bool is_at_frame = point.y_px > photo.linear.height - 1.5;  // the sky goes on below the picture
    if (is_at_frame || !(at.elevation_deg > kHighSkyline_deg)) continue;
    if (!high.empty()) {
      const double step = std::abs(std::remainder(at.azimuth_deg - high.back().azimuth_deg, 360.0));
      if (point.x_px - high.back().x_px < 1.5) doubt.azimuths_deg += step;
    }
    high.push_back({point.x_px, point.y_px, at.azimuth_deg, at.elevation_deg});
  }
  if (doubt.azimuths_deg < kHighAzimuths_deg) return std::nullopt;
  const auto [lowest, highest] = std::minmax_element(
      high.begin(), high.end(),
      [](const SkylineColumn& a, const SkylineColumn& b) { return a.elevation_deg < b.elevation_deg; });
  doubt.from_deg = lowest->elevation_deg;
  doubt.to_deg = highest->elevation_deg;
  if (sky.observer && sky.julian_date) count_stars_below(high, camera, photo, sky, doubt);
  const double px_per_deg = sim::pixels_per_degree(camera);
  const auto reach = static_cast<std::size_t>(std::max(2.0, kRoughOver_deg * px_per_deg));
  constexpr double kSmooth_px = 0.6;
  const bool is_smooth = roughness_px(high, reach) < std::max(kSmooth_px, kSmooth_deg * px_per_deg);
  if (!is_smooth && !doubt.has_stars()) return std::nullopt;
  return doubt;
}

}  // namespace vegard::fit
