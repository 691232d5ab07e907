#include "fit/derivative_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/scene_cost.h"

namespace vegard::fit {
namespace {

/// Measured over all numbers that can be free: 2 %, 5 % for the two pitch angles, whose effect is ten
/// thousand times less than that of the sheet's place (tests/fit/profile_cost_test.cpp).
constexpr double kAgree = 0.05;
constexpr double kNoEffect = 0.1;  // sigma, of all residuals together, by a whole natural step

double length(const std::vector<double>& v) {
  double square = 0.0;
  for (const double x : v) square += x * x;
  return std::sqrt(square);
}

/// Residuals at a point; empty if the cost cannot be evaluated there.
std::vector<double> residuals_at(const ceres::CostFunction& cost, const std::vector<double>& point) {
  std::vector<double> residuals(static_cast<std::size_t>(cost.num_residuals()));
  const double* parameters[] = {point.data()};
  if (!cost.Evaluate(parameters, residuals.data(), nullptr)) residuals.clear();
  return residuals;
}

/// Central difference by coordinate j; empty if there is none.
std::vector<double> difference(const ceres::CostFunction& cost, const std::vector<double>& point,
                               std::size_t j, double step) {
  std::vector<double> more = point, less = point;
  more[j] += step;
  less[j] -= step;
  std::vector<double> up = residuals_at(cost, more);
  const std::vector<double> down = residuals_at(cost, less);
  if (up.empty() || down.empty()) return {};
  const double way = more[j] - less[j];  // what rounding has left of twice the step
  for (std::size_t k = 0; k < up.size(); ++k) up[k] = (up[k] - down[k]) / way;
  return up;
}

DerivativeCheck checked(const ceres::CostFunction& cost, const std::vector<double>& point, std::size_t j,
                        const std::vector<double>& column, const CheckedCoordinate& coordinate) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  DerivativeCheck check;
  check.name = coordinate.name;
  const double size = length(column);
  check.effect = size * coordinate.natural_step;
  check.best_difference = std::numeric_limits<double>::infinity();
  double longest_effect = kUnknown;  // by the longest step that could be taken, where rounding counts least
  for (const double share : derivative_steps()) {
    std::vector<double> by_difference = difference(cost, point, j, share * coordinate.natural_step);
    check.differences.push_back(kUnknown);
    if (by_difference.empty()) continue;
    const double difference_size = length(by_difference);
    if (std::isnan(longest_effect)) longest_effect = difference_size * coordinate.natural_step;
    for (std::size_t k = 0; k < column.size(); ++k) by_difference[k] -= column[k];
    const double longer = std::max(size, difference_size);
    // Of no numbers nothing is near.
    const double relative = longer == 0.0 ? 0.0 : length(by_difference) / longer;
    check.differences.back() = relative;
    if (relative < check.best_difference) {
      check.best_difference = relative;
      check.best_step = share;
    }
  }
  if (check.effect < kNoEffect && longest_effect < kNoEffect)
    check.verdict = DerivativeVerdict::no_effect;
  else if (check.best_difference <= kAgree)
    check.verdict = DerivativeVerdict::agree;
  return check;
}

}  // namespace

const char* derivative_verdict_name(DerivativeVerdict verdict) {
  switch (verdict) {
    case DerivativeVerdict::agree:
      return "agree";
    case DerivativeVerdict::differ:
      return "differ";
    case DerivativeVerdict::no_effect:
      return "no effect";
  }
  return "";
}

const std::vector<double>& derivative_steps() {
  static const std::vector<double> steps = {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5};
  return steps;
}

std::vector<DerivativeCheck> check_derivatives(const ceres::CostFunction& cost,
                                               const std::vector<CheckedCoordinate>& coordinates,
                                               const std::function<void(double share)>& told,
                                               const std::atomic<bool>* stop) {
  const std::size_t n = coordinates.size();
  const auto rows = static_cast<std::size_t>(cost.num_residuals());
  std::vector<double> point, residuals(rows), jacobian(rows * n);
  for (const CheckedCoordinate& coordinate : coordinates) point.push_back(coordinate.at);
  const double* parameters[] = {point.data()};
  double* jacobians[] = {jacobian.data()};
  std::vector<DerivativeCheck> checks;
  const bool evaluated = cost.Evaluate(parameters, residuals.data(), jacobians);
  for (std::size_t j = 0; j < n && !(stop != nullptr && stop->load()); ++j) {
    std::vector<double> column(rows, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t k = 0; evaluated && k < rows; ++k) column[k] = jacobian[k * n + j];
    checks.push_back(checked(cost, point, j, column, coordinates[j]));
    if (told) told(static_cast<double>(j + 1) / static_cast<double>(n));
  }
  return checks;
}

std::vector<DerivativeCheck> check_derivatives(const sim::Scene& scene, const Photo& photo, int threads,
                                               const std::function<void(double share)>& told,
                                               const std::atomic<bool>* stop) {
  const SceneCost cost(scene, {&photo}, threads);
  std::vector<CheckedCoordinate> coordinates;
  for (const FreeNumber& number : cost.free()) {
    CheckedCoordinate coordinate;
    coordinate.name = number.label();
    coordinate.at = number.coordinate(number.start);
    coordinate.natural_step =
        (number.logarithmic() ? number.value(coordinate.at) : 1.0) / number.slope(coordinate.at);
    coordinates.push_back(coordinate);
  }
  return check_derivatives(cost.cost(), coordinates, told, stop);
}

}  // namespace vegard::fit
