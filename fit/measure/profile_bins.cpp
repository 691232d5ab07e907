#include "fit/measure/profile_bins.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr int kRowsEachSide = 7;  ///< 15 rows of 30 pixels give the noise to 4 %

BinGrid vertical(const Region& region, int bands, int rows = 1) {
  if (bands < 1 || bands > region.width)
    throw sim::Error(sim::ErrorKind::scene, std::to_string(bands) + " bands do not fit into the region")
        .key("fit.bands")
        .expected("1 to " + std::to_string(region.width) + ", its width in pixels");
  BinGrid grid;
  grid.region = region;
  grid.groups = bands;
  grid.positions = (region.height + rows - 1) / rows;
  grid.position_px = rows;
  grid.pooled = kRowsEachSide / rows;
  grid.narrowest_px = region.width / bands;
  for (int b = 0; b < bands; ++b) grid.band.insert(grid.band.end(), grid.positions, b);
  return grid;
}

}  // namespace

BinGrid column_bins(const Region& region, int bands, int rows) {
  BinGrid grid = vertical(region, bands, rows);
  const std::vector<int> band = bands_of_columns(region, bands);
  gather([&](int x, int y) { return band[x - region.x] * grid.positions + (y - region.y) / rows; }, grid);
  return grid;
}

BinGrid elevation_bins(const Region& region, int bands, const sim::Camera& camera) {
  BinGrid grid = vertical(region, bands);
  const std::vector<int> band = bands_of_columns(region, bands);
  const sim::CameraView<double> view = sim::camera_view(camera);
  const auto sine_of_elevation = [&](double x_px, double y_px) {
    double enu[3];
    return sim::enu_of_pixel(view, x_px, y_px, enu) ? enu[2] : std::numeric_limits<double>::quiet_NaN();
  };
  // Borders of positions down the middle column. Beyond the zenith the elevation falls again: only what lies
  // on one side of its highest point counts, the longer one. A camera that looks up has the horizon below;
  // an all-sky camera, in a region on the horizon's upper side, above. What the lens has no image of does not
  // count either.
  std::vector<double> border(region.height + 1);
  for (int k = 0; k <= region.height; ++k)
    border[k] = sine_of_elevation(region.x + 0.5 * region.width, region.y + k);
  int first = 0, last = region.height;
  while (last > 0 && std::isnan(border[last])) --last;
  while (first < last && std::isnan(border[first])) ++first;
  int top = first;
  for (int k = first; k <= last; ++k)
    if (std::isnan(border[top]) || border[k] > border[top]) top = k;
  const bool rises = top - first > last - top;  // with the rows, towards the picture's lower edge
  const int begin = rises ? first : top, end = rises ? top : last;
  // Whichever way it goes, what is compared falls with the rows.
  const double sign = rises ? -1.0 : 1.0;
  for (double& sine : border) sine *= sign;
  gather(
      [&](int x, int y) {
        const double s = sign * sine_of_elevation(x + 0.5, y + 0.5);
        if (!(s <= border[begin] && s > border[end])) return kNoBin;
        const auto below =
            std::lower_bound(border.begin() + begin, border.begin() + end + 1, s, std::greater<double>());
        const int position = std::max(0, static_cast<int>(below - border.begin()) - 1);
        return band[x - region.x] * region.height + position;
      },
      grid);
  return grid;
}

BinGrid field_bins(const Region& region, int bands, const sim::Camera& camera, const sim::Field& field) {
  BinGrid grid = vertical(region, bands);
  const std::vector<int> band = bands_of_columns(region, bands);
  const sim::CameraView<double> view = sim::camera_view(camera);
  // Against the field in the north, with it in the south: upwards.
  const double inclination = field.inclination_deg * sim::kRadiansPerDegree,
               declination = field.declination_deg * sim::kRadiansPerDegree;
  const double sign = field.inclination_deg < 0.0 ? -1.0 : 1.0;
  const double up[3] = {-sign * std::cos(inclination) * std::sin(declination),
                        -sign * std::cos(inclination) * std::cos(declination), sign * std::sin(inclination)};
  double line[3] = {0.0, 0.0, 0.0};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) line[i] += view.camera_from_enu[i][k] * up[k];
  // The pictures of field lines are great circles through the magnetic zenith: a pixel is on the one whose
  // angle about the zenith it has, counted from that of the region's middle.
  const double middle = region.y + 0.5 * region.height;
  double ahead[3];
  if (!unproject(view.lens, region.x + 0.5 * region.width, middle, ahead)) return grid;
  double across[3], ahead_along = 0.0;
  for (int i = 0; i < 3; ++i) ahead_along += ahead[i] * line[i];
  for (int i = 0; i < 3; ++i) ahead[i] -= ahead_along * line[i];
  for (int i = 0; i < 3; ++i)
    across[i] = line[(i + 1) % 3] * ahead[(i + 2) % 3] - line[(i + 2) % 3] * ahead[(i + 1) % 3];
  const auto angle = [&](double x_px, double y_px) {
    double ray[3], x = 0.0, y = 0.0;
    if (!unproject(view.lens, x_px, y_px, ray)) return std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < 3; ++i) {
      x += ray[i] * ahead[i];
      y += ray[i] * across[i];
    }
    return std::atan2(y, x);
  };
  // Which column the middle row has an angle in; the angle runs one way from the middle outwards.
  std::vector<double> border(region.width + 1);
  for (int k = 0; k <= region.width; ++k) border[k] = angle(region.x + k, middle);
  const int half = region.width / 2;
  const double way = border[std::min(half + 1, region.width)] < border[std::max(half - 1, 0)] ? -1.0 : 1.0;
  int first = half, last = half;
  while (first > 0 && way * border[first - 1] < way * border[first]) --first;
  while (last < region.width && way * border[last + 1] > way * border[last]) ++last;
  gather(
      [&](int x, int y) {
        const double here = way * angle(x + 0.5, y + 0.5);
        if (!(here >= way * border[first] && here < way * border[last])) return kNoBin;
        const auto above = std::upper_bound(border.begin() + first, border.begin() + last + 1, here,
                                            [way](double value, double edge) { return value < way * edge; });
        const int column = static_cast<int>(above - border.begin()) - 1;
        return band[std::clamp(column, 0, region.width - 1)] * region.height + y - region.y;
      },
      grid);
  return grid;
}

BinGrid profile_bins(const sim::Scene& scene, const Region& region) {
  const sim::Fit& fit = scene.fit;
  switch (fit.profile_along) {
    case sim::ProfileAlong::columns:
      return column_bins(region, fit.bands);
    case sim::ProfileAlong::elevation:
      return elevation_bins(region, fit.bands, scene.camera);
    case sim::ProfileAlong::loop:
      return loop_bins(scene, region);
    case sim::ProfileAlong::limb:
      return limb_bins(scene, region);
    case sim::ProfileAlong::field:
      break;
  }
  if (scene.field.model != sim::FieldModel::uniform)
    throw sim::Error(sim::ErrorKind::scene, "profiles along the field line need a uniform field")
        .key("fit.profile_along")
        .expected("field.model = \"uniform\", or \"columns\" or \"elevation\" here");
  return field_bins(region, fit.bands, scene.camera, scene.field);
}

}  // namespace vegard::fit
