// The variance of the mean light in a picture's cells, from the noise of the pixels.
#pragma once

#include <vector>

#include "fit/measure/profile.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

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

}  // namespace vegard::fit
