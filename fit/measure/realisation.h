// Structure inside of bands that a model does not know: rays, folds, JPEG's blocks.
#pragma once

#include <vector>

#include "fit/measure/profile.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// By how much (standard deviation) a band's profile may differ from that of an even sheet because the
/// structure in it is what it happens to be; indexed as in Profile, of profiles along columns that are
/// smoothed by `smoothing_px`. Every band is cut into four: what their profiles differ by in shape, their own
/// brightness and a trend across the band taken out (a band has a gain, and a model knows how a border
/// slopes), less the photograph's noise, pooled over the rows around. Rays are about as wide as such a
/// quarter, so that the mean of four counts as one of two. 0 where bands are narrower than eight pixels.
std::vector<double> realisation_sigma(const Photo& photo, const Region& region, int bands,
                                      double smoothing_px);

/// Root mean square difference, over sqrt(2), between two samplings of one model's profile, as a fraction of
/// its brightness where it is brighter than a fifth of its peak: the Monte-Carlo error of one. Each band's
/// own brightness is taken out, since it has a gain. 0 for a dark model.
double sampling_error(const std::vector<double>& one, const std::vector<double>& other, int bands);

}  // namespace vegard::fit
