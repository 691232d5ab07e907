#include "fit/sheet_in_view.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "sim/base/earth.h"
#include "sim/render/film.h"
#include "sim/scene/emission_lines.h"
#include "sim/view/camera.h"

namespace vegard::fit {
namespace {

constexpr double kGreenNm = 557.7;

/// Mean over the sine's phase of the variance of the layers' places across the sheet, and a layer's own.
double depth_km2(const sim::Sheet& sheet) {
  std::complex<double> sum = 0.0;
  for (int layer = 0; layer < sheet.layers; ++layer)
    sum += std::polar(1.0, sheet.layers > 1 ? sheet.phase_shift_rad * layer / (sheet.layers - 1) : 0.0);
  const double together = std::norm(sum / static_cast<double>(std::max(1, sheet.layers)));
  return sheet.width_km * sheet.width_km + 0.5 * sheet.thickness_km * sheet.thickness_km * (1.0 - together);
}

}  // namespace

std::optional<SheetInView> sheet_in_view(const sim::Scene& scene, const sim::Sheet& sheet, double x_px,
                                         double y_px) {
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  // By how much the line of sight turns from column to column: a difference across one pixel.
  double here[3], left[3], right[3];
  if (!sim::enu_of_pixel(view, x_px, y_px, here) || !sim::enu_of_pixel(view, x_px - 0.5, y_px, left) ||
      !sim::enu_of_pixel(view, x_px + 0.5, y_px, right))
    return std::nullopt;
  const double east = here[0], north = here[1];
  const double bearing = sheet.bearing_deg * sim::kRadiansPerDegree;
  const double u_east = std::sin(bearing), u_north = std::cos(bearing);
  // Across the sheet: (u_north, -u_east). The line of sight r (east, north) meets the line at r = offset /
  // across, along it by r (east, north) . u.
  const double offset = sheet.center_km.east * u_north - sheet.center_km.north * u_east;
  const double across = east * u_north - north * u_east, along = east * u_east + north * u_north;
  if (!(offset * across > 0.0)) return std::nullopt;
  const double turn_east = right[0] - left[0], turn_north = right[1] - left[1];
  const double turn_across = turn_east * u_north - turn_north * u_east,
               turn_along = turn_east * u_east + turn_north * u_north;
  SheetInView seen;
  seen.km_per_px = std::abs(offset * (turn_along * across - along * turn_across) / (across * across));
  const int green = std::max(0, sim::line_index(scene.emission.lines, kGreenNm));
  const double blur_px = sim::blur_sigma_px(scene, green);
  const double slant = along / across;
  seen.smear_km2 =
      seen.km_per_px * seen.km_per_px * (blur_px * blur_px + 1.0 / 12.0) + depth_km2(sheet) * slant * slant;
  return seen;
}

}  // namespace vegard::fit
