// A plot of profiles by direction.
#pragma once

#include "fit/measure/direction_profile.h"
#include "fit/photo/photo.h"
#include "fit/report/plot/plot.h"

namespace vegard::fit {

/// Returns a plot of the light of each channel and of the ratios of red and blue to green against elevation,
/// a line for each sector (at most fourteen of them, evenly chosen, which the note says).
Plot direction_profile_plot(const Photo& photo, const DirectionProfile& directions);

}  // namespace vegard::fit
