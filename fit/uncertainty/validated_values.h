// Conversion from the solver's coordinates to the parameters' own units, for the validation of error bars.
#pragma once

#include <vector>

#include "fit/parameters/free_parameters.h"
#include "fit/uncertainty/band_bootstrap.h"
#include "fit/uncertainty/profile_likelihood.h"
#include "fit/uncertainty/validated_errors.h"
#include "sim/base/number/chain/ensemble_sampler.h"

namespace vegard::fit {

/// The answer in coordinates and in the values that the result reports.
struct ReportedValues {
  const std::vector<FreeNumber>& free;
  std::vector<double> answer;  ///< coordinates
  std::vector<double> values;  ///< values as the result reports them: an angle may differ by whole turns

  double value(std::size_t j, double coordinate) const;
};

ProfiledInterval in_values(const LikelihoodProfile& profile, const ReportedValues& reported);
BootstrapErrors in_values(const BandBootstrap& bootstrap, const ReportedValues& reported);
ChainErrors in_values(const sim::EnsembleState& state, int burn_in, const ReportedValues& reported);

/// Returns the logarithm of the density, in coordinates, of a prior that is flat between a number's limits in
/// its value, or in the value's logarithm for a logarithmic number; 0 (an improper prior) for a number with
/// an open side. A chain must add it to -chi2 / 2: limits are at infinity in coordinates, so that with a flat
/// density in coordinates walkers would diverge along all directions that the data do not bound.
double log_flat_prior(const std::vector<FreeNumber>& free, const std::vector<double>& coordinates);

}  // namespace vegard::fit
