#include "fit/measure/limb_layer.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/base/number/dense_solvers.h"

namespace vegard::fit {
namespace {

constexpr int kNumbers = 5;  ///< peak, logarithms of both widths, amplitude, sky
constexpr std::size_t kLayerMinPoints = 8;
constexpr double kShellKm = 0.5;
constexpr double kLayerReach = 5.0;  ///< widths from the peak; beyond, there is nothing
constexpr double kMinWidthKm = 1.0, kMaxWidthKm = 150.0;
constexpr double kStartWidthKm = 6.0;
constexpr double kHalf = 1.1774100225154747;  ///< sqrt(2 ln 2)

using std::exp;  // of plain numbers; that of Ceres' dual ones is found by their type

/// N(h), up to top_km. The way from the tangent point is the variable of integration: in it nothing is
/// infinite at z = h.
template <typename T>
T column_km(double tangent_km, const T& peak_km, const T& lower_width_km, const T& upper_width_km,
            double top_km) {
  const double from_centre_km = sim::kEarthRadiusKm + tangent_km;
  const double max_km = sim::kEarthRadiusKm + top_km;
  if (max_km <= from_centre_km) return T(0.0);
  const double half_km = std::sqrt(max_km * max_km - from_centre_km * from_centre_km);
  // Steps that pass no more than kShellKm of altitude at their far end, where the line climbs steepest.
  const int steps = std::max(64, static_cast<int>(std::ceil(half_km * half_km / max_km / kShellKm)));
  const double step_km = half_km / steps;
  T sum(0.0);
  for (int k = 0; k < steps; ++k) {
    const double along_km = (k + 0.5) * step_km;
    const double z_km = std::hypot(from_centre_km, along_km) - sim::kEarthRadiusKm;
    const T off = z_km - peak_km;
    const T u = off / (off < 0.0 ? lower_width_km : upper_width_km);
    if (u > -kLayerReach && u < kLayerReach) sum += exp(-0.5 * u * u);
  }
  return 2.0 * step_km * sum;
}

struct LayerPoints {
  std::vector<double> tangent_km, light;
  double top_km = 0.0;
  double scale = 1.0;  ///< light in units of its largest
};

struct LayerCost {
  const LayerPoints& points;

  template <typename T>
  bool operator()(const T* numbers, T* residuals) const {
    const T lower = exp(numbers[1]), upper = exp(numbers[2]);
    if (lower < kMinWidthKm || upper < kMinWidthKm || lower > kMaxWidthKm || upper > kMaxWidthKm)
      return false;
    for (std::size_t i = 0; i < points.light.size(); ++i)
      residuals[i] = numbers[3] * column_km(points.tangent_km[i], numbers[0], lower, upper, points.top_km) +
                     numbers[4] - points.light[i] / points.scale;
    return true;
  }
};

LayerPoints usable(const std::vector<double>& tangent_km, const std::vector<double>& light,
                   double observer_km) {
  LayerPoints points;
  for (std::size_t i = 0; i < light.size(); ++i)
    if (std::isfinite(light[i]) && tangent_km[i] >= kLimbAirKm) {
      points.tangent_km.push_back(tangent_km[i]);
      points.light.push_back(light[i]);
    }
  points.top_km = observer_km;
  return points;
}

double apparent_peak_km(double peak_km, double lower_width_km, double upper_width_km, double top_km) {
  constexpr double kStepKm = 0.1;
  std::pair<double, double> best{-1.0, peak_km};
  for (double h = peak_km - 3.0 * lower_width_km; h <= peak_km + upper_width_km; h += kStepKm)
    best = std::max(best, {column_km(h, peak_km, lower_width_km, upper_width_km, top_km), h});
  return best.second;
}

}  // namespace

std::optional<LimbLayer> find_limb_layer(const std::vector<double>& tangent_km,
                                         const std::vector<double>& light, double observer_km) {
  LayerPoints points = usable(tangent_km, light, observer_km);
  if (points.light.size() < kLayerMinPoints) return std::nullopt;
  const auto [darkest, brightest] = std::minmax_element(points.light.begin(), points.light.end());
  const double at_km = points.tangent_km[brightest - points.light.begin()];
  const auto [lowest, highest] = std::minmax_element(points.tangent_km.begin(), points.tangent_km.end());
  if (!(*brightest > *darkest) || at_km == *lowest || at_km == *highest) return std::nullopt;
  points.scale = *brightest - *darkest;

  double numbers[kNumbers] = {at_km, std::log(kStartWidthKm), std::log(kStartWidthKm), 0.0,
                              *darkest / points.scale};
  numbers[3] = 1.0 / column_km(at_km, at_km, kStartWidthKm, kStartWidthKm, points.top_km);
  ceres::Problem problem;
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<LayerCost, ceres::DYNAMIC, kNumbers>(
                               new LayerCost{points}, static_cast<int>(points.light.size())),
                           nullptr, numbers);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-12;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable() || !(numbers[3] > 0.0) || numbers[0] <= *lowest || numbers[0] >= *highest)
    return std::nullopt;

  double cost = 0.0;
  ceres::CRSMatrix jacobian;
  problem.Evaluate({}, &cost, nullptr, nullptr, &jacobian);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(jacobian.num_rows, jacobian.num_cols);
  for (int row = 0; row < jacobian.num_rows; ++row)
    for (int k = jacobian.rows[row]; k < jacobian.rows[row + 1]; ++k)
      dense(row, jacobian.cols[k]) = jacobian.values[k];
  const double n = static_cast<double>(points.light.size());
  const Eigen::MatrixXd covariance =
      sim::inverse_of(dense.transpose() * dense) * (2.0 * cost / std::max(1.0, n - kNumbers));

  LimbLayer layer;
  const double lower = std::exp(numbers[1]), upper = std::exp(numbers[2]);
  layer.peak_km = numbers[0];
  layer.sigma_peak_km = std::sqrt(covariance(0, 0));
  layer.lower_km = numbers[0] - kHalf * lower;
  layer.upper_km = numbers[0] + kHalf * upper;
  layer.apparent_peak_km = apparent_peak_km(numbers[0], lower, upper, points.top_km);
  const double most = numbers[3] * column_km(layer.apparent_peak_km, numbers[0], lower, upper, points.top_km);
  layer.light = most * points.scale;
  layer.sky = numbers[4] * points.scale;
  layer.rms_over_light = std::sqrt(2.0 * cost / n) / most;
  return layer;
}

double limb_column_km(double tangent_km, double peak_km, double lower_km, double upper_km) {
  const double lower = (peak_km - lower_km) / kHalf, upper = (upper_km - peak_km) / kHalf;
  return column_km(tangent_km, peak_km, lower, upper, peak_km + kLayerReach * upper);
}

}  // namespace vegard::fit
