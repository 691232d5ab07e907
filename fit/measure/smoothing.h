// Smooths profiles along their rows; the first stages of the search compare smoothed profiles.
#pragma once

#include "fit/measure/profile.h"

namespace vegard::fit {

/// Applies a Gaussian filter to every band and channel along its rows, sigma in rows. Rows without pixels are
/// skipped and the weights of the others normalised to a sum of 1 (a smoothed value exists if any row within
/// the filter's width has a value).
Profile smoothed(const Profile& profile, double sigma_rows);

/// Applies the filter along the positions of profiles in any bins, sigma in pixels.
Profile smoothed_by_px(const Profile& profile, double sigma_px);

}  // namespace vegard::fit
