// The noise model: the standard deviation of a profile's values about the true model.
#pragma once

#include <optional>
#include <vector>

#include "fit/measure/profile.h"

namespace vegard::fit {

/// Returns the brightness of the sky per channel, estimated as the 5th percentile of the profile. The
/// aurora's brightness is measured above this level, here and where a residual is given as a fraction of the
/// peak.
std::array<double, 3> sky_level(const Profile& profile);

/// Returns the peak of the profile above its sky, over all rows, bands and channels.
double profile_peak(const Profile& profile);

/// Returns the standard deviation of every profile value, indexed as in Profile; 0 marks a value that is not
/// used (no pixels). It has three parts, added in quadrature: the photograph's noise
/// (Profile::standard_error); `model_error` times the local brightness above the sky, for structure that the
/// model omits (rays, uneven arcs); and `model_error` times `peak_share` times the channel's peak, for the
/// effect of such structure where the profile is steep and dark.
std::vector<double> profile_sigma(const Profile& profile, double model_error, double peak_share);
/// As above, with a peak share of 0.1.
std::vector<double> profile_sigma(const Profile& profile, double model_error);

/// Estimates the model error from the data: returns the value that, in place of the `model_error` with which
/// `sigma` was computed (with the default peak share), makes the sum of the squares of (data - model) / sigma
/// equal to `expected`, the degrees of freedom of these values. 0 if noise alone explains the residuals; none
/// if no value up to 1 is large enough. All arrays are indexed as in Profile.
std::optional<double> found_model_error(const Profile& data, const std::vector<double>& model,
                                        const std::vector<double>& sigma, double model_error,
                                        double expected);

}  // namespace vegard::fit
