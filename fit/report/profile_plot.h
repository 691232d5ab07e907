// The picture of a photograph's vertical profiles.
#pragma once

#include "fit/measure/profile.h"
#include "fit/photo/photo.h"
#include "fit/report/plot/plot.h"
#include "fit/report/table/profile_csv.h"

namespace vegard::fit {

/// Brightness to the right and height upwards (elevation if the camera is known, else the row, as in the
/// image), R, G and B in their colours (one alone, where the others have no pixels, without a name) with one
/// standard error shaded. One panel per band; more than six bands are averaged into six panels of neighbours,
/// and rows of a tall region into at most 500, which the note says.
Plot profile_plot(const Photo& photo, const Profile& profile,
                  const ElevationOfPixel& elevation_of_pixel = {});

}  // namespace vegard::fit
