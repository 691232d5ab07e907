#include "fit/compare/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

Comparison::Comparison(const sim::Scene& scene, const Photo& photo, Profile data, std::vector<double> sigma,
                       const Resolution& resolution)
    : statistics_(std::make_shared<const Statistics>(
          scene, photo, std::move(data), std::move(sigma), resolution.smooth_rows,
          resolution.model_error.value_or(Statistics::ModelError{scene.fit.model_error}),
          resolution.threads)),
      gains_(gain_layout(scene)),
      model_(scene, photo, statistics_->grids(), resolution.beams_share, resolution.smooth_rows,
             resolution.threads, resolution.sampling, resolution.fineness) {}

Comparison::Comparison(const sim::Scene& scene, const Photo& photo, const Comparison& like,
                       const Resolution& resolution)
    : statistics_(like.statistics_),
      gains_(like.gains_),
      model_(scene, photo, statistics_->grids(), resolution.beams_share, resolution.smooth_rows,
             resolution.threads, resolution.sampling, resolution.fineness) {}

Comparison::Point Comparison::at(const sim::Scene& scene) {
  Point point;
  model_.evaluate(scene, point.aurora);
  point.solution = linear().solve(point.aurora);
  evaluate_others(scene, {}, point);
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
  point.solution = linear().solve(point.aurora);
  evaluate_others(scene, motion, point);
  return point;
}

void Comparison::evaluate_others(const sim::Scene& scene, const ParameterMap::Motion& motion,
                                 Point& point) const {
  if (statistics_->linear_counts()) {
    point.whitened = point.solution.residual;
    point.chi2 = point.solution.chi2;
  }
  if (statistics_->others().empty()) return;
  std::size_t first = point.whitened.size();
  const std::size_t of_others = residuals() - first, free = point.aurora.free;
  point.whitened.resize(residuals());
  const SolvedLight light = linear().light(point.aurora, point.solution, data().mean.size());
  const StatisticInput input{light, scene, motion.numbers, motion.slopes};
  const bool with_derivatives = free > 0 && !point.aurora.derivative.empty();
  if (with_derivatives) point.jacobian_of_others.resize(of_others * free);
  double* jacobian = with_derivatives ? point.jacobian_of_others.data() : nullptr;
  for (const Statistics::Other& other : statistics_->others()) {
    const std::size_t count = other.statistic->residuals();
    other.statistic->evaluate(input, point.whitened.data() + first, jacobian);
    for (std::size_t k = first; k < first + count; ++k) point.chi2 += point.whitened[k] * point.whitened[k];
    first += count;
    if (jacobian != nullptr) jacobian += count * free;
  }
}

void Comparison::jacobian(const Point& point, std::vector<double>& out) const {
  out.clear();
  if (statistics_->linear_counts()) linear().jacobian(point.aurora, point.solution, out);
  out.insert(out.end(), point.jacobian_of_others.begin(), point.jacobian_of_others.end());
}

Comparison::ProfilePart Comparison::profile_part(const Point& point) const {
  ProfilePart part;
  if (!statistics_->profile_counts()) return part;
  for (const std::size_t i : linear().used())
    if (i < data().mean.size()) part.used.push_back(i);
  part.residual.assign(point.solution.residual.begin(),
                       point.solution.residual.begin() + static_cast<std::ptrdiff_t>(part.used.size()));
  return part;
}

Inflation Comparison::error_inflation(const Point& point, int dof) const {
  const auto count = static_cast<double>(point.whitened.size());
  if (!statistics_->looks_at_the_profile()) return {residual_scale(point.chi2, dof, count, 1.0), 1.0};
  const ProfilePart part = profile_part(point);
  if (part.used.size() == point.whitened.size())
    return fit::error_inflation(data(), part.used, part.residual, dof);
  // The correlation of residuals is the profile's to say, compared or not.
  std::vector<std::size_t> used;
  std::vector<double> residual;
  const std::vector<double> model = profile_model(point);
  for (std::size_t i = 0; i < model.size(); ++i) {
    if (sigma()[i] <= 0.0) continue;
    used.push_back(i);
    residual.push_back((data().mean[i] - model[i]) / sigma()[i]);
  }
  const double correlated = correlated_residuals(data(), used, residual);
  return {residual_scale(point.chi2, dof, count, correlated), correlated};
}

std::vector<double> Comparison::profile_model(const Point& point) const {
  std::vector<double> model = linear().model(point.aurora, point.solution);
  model.resize(data().mean.size());
  return model;
}

int Comparison::held_gains(const Point& point) const {
  if (!statistics_->linear_counts()) return 0;
  return static_cast<int>(std::count(point.solution.held.begin(), point.solution.held.end(), true));
}

double Comparison::chi2_without_aurora(const Point& point) const {
  if (!statistics_->looks_at_the_profile()) return std::numeric_limits<double>::infinity();
  ModelProfile dark;
  dark.value.assign(point.aurora.value.size(), 0.0);
  dark.offset = point.aurora.offset;
  const double linear_chi2 = linear().solve(dark).chi2;
  if (statistics_->linear_counts() && statistics_->others().empty()) return linear_chi2;
  return point.chi2 - point.solution.chi2 + linear_chi2;
}

std::vector<Statistic::Solved> Comparison::solved_by_statistics(const sim::Scene& scene) const {
  std::vector<Statistic::Solved> all;
  for (const Statistics::Other& other : statistics_->others())
    for (Statistic::Solved& solved : other.statistic->solved(scene)) all.push_back(std::move(solved));
  return all;
}

std::vector<Comparison::Share> Comparison::shares(const Point& point) const {
  std::vector<Share> all;
  const std::vector<std::size_t>& used = linear().used();
  for (const Statistics::Linear& one : statistics_->linear_ones()) {
    Share share{facts_of(one.kind).name, one.weight};
    for (std::size_t k = 0; k < used.size(); ++k) {
      if (used[k] < one.first || used[k] >= one.first + one.values) continue;
      ++share.residuals;
      share.chi2 += point.solution.residual[k] * point.solution.residual[k];
    }
    all.push_back(share);
  }
  std::size_t k = statistics_->linear_counts() ? used.size() : 0;
  for (const Statistics::Other& other : statistics_->others()) {
    Share share{facts_of(other.kind).name, other.weight, static_cast<int>(other.statistic->residuals())};
    for (const std::size_t end = k + other.statistic->residuals(); k < end; ++k)
      share.chi2 += point.whitened[k] * point.whitened[k];
    all.push_back(share);
  }
  return all;
}

}  // namespace vegard::fit
