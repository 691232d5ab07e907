// The noise model: the standard deviation of a profile value about the right model.
#pragma once

#include <optional>
#include <vector>

#include "fit/measure/profile.h"

namespace vegard::fit {

/// Brightness of the sky per channel, taken as the 5th percentile of the profile: what the aurora's own
/// brightness is counted from, here and where a residual is stated as a fraction of the profile's peak.
std::array<double, 3> sky_level(const Profile& profile);

/// Peak of the profile above its sky, over all rows, bands and channels.
double profile_peak(const Profile& profile);

/// Standard deviation of every profile value, indexed as in Profile; 0 marks a value that is not used (no
/// pixels). Three parts, added in quadrature: the photograph's own noise (Profile::standard_error);
/// `model_error` times the local brightness above the sky, for structure that the model does not have (rays,
/// uneven arcs); `peak_share` times that fraction of the channel's peak, for the same at places where the
/// profile is steep and dark.
std::vector<double> profile_sigma(const Profile& profile, double model_error, double peak_share);
/// With a peak share of 0.1.
std::vector<double> profile_sigma(const Profile& profile, double model_error);

/// What unmodelled structure is by the data themselves: the share of the light that, in the place of the
/// `model_error` that `sigma` was made with (and profile_sigma()'s own peak share), makes the squares of
/// (data - model) / sigma sum up to `expected`, the degrees of freedom of these values. 0 where noise alone
/// makes as much; none where no share up to 1 is enough. All are indexed as in Profile.
std::optional<double> found_model_error(const Profile& data, const std::vector<double>& model,
                                        const std::vector<double>& sigma, double model_error,
                                        double expected);

}  // namespace vegard::fit
