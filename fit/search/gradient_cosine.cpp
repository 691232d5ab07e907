#include "fit/search/gradient_cosine.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vegard::fit {

double gradient_cosine(const ceres::CostFunction& cost, const std::vector<double>& coordinates,
                       const std::vector<bool>& left_out) {
  const auto rows = static_cast<std::size_t>(cost.num_residuals());
  const std::size_t n = coordinates.size();
  std::vector<double> residuals(rows), jacobian(rows * n);
  const double* parameters[] = {coordinates.data()};
  double* jacobians[] = {jacobian.data()};
  if (!cost.Evaluate(parameters, residuals.data(), jacobians))
    return std::numeric_limits<double>::quiet_NaN();
  double chi2 = 0.0;
  for (const double r : residuals) chi2 += r * r;
  double steepest = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t j = 0; j < n; ++j) {
    if (j < left_out.size() && left_out[j]) continue;
    double along = 0.0, square = 0.0;
    for (std::size_t k = 0; k < rows; ++k) {
      along += jacobian[k * n + j] * residuals[k];
      square += jacobian[k * n + j] * jacobian[k * n + j];
    }
    if (square > 0.0 && chi2 > 0.0)
      steepest = std::fmax(steepest, std::abs(along) / std::sqrt(square * chi2));
  }
  return steepest;
}

double gradient_cosine(const ProfileCost& cost, const std::vector<double>& values) {
  std::vector<double> coordinates;
  std::vector<bool> at_limit;
  for (std::size_t j = 0; j < values.size(); ++j) {
    coordinates.push_back(cost.moved()[j].coordinate(values[j]));
    at_limit.push_back(cost.moved()[j].at_limit(values[j]));
  }
  return gradient_cosine(cost, coordinates, at_limit);
}

}  // namespace vegard::fit
