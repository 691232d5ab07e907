// Plots of a calibration: its residuals, and its stars on the picture.
#pragma once

#include <string>

#include "fit/photo/photo.h"
#include "fit/photo/pointing/blind/star_recognition.h"
#include "fit/photo/pointing/calibration.h"
#include "fit/report/plot/plot.h"

namespace vegard::fit {

/// Returns a plot of the residuals as arrows over the frame, lengthened by a factor that the title gives, and
/// of their radial and tangential components against the distance from the lens's centre.
Plot residual_plot(const Calibration& calibration);

/// Returns the bytes of a PNG: the picture enlarged twice, with a circle at each star's computed position, a
/// cross at its measured one, and its name; stars that were left out in red; the horizon, and circles of
/// elevation every 30 degrees.
std::string star_overlay(const Calibration& calibration, const Photo& photo);

/// The same of stars that were recognised without time and place: where the horizon is is not known then, and
/// the circles are of declination, every 30 degrees.
std::string star_overlay(const StarRecognition& recognition, const Photo& photo);

}  // namespace vegard::fit
