// Error bars of numbers that follow from a fit's free ones, to first order: sigma^2 = g^T C g, g the slopes
// by the free numbers and C their covariance (the delta method; JCGM 100:2008, "GUM", 5.2.2).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "fit/parameters/free_parameters.h"
#include "fit/parameters/parameter_map.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// What the error bars of derived numbers are made from, in the free numbers' own units.
struct ValueUncertainty {
  std::vector<std::vector<double>> covariance;    ///< inside what the data determine
  std::vector<std::vector<double>> undetermined;  ///< directions in which they say nothing
};

/// The error bar of a number with these slopes by the free numbers; none if it would change along an
/// undetermined direction, or does not depend on any.
std::optional<double> combined_sigma(const std::vector<double>& slopes, const ValueUncertainty& known);

/// Numbers of a scene with their error bars. Slopes are central differences over a tenth of a standard
/// deviation to either side: wide enough for height profiles, whose samples are floats, and short enough that
/// what bends on the scale of a whole standard deviation is off by less than a hundredth. At a limit the step
/// goes to one side only. What it is given must outlive it.
class DeltaMethod {
 public:
  DeltaMethod(const sim::Scene& best, const std::vector<FreeNumber>& free, const std::vector<double>& values,
              const ValueUncertainty& known);

  struct Estimate {
    double value = 0.0;
    std::optional<double> sigma;
    bool moves = false;  ///< with any of the free numbers
    /// Where there is no sigma because of undetermined directions: what it is if all places along each of
    /// them are alike likely between the limits of the free numbers. None where no limit bounds one.
    std::optional<double> within_limits{};
    /// Of each free number, slope² × its variance over the variance of this number: as if all others were
    /// known. Of numbers that are correlated these do not add up to 1. Empty without an error bar.
    std::vector<double> share{};
  };
  using Numbers = std::function<std::vector<double>(const sim::Scene&)>;

  /// All of `numbers` at once; it must give as many of any scene.
  std::vector<Estimate> operator()(const Numbers& numbers) const;

 private:
  std::optional<double> within_limits(const std::vector<double>& slope) const;

  const sim::Scene& best_;
  const std::vector<FreeNumber>& free_;
  const std::vector<double>& values_;
  const ValueUncertainty& known_;
  ParameterMap map_;
};

}  // namespace vegard::fit
