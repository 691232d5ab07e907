#include "fit/photo/pointing/identification.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr double kSearchWidth_px = 2.5;  // how near a point counts while turning
constexpr double kTwistStep_deg = 0.5;
constexpr double kScaleStep = 0.03;  // 5 px at the edge of a circle of 160 px

/// Points by place, for nearest neighbours.
class PointGrid {
 public:
  PointGrid(const std::vector<FoundStar>& points, const Frame& frame)
      : points_(points),
        columns_(frame.width_px / kCell_px + 1),
        rows_(frame.height_px / kCell_px + 1),
        cells_(static_cast<std::size_t>(columns_) * rows_) {
    for (std::size_t i = 0; i < points.size(); ++i)
      cells_[cell(points[i].x_px, points[i].y_px)].push_back(static_cast<int>(i));
  }

  /// The nearest within the radius, or -1.
  int nearest(double x, double y, double radius, double& distance) const {
    int best = -1;
    distance = radius;
    const int reach = static_cast<int>(radius / kCell_px) + 1;
    const int column = static_cast<int>(std::floor(x / kCell_px)),
              row = static_cast<int>(std::floor(y / kCell_px));
    for (int j = std::max(row - reach, 0); j <= std::min(row + reach, rows_ - 1); ++j)
      for (int i = std::max(column - reach, 0); i <= std::min(column + reach, columns_ - 1); ++i)
        for (const int p : cells_[static_cast<std::size_t>(j) * columns_ + i]) {
          const double d = std::hypot(points_[p].x_px - x, points_[p].y_px - y);
          if (d < distance) {
            distance = d;
            best = p;
          }
        }
    return best;
  }

 private:
  static constexpr int kCell_px = 16;
  std::size_t cell(double x, double y) const {
    const int i = std::clamp(static_cast<int>(x / kCell_px), 0, columns_ - 1);
    const int j = std::clamp(static_cast<int>(y / kCell_px), 0, rows_ - 1);
    return static_cast<std::size_t>(j) * columns_ + i;
  }
  const std::vector<FoundStar>& points_;
  int columns_, rows_;
  std::vector<std::vector<int>> cells_;
};

bool in_frame(const Frame& frame, double x, double y) {
  return x > 0.0 && y > 0.0 && x < frame.width_px && y < frame.height_px;
}

/// Brighter stars are surer to be seen.
double weight_of(double magnitude) { return std::pow(10.0, -0.2 * (magnitude - 2.0)); }

double agreement(const SkyCamera& camera, const Frame& frame, const std::vector<StarSighting>& sky,
                 double faintest, const PointGrid& grid) {
  double sum = 0.0;
  for (const StarSighting& star : sky) {
    if (star.magnitude > faintest) break;
    double x = 0.0, y = 0.0, distance = 0.0;
    if (!place_of_star(camera, star.enu, x, y) || !in_frame(frame, x, y)) continue;
    if (grid.nearest(x, y, 3.0 * kSearchWidth_px, distance) < 0) continue;
    sum += weight_of(star.magnitude) *
           std::exp(-0.5 * distance * distance / (kSearchWidth_px * kSearchWidth_px));
  }
  return sum;
}

constexpr double kMaxCameras = 2e6;  // some minutes

/// `cameras` gets the number of those that were compared.
SkyCamera searched(const SkyCamera& rough, const Frame& frame, const std::vector<StarSighting>& sky,
                   const PointGrid& grid, const IdentificationSettings& settings, double& cameras) {
  SkyCamera best = rough;
  double most = agreement(rough, frame, sky, settings.first_magnitude + 1.0, grid);
  const int twists = static_cast<int>(settings.twist_deg / kTwistStep_deg);
  const int shifts = static_cast<int>(std::ceil(settings.shift_px / kSearchWidth_px));
  const int scales = static_cast<int>(std::ceil(settings.scale_share / kScaleStep));
  cameras = (2.0 * twists + 1.0) * (2.0 * scales + 1.0) * std::pow(2.0 * shifts + 1.0, 2);
  if (cameras > kMaxCameras)
    throw sim::Error(sim::ErrorKind::usage,
                     "they ask for " + sim::short_number(cameras, 2) + " cameras to be tried")
        .key("--twist, --shift, --scale")
        .expected("at most " + sim::short_number(kMaxCameras, 2))
        .hint("say better where the camera points: --centre, or a narrower search");
  for (int twist = -twists; twist <= twists; ++twist) {
    SkyCamera turned = rough;
    turned.numbers[turn_about_forward] = twist * kTwistStep_deg * sim::kRadiansPerDegree;
    turned = with_rotation_applied(turned);
    for (int scale = -scales; scale <= scales; ++scale) {
      turned.numbers[focal_px_number] = rough.numbers[focal_px_number] * (1.0 + scale * kScaleStep);
      for (int down = -shifts; down <= shifts; ++down)
        for (int right = -shifts; right <= shifts; ++right) {
          SkyCamera camera = turned;
          camera.numbers[centre_x_number] += right * kSearchWidth_px;
          camera.numbers[centre_y_number] += down * kSearchWidth_px;
          const double sum = agreement(camera, frame, sky, settings.first_magnitude + 1.0, grid);
          if (sum > most) {
            most = sum;
            best = camera;
          }
        }
    }
  }
  return best;
}

