#include "fit/photo/pointing/horizon_calibration.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fit/photo/picture_field_of_view.h"
#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/dense_solvers.h"

namespace vegard::fit {
namespace {

using sim::kRadiansPerDegree;

// Elevation, roll, logarithm of the focal length in pixels, dip; angles in radians.
constexpr int kUnknowns = 4, kHorizonElevation = 0, kRoll = 1, kLogFocal = 2, kDip = 3;
using Numbers = std::array<double, kUnknowns>;

/// The distance of a point from the horizon, positive into the sky, in standard deviations; places are
/// counted from the picture's middle.
struct PointResidual {
  double x_px, y_px, sigma_px;

  template <class T>
  bool operator()(const T* number, T* residual) const {
    using std::cos;
    using std::exp;
    using std::sin;
    using std::sqrt;
    const T ce = cos(number[kHorizonElevation]);
    const T up[3] = {ce * sin(number[kRoll]), -ce * cos(number[kRoll]), sin(number[kHorizonElevation])};
    const T focal = exp(number[kLogFocal]);
    const T length2 = focal * focal + x_px * x_px + y_px * y_px, length = sqrt(length2);
    const T along = (up[0] * x_px + up[1] * y_px + up[2] * focal) / length;
    const T slope_x = (up[0] - along * x_px / length) / length,
            slope_y = (up[1] - along * y_px / length) / length;
    const T slope = sqrt(slope_x * slope_x + slope_y * slope_y);
    residual[0] = (along + sin(number[kDip])) / (slope * sigma_px);
    return true;
  }
};

struct HorizonDescent {
  Numbers numbers{};
  double chi2 = 0.0;  ///< in units of the stated error
  bool usable = false;
  std::vector<double> residual_px;
  Eigen::MatrixXd information;  ///< of the free numbers, per stated error
};

std::vector<int> free_numbers(const HorizonProblem& p) {
  std::vector<int> free = {kHorizonElevation, kRoll};
  if (!p.hfov_deg) free.push_back(kLogFocal);
  if (p.free_dip) free.push_back(kDip);
  return free;
}

HorizonDescent descend(const HorizonProblem& p, const Numbers& start) {
  HorizonDescent descent;
  descent.numbers = start;
  double* numbers = descent.numbers.data();
  ceres::Problem problem;
  for (const PixelPoint& point : p.points)
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<PointResidual, 1, kUnknowns>(new PointResidual{
            point.x_px - 0.5 * p.width_px, point.y_px - 0.5 * p.height_px, p.point_error_px}),
        nullptr, numbers);
  const std::vector<int> free = free_numbers(p);
  std::vector<int> held;
  for (int i = 0; i < kUnknowns; ++i)
    if (std::find(free.begin(), free.end(), i) == free.end()) held.push_back(i);
  if (!held.empty()) problem.SetManifold(numbers, new ceres::SubsetManifold(kUnknowns, held));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-16;
  options.parameter_tolerance = 1e-14;
  options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  std::vector<double> residuals;
  ceres::CRSMatrix jacobian;
  ceres::Problem::EvaluateOptions all;
  double cost = 0.0;
  descent.usable = summary.IsSolutionUsable() &&
                   problem.Evaluate(all, &cost, &residuals, nullptr, &jacobian) && std::isfinite(cost);
  if (!descent.usable) return descent;
  descent.chi2 = 2.0 * cost;
  for (const double residual : residuals) descent.residual_px.push_back(residual * p.point_error_px);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(jacobian.num_rows, jacobian.num_cols);
  for (int row = 0; row < jacobian.num_rows; ++row)
    for (int k = jacobian.rows[row]; k < jacobian.rows[row + 1]; ++k)
      dense(row, jacobian.cols[k]) = jacobian.values[k];
  descent.information = dense.transpose() * dense;
  return descent;
}

Eigen::Vector3d ray(const HorizonProblem& p, const PixelPoint& point, double focal_px) {
  return Eigen::Vector3d(point.x_px - 0.5 * p.width_px, point.y_px - 0.5 * p.height_px, focal_px)
      .normalized();
}

/// The two points that are farthest apart.
std::pair<PixelPoint, PixelPoint> farthest(const std::vector<PixelPoint>& points) {
  std::pair<PixelPoint, PixelPoint> pair{points.front(), points.front()};
  double most = -1.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = i + 1; k < points.size(); ++k) {
      const double distance_px = std::hypot(points[i].x_px - points[k].x_px, points[i].y_px - points[k].y_px);
      if (distance_px > most) most = distance_px, pair = {points[i], points[k]};
    }
  return pair;
}

