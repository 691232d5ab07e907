// A calibration to look at: its residuals as a plot, its stars on the picture.
#pragma once

#include <string>

#include "fit/photo/photo.h"
#include "fit/photo/pointing/calibration.h"
#include "fit/report/plot/plot.h"

namespace vegard::fit {

/// Residuals as arrows over the frame, made longer by a factor that the title gives, and along and across the
/// radius against the distance from the lens's centre.
Plot residual_plot(const Calibration& calibration);

/// The picture, 2 pixels for each, with a circle where each star was computed, a cross where it was seen, and
/// its name; stars that were left out in red; the horizon, and circles of elevation every 30 degrees. The
/// bytes of a PNG.
std::string star_overlay(const Calibration& calibration, const Photo& photo);

}  // namespace vegard::fit
