// How far a profile value may lie from a model that is right.
#pragma once

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
std::vector<double> profile_sigma(const Profile& profile, double model_error, double peak_share = 0.1);

}  // namespace vegard::fit