/// The zenith that puts the two points on the cone of the dip, with the sky on the left of the way from the
/// first to the second (side = 1) or on the right (-1); nothing if no cone of that dip goes through both.
std::optional<Eigen::Vector3d> zenith_of_two(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double dip,
                                             double side) {
  // u = m (a + b) + n (a x b), by symmetry; m from a . u = -sin d, n from |u| = 1.
  const double cosine = a.dot(b), m = -std::sin(dip) / (1.0 + cosine);
  const double rest = 1.0 - m * m * 2.0 * (1.0 + cosine), area2 = 1.0 - cosine * cosine;
  if (rest < 0.0 || area2 <= 0.0) return std::nullopt;
  return (m * (a + b) - side * std::sqrt(rest / area2) * a.cross(b)).eval();
}

/// 1 if the sky lies to the left of the way from a to b, as one sees it in the picture; else -1.
double sky_side(const HorizonProblem& p, const PixelPoint& a, const PixelPoint& b) {
  const double dx = b.x_px - a.x_px, dy = b.y_px - a.y_px;
  if (!p.sky) return dx >= 0.0 ? 1.0 : -1.0;  // the picture's top
  const double left = dy * (p.sky->x_px - a.x_px) - dx * (p.sky->y_px - a.y_px);
  return left >= 0.0 ? 1.0 : -1.0;
}

std::optional<Numbers> start(const HorizonProblem& p, double focal_px, double dip, double side) {
  const auto [a, b] = farthest(p.points);
  const auto up = zenith_of_two(ray(p, a, focal_px), ray(p, b, focal_px), dip, side * sky_side(p, a, b));
  if (!up) return std::nullopt;
  return Numbers{std::asin(std::clamp(up->z(), -1.0, 1.0)), std::atan2(up->x(), -up->y()), std::log(focal_px),
                 dip};
}

/// The best end of descents from a few focal lengths and dips, those given if they are.
HorizonDescent best_descent(const HorizonProblem& p, double side) {
  std::vector<double> fields = {25.0, 45.0, 70.0, 95.0};
  if (p.hfov_deg) fields = {*p.hfov_deg};
  std::vector<double> dips = {p.dip_deg};
  if (p.free_dip) dips = {p.dip_deg, 0.5 * p.dip_deg, 1.5 * p.dip_deg, 5.0, 20.0};
  HorizonDescent best;
  for (const double field : fields)
    for (const double dip : dips) {
      const auto numbers = start(p, focal_of_hfov_px(field, p.width_px), dip * kRadiansPerDegree, side);
      if (!numbers) continue;
      const HorizonDescent descent = descend(p, *numbers);
      if (descent.usable && (!best.usable || descent.chi2 < best.chi2)) best = descent;
    }
  return best;
}

void check_horizon(const HorizonProblem& p) {
  if (p.points.size() < 2)
    throw sim::Error(sim::ErrorKind::usage, std::to_string(p.points.size()) + " point on the horizon")
        .key("--points")
        .expected("at least two points");
  for (const PixelPoint& point : p.points)
    if (!(point.x_px >= 0.0 && point.x_px <= p.width_px && point.y_px >= 0.0 && point.y_px <= p.height_px))
      throw sim::Error(sim::ErrorKind::usage, "a point lies outside of the picture")
          .key("--points")
          .expected("0,0 to " + std::to_string(p.width_px) + "," + std::to_string(p.height_px));
  const auto [a, b] = farthest(p.points);
  const double distance_px = std::hypot(a.x_px - b.x_px, a.y_px - b.y_px);
  if (distance_px < std::max(1.0, 5.0 * p.point_error_px))
    throw sim::Error(sim::ErrorKind::usage, "the points are all one, as well as they are known")
        .key("--points")
        .expected("points far apart from each other");
  if (!p.sky && std::abs(a.x_px - b.x_px) < std::max(1.0, p.point_error_px))
    throw sim::Error(sim::ErrorKind::usage,
                     "the horizon is vertical in the picture: on which side is the sky?")
        .key("--points")
        .expected("--sky X,Y");
  if (!p.hfov_deg && p.dip_deg <= 0.0)
    throw sim::Error(sim::ErrorKind::usage, "a straight horizon says nothing about the field of view")
        .key("--hfov")
        .expected("--hfov or --focal-35mm")
        .hint("seen from far above (--altitude-m) it is bent, and does");
  const std::size_t unknowns = free_numbers(p).size();
  if (p.points.size() < unknowns)
    throw sim::Error(sim::ErrorKind::usage, std::to_string(p.points.size()) + " points cannot determine " +
                                                (p.free_dip ? "the dip" : "the field of view") +
                                                " and elevation and roll")
        .key("--points")
        .expected("at least " + std::to_string(unknowns) + " points")
        .hint(p.free_dip ? "" : "or give --hfov or --focal-35mm");
}

