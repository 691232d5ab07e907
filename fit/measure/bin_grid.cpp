#include "fit/measure/bin_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "fit/measure/bin_gather.h"
#include "fit/measure/limb_bins.h"
#include "fit/measure/loop_bins.h"
#include "sim/base/earth.h"
#include "sim/base/error.h"
#include "sim/view/camera/camera.h"

namespace vegard::fit {
namespace {

constexpr int kPooledRowsEachSide = 7;  ///< 15 rows of 30 pixels give the noise to 4 %
constexpr int kHorizontalBin = 8;       ///< pixels
constexpr int kCellsEachSide = 1;

/// Band of every column, counted from the region's left.
std::vector<int> bands_of_columns(const Region& region, int bands) {
  std::vector<int> band(region.width);
  for (int b = 0; b < bands; ++b)
    std::fill(band.begin() + (band_begin(region, bands, b) - region.x),
              band.begin() + (band_begin(region, bands, b + 1) - region.x), b);
  return band;
}

BinGrid vertical(const Region& region, int bands) {
  if (bands < 1 || bands > region.width) {
    sim::ErrorDetails details;
    details.key = "fit.bands";
    details.problem = std::to_string(bands) + " bands do not fit into the region";
    details.expected = "1 to " + std::to_string(region.width) + ", its width in pixels";
    throw sim::Error(sim::ErrorKind::scene, details);
  }
  BinGrid grid;
  grid.region = region;
  grid.groups = bands;
  grid.positions = region.height;
  grid.pooled = kPooledRowsEachSide;
  grid.narrowest_px = region.width / bands;
  for (int b = 0; b < bands; ++b) grid.band.insert(grid.band.end(), region.height, b);
  return grid;
}

/// Bands of the bins of another grid, by where their centres lie among the profiles' bins; where there is
/// none, by column.
void take_bands(const BinGrid& profiles, BinGrid& grid) {
  const Region& region = profiles.region;
  const std::vector<int> of_column = bands_of_columns(region, profiles.groups);
  std::vector<int> of_pixel(static_cast<std::size_t>(region.width) * region.height, kNoBin);
  for (std::size_t b = 0; b < profiles.bins(); ++b)
    for (std::size_t r = profiles.first_run[b]; r < profiles.first_run[b + 1]; ++r) {
      const BinGrid::Run& run = profiles.runs[r];
      int* row = of_pixel.data() + static_cast<std::size_t>(run.y - region.y) * region.width - region.x;
      std::fill(row + run.begin, row + run.end, profiles.band[b]);
    }
  grid.band.assign(grid.bins(), 0);
  for (std::size_t b = 0; b < grid.bins(); ++b) {
    if (grid.first_run[b] == grid.first_run[b + 1]) continue;
    const BinGrid::Run &first = grid.runs[grid.first_run[b]], &last = grid.runs[grid.first_run[b + 1] - 1];
    const int x = (first.begin + last.end) / 2 - region.x, y = (first.y + last.y) / 2 - region.y;
    const int band = of_pixel[static_cast<std::size_t>(y) * region.width + x];
    grid.band[b] = band != kNoBin ? band : of_column[x];
  }
}

}  // namespace

BinGrid column_bins(const Region& region, int bands) {
  BinGrid grid = vertical(region, bands);
  const std::vector<int> band = bands_of_columns(region, bands);
  gather([&](int x, int y) { return band[x - region.x] * region.height + y - region.y; }, grid);
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
                                            [way](double value, double of) { return value < way * of; });
        const int column = static_cast<int>(above - border.begin()) - 1;
        return band[std::clamp(column, 0, region.width - 1)] * region.height + y - region.y;
      },
      grid);
  return grid;
}

BinGrid profile_bins(const sim::Scene& scene, const Region& region) {
  const sim::Fit& fit = scene.fit;
  if (fit.profile_along == "elevation") return elevation_bins(region, fit.bands, scene.camera);
  if (fit.profile_along == "loop") return loop_bins(scene, region);
  if (fit.profile_along == "limb") return limb_bins(scene, region);
  if (fit.profile_along != "field") return column_bins(region, fit.bands);
  if (scene.field.model != "uniform") {
    sim::ErrorDetails details;
    details.key = "fit.profile_along";
    details.problem = "profiles along the field line need a uniform field";
    details.expected = "field.model = \"uniform\", or \"columns\" or \"elevation\" here";
    throw sim::Error(sim::ErrorKind::scene, details);
  }
  return field_bins(region, fit.bands, scene.camera, scene.field);
}

BinGrid horizontal_bins(const BinGrid& profiles, int strips) {
  BinGrid grid;
  grid.region = profiles.region;
  const Region& region = grid.region;
  const int bands = profiles.groups;
  const int each = std::max(1, region.width / bands / kHorizontalBin);
  grid.groups = std::min(strips, region.height);
  grid.positions = bands * each;
  std::vector<int> position(region.width);
  for (int b = 0; b < bands; ++b) {
    const int begin = band_begin(region, bands, b) - region.x,
              end = band_begin(region, bands, b + 1) - region.x;
    for (int x = begin; x < end; ++x) position[x] = b * each + (x - begin) * each / (end - begin);
  }
  grid.position_px = static_cast<double>(region.width) / grid.positions;
  grid.narrowest_px = region.width / grid.positions;
  gather(
      [&](int x, int y) {
        const int strip =
            static_cast<int>(static_cast<long long>(y - region.y) * grid.groups / region.height);
        return strip * grid.positions + position[x - region.x];
      },
      grid);
  take_bands(profiles, grid);
  return grid;
}

BinGrid image_bins(const BinGrid& profiles, int cell_px) {
  BinGrid grid;
  grid.region = profiles.region;
  const Region& region = grid.region;
  const int cell = std::min({cell_px, region.width, region.height});
  grid.groups = region.height / cell;
  grid.positions = region.width / cell;
  grid.pooled = kCellsEachSide;
  grid.position_px = 0.0;
  grid.narrowest_px = cell;
  gather(
      [&](int x, int y) {
        const int across = (x - region.x) / cell, down = (y - region.y) / cell;
        return across < grid.positions && down < grid.groups ? down * grid.positions + across : kNoBin;
      },
      grid);
  take_bands(profiles, grid);
  return grid;
}

}  // namespace vegard::fit
