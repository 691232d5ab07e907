#include "fit/model/sheet_in_view.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "sim/base/number/constants.h"
#include "sim/render/film.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

/// Mean over the sine's phase of the variance of the layers' places across the sheet, and a layer's own.
double depth_km2(const sim::Sheet& sheet) {
  std::complex<double> sum = 0.0;
  for (int layer = 0; layer < sheet.layers; ++layer)
    sum += std::polar(1.0, sheet.layers > 1 ? sheet.phase_shift_rad * layer / (sheet.layers - 1) : 0.0);
  const double resultant = std::norm(sum / static_cast<double>(std::max(1, sheet.layers)));
  return sheet.width_km * sheet.width_km + 0.5 * sheet.thickness_km * sheet.thickness_km * (1.0 - resultant);
}

}  // namespace

std::optional<SheetInView> sheet_in_view(const sim::Scene& scene, const sim::Sheet& sheet, double x_px,
                                         double y_px) {
  if (sheet.course == sim::SheetCourse::curve) return std::nullopt;
  const sim::CameraView<double> view = sim::camera_view(scene.camera);
  double ray[3], turn[3], here[2] = {0.0, 0.0}, turned[2] = {0.0, 0.0};
  if (!unproject(view.lens, x_px, y_px, ray)) return std::nullopt;
  // By how much the line of sight turns from column to column, along the row.
  const sim::PlaceSlopes slopes = place_slopes(view.lens, ray);
  for (int i = 0; i < 3; ++i)
    turn[i] = (slopes.across[0][i] * slopes.slope[1][1] - slopes.across[1][i] * slopes.slope[1][0]) /
              slopes.determinant();
  for (int i = 0; i < 2; ++i)
    for (int r = 0; r < 3; ++r) {
      here[i] += view.camera_from_enu[r][i] * ray[r];
      turned[i] += view.camera_from_enu[r][i] * turn[r];
    }
  const double east = here[0], north = here[1];
  const double bearing = sheet.bearing_deg * sim::kRadiansPerDegree;
  const double u_east = std::sin(bearing), u_north = std::cos(bearing);
  // Across the sheet: (u_north, -u_east). The line of sight r (east, north) meets the line at r = offset /
  // across, along it by r (east, north) . u.
  const double offset = sheet.center_km.east * u_north - sheet.center_km.north * u_east;
  const double across = east * u_north - north * u_east, along = east * u_east + north * u_north;
  if (!(offset * across > 0.0)) return std::nullopt;
  const double turn_east = turned[0], turn_north = turned[1];
  const double turn_across = turn_east * u_north - turn_north * u_east,
               turn_along = turn_east * u_east + turn_north * u_north;
  SheetInView seen;
  seen.km_per_px = std::abs(offset * (turn_along * across - along * turn_across) / (across * across));
  const int green = std::max(0, sim::line_index(scene.emission.lines, sim::kGreenNm));
  const double blur_px = sim::blur_sigma_px(scene, green);
  const double slant = along / across;
  seen.smear_km2 =
      seen.km_per_px * seen.km_per_px * (blur_px * blur_px + 1.0 / 12.0) + depth_km2(sheet) * slant * slant;
  return seen;
}

}  // namespace vegard::fit
