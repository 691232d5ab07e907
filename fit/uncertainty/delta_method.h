// Error bars of numbers that are derived from a fit's free ones, to first order: sigma^2 = g^T C g, with g
// the derivatives by the free numbers and C their covariance (the delta method; JCGM 100:2008, "GUM", 5.2.2).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "fit/parameters/free_parameters.h"
#include "fit/parameters/parameter_map.h"
#include "fit/uncertainty/uncertainty.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// The uncertainty of the free numbers, in their own units.
struct ValueUncertainty {
  std::vector<std::vector<double>> covariance;    ///< within the directions that the data determine
  std::vector<std::vector<double>> undetermined;  ///< directions that the data do not determine
  std::vector<ModeShift> modes{};                 ///< considered in the covariance
};

/// Returns the error bar of a number with the derivatives `slopes` by the free numbers; none if the number
/// changes along an undetermined direction, or depends on no free number. `by_mode`: its derivatives by the
/// coefficients of `known.modes` for fixed free numbers; empty: all 0.
std::optional<double> combined_sigma(const std::vector<double>& slopes, const ValueUncertainty& known,
                                     const std::vector<double>& by_mode = {});

/// Computes derived numbers of a scene with their error bars. Derivatives are central differences over a
/// tenth of a standard deviation to either side: wide enough for height profiles, whose samples are floats,
/// and short enough that the error is below a hundredth for numbers that are curved on the scale of a
/// standard deviation. At a limit the difference is one-sided. A number that depends on free ones and on the
/// emission tables changes with each mode of their uncertainty twice, by itself and by the answer's shift;
/// the sum counts. The constructor's arguments must outlive the object.
class DeltaMethod {
 public:
  DeltaMethod(const sim::Scene& best, const std::vector<FreeNumber>& free, const std::vector<double>& values,
              const ValueUncertainty& known);

  struct Estimate {
    double value = 0.0;
    std::optional<double> sigma;
    bool moves = false;  ///< it depends on at least one of the free numbers
    /// If undetermined directions leave no sigma: the sigma for a uniform distribution along each of these
    /// directions between the limits of the free numbers. None if no limit bounds one of the directions.
    std::optional<double> within_limits{};
    /// For each free number, slope² × its variance over the variance of this number: its share if all others
    /// were known. For correlated numbers the shares do not add up to 1. Empty without an error bar.
    std::vector<double> share{};
    /// Changes by one standard deviation of each of `known.modes`, by itself and by the answer's shift.
    std::vector<double> by_mode{};
  };
  using Numbers = std::function<std::vector<double>(const sim::Scene&)>;

  /// Estimates all of `numbers` at once, which must return the same count for every scene.
  std::vector<Estimate> operator()(const Numbers& numbers) const;

 private:
  std::optional<double> within_limits(const std::vector<double>& slope,
                                      const std::vector<double>& by_mode) const;
  std::vector<std::vector<double>> by_modes(const Numbers& numbers, std::size_t count) const;

  const sim::Scene& best_;
  const std::vector<FreeNumber>& free_;
  const std::vector<double>& values_;
  const ValueUncertainty& known_;
  ParameterMap map_;
};

}  // namespace vegard::fit
