// Smoothing profiles down the rows: what a search looks at before it looks at details.
#pragma once

#include "fit/measure/profile.h"
#include "fit/model/profile_model.h"

namespace vegard::fit {

/// Gaussian smoothing of every band and channel along its rows, sigma in rows. Rows without pixels are
/// bridged: the weights of the others are brought to a sum of 1 (a smoothed value exists where any row within
/// reach has one).
Profile smoothed(const Profile& profile, double sigma_rows);

/// The same of a model, derivatives included; a model has every row.
void smooth(ModelProfile& model, int bands, int rows, double sigma_rows);

/// Of profiles in any bins, sigma in pixels along the positions.
Profile smoothed_by_px(const Profile& profile, double sigma_px);

/// The same of a model in the bins of several grids, one grid's after the other's.
void smooth(ModelProfile& model, const std::vector<std::shared_ptr<const BinGrid>>& grids, double sigma_px);

}  // namespace vegard::fit
