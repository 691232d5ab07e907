#include "fit/scene_cost.h"

#include <cassert>

#include "fit/fit_observations.h"
#include "fit/search/profile_rounds.h"

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

bool SceneCost::evaluate(const std::vector<double>& values, double* residuals, double* jacobian) const {
  assert(values.size() == free_.size());
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
