#include "fit/triangulation/triangulated_point.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr double kLeastParallax = 3.0;  ///< in its standard errors
constexpr double kLeastParallax_rad = 1e-7;

/// A sight with what does not change while the place is looked for.
struct Line {
  std::size_t camera;
  Eigen::Vector3d from_km, direction;
  Eigen::MatrixXd across;      ///< rows: one or two unit vectors across the line
  Eigen::Matrix3d pixel_rad2;  ///< covariance of the direction by the pixel
};

std::optional<Line> line_of(const std::vector<ViewPoint>& cameras, const Sight& sight) {
  const ViewPoint& view = cameras[sight.camera];
  if (!view.has(sight.pixel)) return std::nullopt;
  const auto direction = view.direction(sight.pixel);
  const auto slopes = view.slopes(sight.pixel);
  if (!direction || !slopes) return std::nullopt;
  Line line{sight.camera, view.place_km(), *direction, {}, {}};
  const double square = sight.pixel_error_px * sight.pixel_error_px;
  Eigen::Vector3d first = direction->unitOrthogonal();
  if (sight.curve) {
    const Eigen::Vector3d along = *slopes * *sight.curve;
    first = direction->cross(along).normalized();  // across the curve
    const Eigen::Vector2d normal = Eigen::Vector2d(-(*sight.curve)[1], (*sight.curve)[0]).normalized();
    const double turn = first.dot(*slopes * normal);  // radians to a pixel
    line.pixel_rad2 = square * turn * turn * first * first.transpose();
  } else {
    line.pixel_rad2 = square * *slopes * slopes->transpose();
  }
  line.across.resize(sight.is_anywhere_on_curve ? 1 : 2, 3);
  line.across.row(0) = first.transpose();
  if (!sight.is_anywhere_on_curve) line.across.row(1) = direction->cross(first).transpose();
  return line;
}

/// The place with the least sum of squares of distances from the lines; none if they are parallel.
std::optional<Eigen::Vector3d> nearest_place(const std::vector<Line>& lines) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Line& line : lines) {
    const Eigen::Matrix3d off = Eigen::Matrix3d::Identity() - line.direction * line.direction.transpose();
    normal += off;
    right += off * (line.from_km - lines.front().from_km);
  }
  const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
  if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-16)) return std::nullopt;
  return lines.front().from_km + solver.solve(right);
}

/// What the errors make of a place.
struct Equations {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double chi2 = 0.0;
  int rows = 0;
  std::vector<Eigen::MatrixXd> slopes, weights;  ///< of each line
};

Equations equations_at(const std::vector<ViewPoint>& cameras, const std::vector<Line>& lines,
                       const Eigen::Vector3d& place, double drift_km_s) {
  Equations out;
  for (const Line& line : lines) {
    const PlacedCamera& camera = cameras[line.camera].camera();
    const Eigen::Vector3d sight = place - line.from_km;
    const double distance = sight.norm();
    const Eigen::Vector3d towards = sight / distance;
    const Eigen::MatrixXd slope =
        line.across * (Eigen::Matrix3d::Identity() - towards * towards.transpose()) / distance;
    const double turn = camera.pointing_error_deg * sim::kRadiansPerDegree;
    const double moved = drift_km_s * camera.clock_error_s / distance;
    const Eigen::Vector3d up = place.normalized();
    const Eigen::Matrix3d level = Eigen::Matrix3d::Identity() - up * up.transpose();
    const Eigen::Matrix3d error =
        line.pixel_rad2 + turn * turn * Eigen::Matrix3d::Identity() + moved * moved * level;
    Eigen::MatrixXd covariance = line.across * error * line.across.transpose();
    covariance.diagonal().array() += 1e-18;  // a point of a curve has no error along it
    const Eigen::MatrixXd weight = covariance.inverse();
    const Eigen::VectorXd off = line.across * towards;
    out.normal += slope.transpose() * weight * slope;
    out.right -= slope.transpose() * weight * off;
    out.chi2 += off.dot(weight * off);
    out.rows += static_cast<int>(off.size());
    out.slopes.push_back(slope);
    out.weights.push_back(weight);
  }
  return out;
}

double parallax_rad(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

/// The distance between two lines where they are nearest.
double gap_km(const Line& a, const Line& b) {
  const Eigen::Vector3d across = a.direction.cross(b.direction);
  const Eigen::Vector3d between = b.from_km - a.from_km;
  return std::abs(between.dot(across)) / across.norm();
}

/// The standard error of a direction, across the other line at its worst, without the clock.
double turn_error_rad(const std::vector<ViewPoint>& cameras, const Line& line) {
  const double turn = cameras[line.camera].camera().pointing_error_deg * sim::kRadiansPerDegree;
  return std::sqrt(turn * turn + line.pixel_rad2.trace());
}

void set_parallax(TriangulatedPoint& point, const std::vector<ViewPoint>& cameras,
                  const std::vector<Line>& lines) {
  point.parallax_deg = 0.0;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      if (lines[i].camera == lines[j].camera) continue;
      const double angle = parallax_rad(lines[i].direction, lines[j].direction);
      if (angle / sim::kRadiansPerDegree < point.parallax_deg) continue;
      point.parallax_deg = angle / sim::kRadiansPerDegree;
      point.parallax_error_deg =
          std::hypot(turn_error_rad(cameras, lines[i]), turn_error_rad(cameras, lines[j])) /
          sim::kRadiansPerDegree;
    }
}

