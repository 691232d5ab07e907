#include "fit/compare/inflation.h"

#include <cmath>

namespace vegard::fit {

double joint_inflation(const ProfileCost& cost, const ProfileCost::Point& point, int unknowns) {
  double sum = 0.0;
  for (std::size_t t = 0; t < cost.terms().size(); ++t) {
    const Comparison& of = *cost.terms()[t].comparison;
    const double share = static_cast<double>(of.residuals()) / cost.data_residuals();
    const int dof = of.residuals() - static_cast<int>(std::lround(share * unknowns));
    sum += share * std::pow(of.error_inflation(point.of_photo[t], dof), 2);
  }
  return std::sqrt(sum);
}

}  // namespace vegard::fit