/// A horizon that bends says by itself where the sky is.
void check_side(const HorizonProblem& p, const HorizonDescent& chosen) {
  constexpr double kClear = 9.0;  // three standard deviations
  double height = 0.0;
  if (p.sky && !(PointResidual{p.sky->x_px - 0.5 * p.width_px, p.sky->y_px - 0.5 * p.height_px, 1.0}(
                     chosen.numbers.data(), &height) &&
                 height > 0.0))
    throw sim::Error(sim::ErrorKind::usage, "this point lies below the horizon of the others")
        .key("--sky")
        .expected("a point in the sky");
  if (p.points.size() < 3) return;
  const HorizonDescent other = best_descent(p, -1.0);
  if (!other.usable || other.chi2 + kClear >= chosen.chi2) return;
  if (p.sky)
    throw sim::Error(sim::ErrorKind::usage, "the horizon bends the other way than with the sky there")
        .key("--sky")
        .expected("a point in the sky");
  throw sim::Error(sim::ErrorKind::usage,
                   "the horizon bends the other way than with the sky at the picture's top")
      .key("--points")
      .expected("points on the edge of the Earth, from above")
      .hint("say where the sky is with --sky X,Y");
}

ErrorBar degrees(double radians, double sigma_radians) {
  return {radians / kRadiansPerDegree, sigma_radians / kRadiansPerDegree};
}

void add_relief(const HorizonProblem& p, double focal_px, HorizonCalibration& result) {
  if (!(p.relief_deg > 0.0)) return;
  const auto [a, b] = farthest(p.points);
  const double apart = std::acos(std::clamp(ray(p, a, focal_px).dot(ray(p, b, focal_px)), -1.0, 1.0));
  result.elevation_deg.sigma = std::hypot(result.elevation_deg.sigma, p.relief_deg);
  result.roll_deg.sigma =
      std::hypot(result.roll_deg.sigma,
                 std::atan(std::sqrt(2.0) * p.relief_deg * kRadiansPerDegree / apart) / kRadiansPerDegree);
}

}  // namespace

double horizon_dip_deg(double observer_km, double layer_km) {
  if (observer_km <= layer_km) return 0.0;
  return std::acos((sim::kEarthRadiusKm + layer_km) / (sim::kEarthRadiusKm + observer_km)) /
         kRadiansPerDegree;
}

double layer_of_dip_km(double dip_deg, double observer_km) {
  return (sim::kEarthRadiusKm + observer_km) * std::cos(dip_deg * kRadiansPerDegree) - sim::kEarthRadiusKm;
}

HorizonCalibration calibrate_horizon(const HorizonProblem& p) {
  check_horizon(p);
  const HorizonDescent found = best_descent(p, 1.0);
  if (!found.usable)
    throw sim::Error(sim::ErrorKind::usage, "no horizon goes through these points")
        .key("--points")
        .expected("points on one horizon")
        .hint("are the field of view and --altitude-m right?");
  check_side(p, found);

  const std::vector<int> free = free_numbers(p);
  const std::size_t spare = p.points.size() - free.size();
  HorizonCalibration result;
  result.residual_px = found.residual_px;
  double squares = 0.0;
  for (const double residual : found.residual_px) squares += residual * residual;
  result.rms_px = std::sqrt(squares / static_cast<double>(p.points.size()));
  result.used_error_px = p.point_error_px;
  if (spare > 0)
    result.used_error_px = std::max(p.point_error_px, std::sqrt(squares / static_cast<double>(spare)));

  Numbers sigma{};
  const Eigen::MatrixXd covariance =
      sim::inverse_of(found.information) * std::pow(result.used_error_px / p.point_error_px, 2);
  for (std::size_t i = 0; i < free.size(); ++i)
    sigma[free[i]] = std::sqrt(covariance(static_cast<int>(i), static_cast<int>(i)));
  result.elevation_deg = degrees(found.numbers[kHorizonElevation], sigma[kHorizonElevation]);
  result.roll_deg = degrees(found.numbers[kRoll], sigma[kRoll]);
  add_relief(p, std::exp(found.numbers[kLogFocal]), result);
  result.dip_deg = degrees(found.numbers[kDip], sigma[kDip]);
  const double focal_px = std::exp(found.numbers[kLogFocal]);
  result.hfov_deg.value = hfov_of_focal_deg(focal_px, p.width_px);
  // d hfov / d ln f = -sin(hfov).
  result.hfov_deg.sigma =
      std::sin(result.hfov_deg.value * kRadiansPerDegree) * sigma[kLogFocal] / kRadiansPerDegree;
  const auto too_open = [](const ErrorBar& bar) { return !(bar.sigma < std::abs(bar.value) / 3.0); };
  if (!p.hfov_deg && too_open(result.hfov_deg))
    throw sim::Error(sim::ErrorKind::usage, "the horizon is not bent enough to determine the field of view")
        .key("--points")
        .expected("--hfov or --focal-35mm")
        .hint("or more points, farther apart");
  if (p.free_dip && too_open(result.dip_deg))
    throw sim::Error(sim::ErrorKind::usage, "the horizon is not bent enough to determine its dip")
        .key("--points")
        .expected("more points, farther apart");
  return result;
}

}  // namespace vegard::fit