/// The covariance of the place, and what moves it in common to a camera's sights.
void set_errors(TriangulatedPoint& point, const std::vector<Line>& lines, const Equations& at) {
  const Eigen::Matrix3d inverse = at.normal.inverse();
  const Eigen::Matrix3d enu = east_north_up(point.place);
  point.covariance_km2 = enu * inverse * enu.transpose();
  point.east_error_km = std::sqrt(point.covariance_km2(0, 0));
  point.north_error_km = std::sqrt(point.covariance_km2(1, 1));
  point.height_error_km = std::sqrt(point.covariance_km2(2, 2));
  const Eigen::RowVector3d up = enu.row(2);
  double by_pixels = 0.0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    const Eigen::RowVectorXd pull = up * inverse * at.slopes[i].transpose() * at.weights[i];
    const Eigen::RowVector3d of_direction = pull * line.across;
    by_pixels += of_direction * line.pixel_rad2 * of_direction.transpose();
    // A turn w moves the line's direction d by w x d; (w x d) . g = w . (d x g).
    HeightPull& common = point.pulls[line.camera];
    common.km_per_rad += line.direction.cross(of_direction.transpose());
    common.km_per_km += (pull * at.slopes[i]).transpose();
  }
  point.pixel_height_error_km = std::sqrt(by_pixels);
}

/// The probability that the sum of squares of this many normal numbers is larger (Abramowitz and Stegun 1964,
/// 26.4.4 and 26.4.5).
double chance_of(double chi2, int freedom) {
  const double half = 0.5 * chi2;
  const bool is_odd = freedom % 2 != 0;
  double chance = is_odd ? std::erfc(std::sqrt(half)) : std::exp(-half);
  double term = is_odd ? std::exp(-half) * std::sqrt(half / (0.25 * sim::kPi)) : std::exp(-half) * half;
  for (int k = is_odd ? 3 : 4; k <= freedom; k += 2) {
    chance += term;
    term *= half / (0.5 * k);
  }
  return std::min(1.0, chance);
}

TriangulatedPoint without(NoPlace reason, TriangulatedPoint point) {
  TriangulatedPoint none;
  none.reason = reason;
  none.parallax_deg = point.parallax_deg;
  none.parallax_error_deg = point.parallax_error_deg;
  return none;
}

}  // namespace

const char* words_of(NoPlace reason) {
  switch (reason) {
    case NoPlace::none:
      break;
    case NoPlace::outside_lens:
      return "a pixel lies outside of its picture or of what its lens shows";
    case NoPlace::parallel:
      return "the lines of sight are parallel within their errors";
    case NoPlace::behind:
      return "the lines of sight meet behind a camera";
    case NoPlace::underground:
      return "the lines of sight meet under ground or behind the horizon";
  }
  return "";
}

TriangulatedPoint::TriangulatedPoint()
    : place{sim::kNaN, sim::kNaN, sim::kNaN},
      place_km(Eigen::Vector3d::Constant(sim::kNaN)),
      height_error_km(sim::kNaN),
      east_error_km(sim::kNaN),
      north_error_km(sim::kNaN),
      covariance_km2(Eigen::Matrix3d::Constant(sim::kNaN)),
      pixel_height_error_km(sim::kNaN),
      miss_km(sim::kNaN),
      chi2(sim::kNaN),
      probability(sim::kNaN),
      parallax_deg(sim::kNaN),
      parallax_error_deg(sim::kNaN) {}

