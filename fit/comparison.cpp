#include "fit/comparison.h"

#include <utility>

namespace vegard::fit {
namespace {

/// Derivatives by numbers, [value][number], become those by what moves the numbers.
void contract(std::vector<double>& derivative, std::size_t values, const std::vector<double>& slopes,
              std::size_t numbers, std::size_t moved) {
  if (derivative.empty()) return;
  std::vector<double> by_moved(values * moved, 0.0);
  for (std::size_t i = 0; i < values; ++i)
    for (std::size_t k = 0; k < numbers; ++k) {
      const double by_number = derivative[i * numbers + k];
      if (by_number == 0.0) continue;
      for (std::size_t j = 0; j < moved; ++j) by_moved[i * moved + j] += by_number * slopes[k * moved + j];
    }
  derivative = std::move(by_moved);
}

}  // namespace

GainLayout gain_layout(const sim::Scene& scene) {
  return {scene.fit.bands, scene.fit.band_brightness, !scene.fit.white_balance_known};
}

Comparison::Comparison(const sim::Scene& scene, const Photo& photo, Profile data, std::vector<double> sigma,
                       const Resolution& resolution)
    : data_(std::move(data)),
      sigma_(std::move(sigma)),
      gains_(gain_layout(scene)),
      linear_(data_, sigma_, gains_, scene.fit.sky_terms, photo.linear.height),
      model_(scene, photo, data_.region, data_.bands, resolution.beams_share, resolution.smooth_rows,
             resolution.threads) {}

Comparison::Point Comparison::at(const sim::Scene& scene) {
  Point point;
  model_.evaluate(scene, point.aurora);
  point.solution = linear_.solve(point.aurora);
  point.chi2 = point.solution.chi2;
  return point;
}

Comparison::Point Comparison::at(const sim::Scene& scene, const ParameterMap::Motion& motion) {
  Point point;
  if (motion.numbers.empty()) {
    // What moves is nothing of this photograph's.
    model_.evaluate(scene, point.aurora);
    point.aurora.free = static_cast<int>(motion.moved);
    point.aurora.derivative.assign(point.aurora.value.size() * motion.moved, 0.0);
    point.aurora.offset_derivative.assign(point.aurora.offset.size() * motion.moved, 0.0);
  } else {
    model_.evaluate_with_derivatives(scene, motion.numbers, point.aurora);
  }
  if (!motion.slopes.empty()) {
    const std::size_t values = point.aurora.value.size(), numbers = motion.numbers.size();
    const std::size_t moved = motion.moved;
    contract(point.aurora.derivative, values, motion.slopes, numbers, moved);
    contract(point.aurora.offset_derivative, values, motion.slopes, numbers, moved);
    point.aurora.free = static_cast<int>(moved);
  }
  point.solution = linear_.solve(point.aurora);
  point.chi2 = point.solution.chi2;
  return point;
}

void Comparison::jacobian(const Point& point, std::vector<double>& out) const {
  linear_.jacobian(point.aurora, point.solution, out);
}

}  // namespace vegard::fit
