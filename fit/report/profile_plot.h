// Plots of a photograph's vertical profiles, and of profiles by direction.
#pragma once

#include "fit/measure/direction_profile.h"
#include "fit/measure/profile.h"
#include "fit/photo/photo.h"
#include "fit/report/plot/plot.h"
#include "fit/report/table/profile_csv.h"

namespace vegard::fit {

/// Returns the plot: brightness to the right and height upwards (elevation if the camera is known, else the
/// row, as in the image); R, G and B in their colours with one standard error shaded (a single line without a
/// name if only one channel has pixels). There is one panel per band; more than six bands are averaged into
/// six panels of neighbours, and the rows of a tall region into at most 500, which the note says.
Plot profile_plot(const Photo& photo, const Profile& profile,
                  const ElevationOfPixel& elevation_of_pixel = {});

/// Returns a plot of the light of each channel and of the ratios of red and blue to green against elevation,
/// a line for each sector (at most fourteen of them, evenly chosen, which the note says).
Plot direction_profile_plot(const Photo& photo, const DirectionProfile& directions);

}  // namespace vegard::fit