TriangulatedPoint triangulated(const std::vector<ViewPoint>& cameras, const std::vector<Sight>& sights,
                               double drift_km_s) {
  TriangulatedPoint point;
  std::vector<Line> lines;
  for (const Sight& sight : sights) {
    const std::optional<Line> line = line_of(cameras, sight);
    if (!line) return without(NoPlace::outside_lens, point);
    lines.push_back(*line);
  }
  set_parallax(point, cameras, lines);
  const double least =
      std::max(kLeastParallax * point.parallax_error_deg, kLeastParallax_rad / sim::kRadiansPerDegree);
  if (!(point.parallax_deg > least)) return without(NoPlace::parallel, point);
  const std::optional<Eigen::Vector3d> start = nearest_place(lines);
  if (!start) return without(NoPlace::parallel, point);
  Eigen::Vector3d place = *start;
  const auto is_behind = [&] {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const Line& line) { return !((place - line.from_km).dot(line.direction) > 0.0); });
  };
  if (is_behind()) return without(NoPlace::behind, point);
  Equations at = equations_at(cameras, lines, place, drift_km_s);
  for (int i = 0; i < 30; ++i) {
    const Eigen::LDLT<Eigen::Matrix3d> solver(at.normal);
    const Eigen::Vector3d step = solver.solve(at.right);
    if (!step.allFinite()) return without(NoPlace::parallel, point);
    place += step;
    if (is_behind()) return without(NoPlace::behind, point);
    at = equations_at(cameras, lines, place, drift_km_s);
    if (step.norm() < 1e-9 * (place - lines.front().from_km).norm()) break;
  }
  for (const Line& line : lines)
    if (cameras[line.camera].is_hidden(place)) return without(NoPlace::underground, point);

  point.place_km = place;
  point.place = geodetic_place(cameras.front().shape(), place);
  point.chi2 = at.chi2;
  point.freedom = at.rows - 3;
  if (point.freedom > 0) point.probability = chance_of(std::max(0.0, at.chi2), point.freedom);
  point.miss_km = 0.0;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = i + 1; j < lines.size(); ++j)
      if (lines[i].camera != lines[j].camera)
        point.miss_km = std::max(point.miss_km, gap_km(lines[i], lines[j]));
  for (const Line& line : lines) point.distance_km.push_back((place - line.from_km).norm());
  point.pulls.resize(cameras.size());
  set_errors(point, lines, at);
  for (const double number : {point.place.height_km, point.height_error_km, point.east_error_km,
                              point.north_error_km, point.pixel_height_error_km})
    if (!std::isfinite(number)) return without(NoPlace::parallel, point);
  return point;
}

namespace {

constexpr double kFarthest = 3.0;    ///< of a point from the median, in standard deviations
constexpr double kNeighbours = 4.0;  ///< points that err together

double weighted_median_km(const std::vector<const TriangulatedPoint*>& points) {
  std::vector<std::pair<double, double>> heights;
  double sum = 0.0;
  for (const TriangulatedPoint* point : points) {
    if (!point->is_given()) continue;
    heights.emplace_back(point->place.height_km, std::pow(point->height_error_km, -2));
    sum += heights.back().second;
  }
  std::sort(heights.begin(), heights.end());
  double below = 0.0;
  for (const auto& [height_km, weight] : heights)
    if ((below += weight) >= 0.5 * sum) return height_km;
  return sim::kNaN;
}

}  // namespace

MeanHeight mean_height(const std::vector<ViewPoint>& cameras,
                       const std::vector<const TriangulatedPoint*>& points, double drift_km_s) {
  MeanHeight mean{0, sim::kNaN, sim::kNaN, sim::kNaN, sim::kNaN};
  double weights = 0.0, sum = 0.0, squares = 0.0, by_pixels = 0.0;
  std::vector<HeightPull> pulls(cameras.size());
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  const double middle_km = weighted_median_km(points);
  for (const TriangulatedPoint* point : points) {
    if (!point->is_given() || std::abs(point->place.height_km - middle_km) >
                                  kFarthest * std::hypot(point->height_error_km, kHeightsAlongBorder_km))
      continue;
    const double weight = 1.0 / std::pow(point->height_error_km, 2);
    ++mean.points;
    weights += weight;
    sum += weight * point->place.height_km;
    squares += weight * std::pow(point->place.height_km, 2);
    by_pixels += std::pow(weight * point->pixel_height_error_km, 2);
    up += weight * point->place_km.normalized();
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      pulls[i].km_per_rad += weight * point->pulls[i].km_per_rad;
      pulls[i].km_per_km += weight * point->pulls[i].km_per_km;
    }
  }
  if (mean.points == 0) return mean;
  mean.km = sum / weights;
  mean.scatter_km = std::sqrt(std::max(0.0, squares / weights - mean.km * mean.km));
  double common = 0.0;
  up.normalize();
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const PlacedCamera& camera = cameras[i].camera();
    const Eigen::Vector3d level = pulls[i].km_per_km - up * up.dot(pulls[i].km_per_km);
    common += std::pow(camera.pointing_error_deg * sim::kRadiansPerDegree / weights, 2) *
                  pulls[i].km_per_rad.squaredNorm() +
              std::pow(drift_km_s * camera.clock_error_s / weights, 2) * level.squaredNorm();
  }
  mean.common_error_km = std::sqrt(common);
  // The scatter may be the heights' own: it is an error of their mean as far as there are few of them.
  const double own = std::max(kNeighbours * by_pixels / (weights * weights),
                              std::pow(mean.scatter_km, 2) * kNeighbours / (mean.points + kNeighbours));
  mean.error_km = std::sqrt(own + common);
  return mean;
}

}  // namespace vegard::fit
