#include "fit/answer/result_numbers.h"

namespace vegard::fit {

const std::vector<ResultNumber>& result_numbers() {
  using Group = ResultGroup;
  using Form = ResultForm;
  using R = const FitResult&;
  using Value = std::optional<double>;
  static const std::vector<ResultNumber> numbers = {
      {"chi2", "chi2 of the full model", Group::misfit, Form::number, [](R r) -> Value { return r.chi2; },
       nullptr},
      {"chi2_initial", "chi2 at the start", Group::misfit, Form::number,
       [](R r) -> Value { return r.chi2_initial; }, nullptr},
      {"dof", "degrees of freedom", Group::misfit, Form::count, [](R r) -> Value { return r.dof; }, nullptr,
       "Degrees of freedom", "Residuals, less the numbers that were fitted or solved for."},
      {"gradient_cosine", nullptr, Group::convergence, Form::number,
       [](R r) -> Value { return r.gradient_cosine; }, nullptr},
      {"rms_over_peak", "rms residual over the peak of the profile", Group::errors, Form::share,
       [](R r) -> Value { return r.rms_over_peak; }, nullptr, "rms / peak",
       "Root mean square of the residuals over all rows, bands and channels, as a share of the "
       "profile\u2019s peak above the sky."},
      {"model_error", "share of the light that the model misses", Group::errors, Form::share,
       [](R r) { return r.photos.front().model_error; }, [](R r) { return r.photos.size() == 1; }},
      {"error_inflation", "factor that the standard errors contain", Group::errors, Form::factor,
       [](R r) -> Value { return r.error_inflation; }, nullptr, "Error inflation",
       "Error bars are those of independent residuals with the errors assumed, times this: residuals in "
       "neighbouring rows and bands are alike, and as large as \u03c7\u00b2 says."},
      {"correlated_residuals", nullptr, Group::errors, Form::number,
       [](R r) -> Value { return r.correlated_residuals; }, nullptr},
      {"evaluations", nullptr, Group::effort, Form::count, [](R r) -> Value { return r.evaluations; },
       nullptr},
      {"jacobian_evaluations", nullptr, Group::effort, Form::count,
       [](R r) -> Value { return r.jacobian_evaluations; }, nullptr},
  };
  return numbers;
}

}  // namespace vegard::fit
