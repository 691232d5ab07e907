// Smoothing profiles down the rows: what a search looks at before it looks at details.
#pragma once

#include "fit/measure/profile.h"

namespace vegard::fit {

/// Gaussian smoothing of every band and channel along its rows, sigma in rows. Rows without pixels are
/// bridged: the weights of the others are brought to a sum of 1 (a smoothed value exists where any row within
/// reach has one).
Profile smoothed(const Profile& profile, double sigma_rows);

/// Of profiles in any bins, sigma in pixels along the positions.
Profile smoothed_by_px(const Profile& profile, double sigma_px);

}  // namespace vegard::fit