/// Stars to a magnitude whose nearest point within the radius has them as its nearest too.
std::vector<StarSighting> matched(const SkyCamera& camera, const Frame& frame,
                                  const std::vector<StarSighting>& sky, const std::vector<FoundStar>& points,
                                  const PointGrid& grid, double faintest, double radius,
                                  int& in_frame_count) {
  struct Match {
    int star;
    double distance;
  };
  std::vector<Match> of_point(points.size(), {-1, 0.0});
  in_frame_count = 0;
  for (std::size_t i = 0; i < sky.size() && sky[i].magnitude <= faintest; ++i) {
    double x = 0.0, y = 0.0, distance = 0.0;
    if (!place_of_star(camera, sky[i].enu, x, y) || !in_frame(frame, x, y)) continue;
    ++in_frame_count;
    const int p = grid.nearest(x, y, radius, distance);
    if (p < 0) continue;
    if (of_point[p].star < 0 || distance < of_point[p].distance)
      of_point[p] = {static_cast<int>(i), distance};
  }
  std::vector<StarSighting> stars;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (of_point[p].star < 0) continue;
    StarSighting star = sky[of_point[p].star];
    star.x_px = points[p].x_px;
    star.y_px = points[p].y_px;
    stars.push_back(star);
  }
  std::stable_sort(stars.begin(), stars.end(),
                   [](const StarSighting& a, const StarSighting& b) { return a.magnitude < b.magnitude; });
  return stars;
}

/// Returns the expected number of stars with a point within the radius among random points as dense as near
/// each star.
double chance_matches(const SkyCamera& camera, const Frame& frame, const std::vector<StarSighting>& sky,
                      const std::vector<FoundStar>& points, double faintest, double radius) {
  constexpr double kNear_px = 30.0;
  double expected = 0.0;
  for (const StarSighting& star : sky) {
    if (star.magnitude > faintest) break;
    double x = 0.0, y = 0.0;
    if (!place_of_star(camera, star.enu, x, y) || !in_frame(frame, x, y)) continue;
    int near = 0;
    for (const FoundStar& point : points) {
      const double distance = std::hypot(point.x_px - x, point.y_px - y);
      near += distance < kNear_px && distance >= radius;
    }
    expected += 1.0 - std::exp(-near * radius * radius / (kNear_px * kNear_px - radius * radius));
  }
  return expected;
}

}  // namespace

bool is_trustworthy(const Identification& found) { return is_no_chance(found.agreement); }

double faintest_for_field(const SkyCamera& camera, const Frame& frame, const std::vector<StarSighting>& sky,
                          double faintest, int enough) {
  const std::vector<ExpectedStar> seen = expected_stars(camera, frame, sky);
  if (seen.empty()) return faintest;
  const std::size_t last = std::min(seen.size(), static_cast<std::size_t>(enough)) - 1;
  return std::max(faintest, sky[static_cast<std::size_t>(seen[last].star)].magnitude);
}

Identification identify(const SkyCamera& rough, const Frame& frame, const std::vector<StarSighting>& sky,
                        const std::vector<FoundStar>& points, const IdentificationSettings& settings) {
  const PointGrid grid(points, frame);
  Identification found;
  double cameras = 1.0;
  found.camera = searched(rough, frame, sky, grid, settings, cameras);
  for (int round = 0; round <= settings.rounds; ++round) {
    const double part = static_cast<double>(round) / settings.rounds;
    const double radius =
        settings.first_radius_px * std::pow(settings.last_radius_px / settings.first_radius_px, part);
    const double faintest = settings.first_magnitude + part * (settings.faintest - settings.first_magnitude);
    found.stars = matched(found.camera, frame, sky, points, grid, faintest, radius, found.in_frame);
    found.last_radius_px = radius;
    if (2 * found.stars.size() < settings.free.size() + 2) continue;
    const CameraFit fit = fit_camera(found.camera, settings.free, found.stars, {}, 0.3 * radius);
    if (fit.good) found.camera = fit.camera;
  }
  found.stars = matched(found.camera, frame, sky, points, grid, settings.faintest, settings.last_radius_px,
                        found.in_frame);
  found.by_chance =
      chance_matches(found.camera, frame, sky, points, settings.faintest, settings.last_radius_px);
  // Every round's stars were others: the fits were drawn to points in as many ways again.
  found.agreement = agreement_against_chance(
      found.camera, frame, sky, points, PointCells(points, frame, points.size()),
      static_cast<double>(settings.free.size()), cameras * (settings.rounds + 1.0), settings.pixels);
  return found;
}

}  // namespace vegard::fit
