#include "fit/uncertainty/delta_method.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/light/tables/emission_tables.h"

namespace vegard::fit {
namespace {

constexpr double kDeltaStep = 0.1;     // of a standard deviation
constexpr double kStepWithout = 1e-4;  // of the value, or of one unit, where there is none

double variance_of(const std::vector<double>& slope, const ValueUncertainty& known,
                   const std::vector<double>& by_mode) {
  double variance = 0.0;
  for (std::size_t j = 0; j < slope.size(); ++j)
    for (std::size_t k = 0; k < slope.size(); ++k)
      if (slope[j] != 0.0 && slope[k] != 0.0) variance += slope[j] * slope[k] * known.covariance[j][k];
  // The covariance has what the modes do by way of the free numbers: instead, all that they do.
  double by_numbers = 0.0, by_all = 0.0;
  for (std::size_t m = 0; m < by_mode.size(); ++m) {
    double shift = 0.0;
    for (std::size_t j = 0; j < slope.size(); ++j)
      if (slope[j] != 0.0) shift += slope[j] * known.modes[m].shift[j];
    by_numbers += shift * shift;
    by_all += (shift + by_mode[m]) * (shift + by_mode[m]);
  }
  return by_mode.empty() ? variance : std::max(0.0, variance - by_numbers) + by_all;
}

/// The standard deviation of a place along a direction, in its lengths, all between the limits alike likely.
double spread_along(const std::vector<double>& direction, const std::vector<FreeNumber>& free,
                    const std::vector<double>& values) {
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t j = 0; j < direction.size(); ++j) {
    if (direction[j] == 0.0) continue;
    const double a = (free[j].min - values[j]) / direction[j], b = (free[j].max - values[j]) / direction[j];
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  }
  return (high - low) / std::sqrt(12.0);
}

}  // namespace

std::optional<double> combined_sigma(const std::vector<double>& slope, const ValueUncertainty& known,
                                     const std::vector<double>& by_mode) {
  const double variance = variance_of(slope, known, by_mode);
  // A direction that only the limits bound spoils what owes it half of its variance.
  const auto spoils = [&](const std::vector<double>& direction) {
    double reach = std::numeric_limits<double>::infinity(), along = 0.0;
    for (std::size_t j = 0; j < slope.size(); ++j) {
      if (direction[j] == 0.0) continue;
      reach = std::min(reach, std::sqrt(std::max(0.0, known.covariance[j][j])) / std::abs(direction[j]));
      along += slope[j] * direction[j];
    }
    return std::isfinite(reach) && along * along * reach * reach > 0.5 * variance;
  };
  if (std::any_of(known.undetermined.begin(), known.undetermined.end(), spoils)) return std::nullopt;
  if (!std::isfinite(variance) || variance <= 0.0) return std::nullopt;
  return std::sqrt(variance);
}

DeltaMethod::DeltaMethod(const sim::Scene& best, const std::vector<FreeNumber>& free,
                         const std::vector<double>& values, const ValueUncertainty& known)
    : best_(best), free_(free), values_(values), known_(known), map_(best, free) {}

std::vector<DeltaMethod::Estimate> DeltaMethod::operator()(const Numbers& numbers) const {
  std::vector<Estimate> result;
  for (const double value : numbers(best_)) result.push_back({value, {}, false, {}});
  std::vector<std::vector<double>> slopes(result.size(), std::vector<double>(free_.size(), 0.0));
  for (std::size_t j = 0; j < free_.size(); ++j) {
    const double variance = known_.covariance[j][j];
    const double step = std::isfinite(variance) && variance > 0.0
                            ? kDeltaStep * std::sqrt(variance)
                            : kStepWithout * std::max(1.0, std::abs(values_[j]));
    const double low = std::clamp(values_[j] - step, free_[j].min, free_[j].max);
    const double high = std::clamp(values_[j] + step, free_[j].min, free_[j].max);
    if (!(high > low)) continue;
    const auto at = [&](double value) {
      sim::Scene moved = best_;
      std::vector<double> v = values_;
      v[j] = value;
      map_.put(v, moved);
      return numbers(moved);
    };
    const std::vector<double> above = at(high), below = at(low);
    for (std::size_t i = 0; i < result.size(); ++i) {
      slopes[i][j] = (above[i] - below[i]) / (high - low);
      result[i].moves = result[i].moves || slopes[i][j] != 0.0;
    }
  }
  const std::vector<std::vector<double>> by_mode = by_modes(numbers, result.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const std::vector<double> by_modes_too = result[i].moves ? by_mode[i] : std::vector<double>();
    result[i].sigma = combined_sigma(slopes[i], known_, by_modes_too);
    for (std::size_t m = 0; m < by_modes_too.size(); ++m) {
      double change = by_modes_too[m];
      for (std::size_t j = 0; j < free_.size(); ++j)
        if (slopes[i][j] != 0.0) change += slopes[i][j] * known_.modes[m].shift[j];
      result[i].by_mode.push_back(change);
    }
    if (!result[i].sigma) {
      result[i].within_limits = within_limits(slopes[i], by_modes_too);
      continue;
    }
    for (std::size_t j = 0; j < free_.size(); ++j)
      result[i].share.push_back(slopes[i][j] * slopes[i][j] * known_.covariance[j][j] /
                                (*result[i].sigma * *result[i].sigma));
  }
  return result;
}

/// Derivatives of each number by the modes' coefficients, for fixed free numbers.
std::vector<std::vector<double>> DeltaMethod::by_modes(const Numbers& numbers, std::size_t count) const {
  std::vector<std::vector<double>> slopes(count);
  for (const ModeShift& mode : known_.modes) {
    const auto at = [&](double step) {
      sim::Scene moved = best_;
      sim::add_to_mode(moved, mode.mode, step);
      return numbers(moved);
    };
    const std::vector<double> above = at(kDeltaStep), below = at(-kDeltaStep);
    for (std::size_t i = 0; i < count; ++i) slopes[i].push_back((above[i] - below[i]) / (2.0 * kDeltaStep));
  }
  return slopes;
}

std::optional<double> DeltaMethod::within_limits(const std::vector<double>& slope,
                                                 const std::vector<double>& by_mode) const {
  double variance = variance_of(slope, known_, by_mode);
  for (const std::vector<double>& direction : known_.undetermined) {
    double along = 0.0;
    for (std::size_t j = 0; j < slope.size(); ++j) along += slope[j] * direction[j];
    if (along != 0.0) variance += std::pow(along * spread_along(direction, free_, values_), 2);
  }
  if (!std::isfinite(variance) || variance <= 0.0) return std::nullopt;
  return std::sqrt(variance);
}

}  // namespace vegard::fit
