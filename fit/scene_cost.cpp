#include "fit/scene_cost.h"

#include <cassert>
#include <cmath>

#include "fit/fit_observations.h"
#include "fit/search/profile_rounds.h"
#include "sim/scene/rows/value_words.h"

namespace vegard::fit {

SceneCost::SceneCost(const sim::Scene& given, const std::vector<const Photo*>& photos, int threads)
    : free_(free_numbers(given)) {
  const sim::Scene scene = with_ties(given, free_);
  observations_ = observations_of(scene, free_, photos, threads);
  cost_ = std::make_unique<ProfileCost>(
      free_, cost_terms(observations_, free_, Detail::full), log_,
      ProfileCost::Options{{}, {}, spline_prior(scene, free_, first_smoothness(scene)), kFirstPriorWeight});
}

std::vector<double> SceneCost::start() const {
  std::vector<double> values;
  for (const FreeNumber& number : free_) values.push_back(number.start);
  return values;
}

std::string SceneCost::beyond_limits(const std::vector<double>& values) const {
  for (std::size_t j = 0; j < free_.size(); ++j) {
    const FreeNumber& number = free_[j];
    if (values[j] >= number.min && values[j] <= number.max) continue;
    const std::string is = number.label() + " = " + sim::short_real_text(values[j]) + " is ";
    if (!std::isfinite(number.max)) return is + "less than " + sim::short_real_text(number.min);
    if (!std::isfinite(number.min)) return is + "more than " + sim::short_real_text(number.max);
    return is + "not within " + sim::short_real_text(number.min) + " to " + sim::short_real_text(number.max);
  }
  return {};
}

bool SceneCost::evaluate(const std::vector<double>& values, double* residuals, double* jacobian) const {
  assert(values.size() == free_.size() && beyond_limits(values).empty());
  std::vector<double> coordinates;
  for (std::size_t j = 0; j < free_.size(); ++j) coordinates.push_back(free_[j].coordinate(values[j]));
  const double* parameters[] = {coordinates.data()};
  double* jacobians[] = {jacobian};
  log_ = {};  // nobody's search: it has no limit of evaluations
  if (!cost_->Evaluate(parameters, residuals, jacobian == nullptr ? nullptr : jacobians)) return false;
  if (jacobian == nullptr) return true;
  std::vector<double> by_value;
  for (std::size_t j = 0; j < free_.size(); ++j) by_value.push_back(1.0 / free_[j].slope(coordinates[j]));
  const auto rows = static_cast<std::size_t>(this->residuals());
  for (std::size_t k = 0; k < rows; ++k)
    for (std::size_t j = 0; j < free_.size(); ++j) jacobian[k * free_.size() + j] *= by_value[j];
  return true;
}

}  // namespace vegard::fit
