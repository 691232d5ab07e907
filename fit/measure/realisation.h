// The variance of profiles by random structure that the model omits: rays, folds, blocks of JPEG.
#pragma once

#include <vector>

#include "fit/measure/profile.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// Returns the standard deviation of a band's profile about that of an even sheet, caused by the random
/// structure in the band; indexed as in Profile, for profiles along columns that are smoothed by
/// `smoothing_px`. It is estimated from the differences in shape of the profiles of the band's four quarters,
/// less the photograph's noise, pooled over neighbouring rows. The quarters' brightness and a trend across
/// the band are removed first, since each band has a gain and the model includes the slope of a border. Rays
/// are about as wide as a quarter, so that the four quarters count as two independent ones. 0 if bands are
/// narrower than eight pixels.
std::vector<double> realisation_sigma(const Photo& photo, const Region& region, int bands,
                                      double smoothing_px);

/// Returns the Monte-Carlo error of one sampling of a model's profile: the root mean square difference of two
/// samplings over sqrt(2), as a fraction of the brightness, where the profile is brighter than a fifth of its
/// peak. Differences of a band's overall brightness are removed, since each band has a gain. 0 for a dark
/// model.
double sampling_error(const std::vector<double>& one, const std::vector<double>& other, int bands);

}  // namespace vegard::fit
