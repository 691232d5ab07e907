// The variance of the mean light in a picture's cells that follows from the noise of the pixels.
#pragma once

#include <vector>

#include "fit/measure/profile.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Variance of the mean of each cell of a measured profile in one channel. With fit.photo_noise = "sensor"
/// the square of its standard error; else from the pixels, by the nine about each: the sum of
///    1 -2  1
///   -2  4 -2
///    1 -2  1
/// times their light has the variance 36 v, where v is a pixel's (Immerkaer 1996, Comput. Vis. Image Underst.
/// 64, 300); v is taken from the median of its size over the picture, as of normal noise that is alike all
/// over. No plane and no straight edge along rows or columns shows in it, and few other edges in the median,
/// so that granules a few pixels wide hardly count as noise, which they do in differences of two neighbours;
/// and cells of one pixel, which hold no two neighbours, have a variance too. Never below the quantisation's
/// step²/12. It takes the noise of neighbours as independent: where a camera or JPEG has smoothed it, it is
/// too small. 0 for a cell without usable pixels, and where no pixel stands among usable ones.
std::vector<double> cell_variances(const sim::Scene& scene, const Photo& photo, const Profile& cells,
                                   int channel);

}  // namespace vegard::fit
