#include "fit/border/cut_peaks.h"

#include <algorithm>
#include <cmath>

namespace vegard::fit {
namespace cut_peaks {

/// Whether a direction falls on a pixel that is clipped or masked.
bool is_cut(const Photo& photo, const sim::CameraView<double>& view, int channel,
            const sim::Direction& direction) {
  double enu[3], x = 0.0, y = 0.0;
  sim::enu_of_direction(direction, enu);
  if (photo.usable.empty() || !sim::pixel_of_enu(view, enu, x, y)) return false;
  if (!(x >= 0.0 && y >= 0.0) || x >= photo.linear.width || y >= photo.linear.height) return true;
  return photo.usable[photo.linear.index(static_cast<int>(x), static_cast<int>(y), channel)] == 0;
}

}  // namespace cut_peaks

double cut_peak_share(const BorderTrace& trace, const Photo& photo, const sim::Camera& camera, int channel) {
  const sim::CameraView<double> view = sim::camera_view(camera);
  const double step_deg = 1.0 / sim::pixels_per_degree(camera);
  int measured = 0, cut = 0;
  for (const BorderPoint& point : trace.points) {
    if (!point.measured()) continue;
    ++measured;
    const double highest_deg = std::min(89.0, point.peak_elevation_deg + 2.0 * point.fall_deg);
    double longest_deg = 0.0, run_deg = 0.0;
    for (double up_deg = point.elevation_deg; up_deg <= highest_deg; up_deg += step_deg) {
      const bool is_cut = cut_peaks::is_cut(photo, view, channel, {point.azimuth_deg, up_deg});
      run_deg = is_cut ? run_deg + step_deg : 0.0;
      longest_deg = std::max(longest_deg, run_deg);
    }
    cut += longest_deg >= point.fall_deg;
  }
  return measured > 0 ? static_cast<double>(cut) / measured : 0.0;
}

}  // namespace vegard::fit
