// The noise model: the standard deviation of a profile's values about the true model.
#pragma once

#include <optional>
#include <vector>

#include "fit/measure/profile.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

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

// The variance of the mean light in a picture's cells, from the noise of the pixels.

/// Returns the variance of the mean of each cell of a measured profile in one channel. With
/// fit.photo_noise = "sensor" it is the square of the profile's standard error. Otherwise it is estimated
/// from the 3 x 3 pixels about each pixel: the sum of their light with the weights
///    1 -2  1
///   -2  4 -2
///    1 -2  1
/// has the variance 36 v, where v is a pixel's variance (Immerkaer 1996, Comput. Vis. Image Underst. 64,
/// 300); v follows from the median of the sum's absolute value over the picture, for normal noise that is the
/// same everywhere. The sum is 0 for planes and for straight edges along rows or columns, and the median is
/// hardly affected by other edges. So granules a few pixels wide hardly count as noise, as they would in
/// differences of two neighbours; and cells of one pixel, which contain no pair of neighbours, have a
/// variance too. The result is never below the quantisation's step²/12. The noise of neighbours is assumed
/// independent: if the camera or JPEG has smoothed it, the result is too small. 0 for a cell without usable
/// pixels, and if no pixel has eight usable neighbours.
std::vector<double> cell_variances(const sim::Scene& scene, const Photo& photo, const Profile& cells,
                                   int channel);

// The variance of profiles by random structure that the model omits: rays, folds, blocks of JPEG.

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
