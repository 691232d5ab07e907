// A profile as a text table.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "fit/measure/line_brightness.h"
#include "fit/measure/profile.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// Elevation above the horizon in degrees of a point of the image (x_px to the right, y_px down, the centre
/// of the first pixel at (0.5, 0.5)); NaN for a point that has none. An empty function stands for an unknown
/// camera.
using ElevationOfPixel = std::function<double(double x_px, double y_px)>;

/// Elevation of a profile's row at the centre column of its band; NaN without a camera.
double row_elevation_deg(const Profile& profile, int band, int row,
                         const ElevationOfPixel& elevation_of_pixel);

/// Returns comment lines ("# ...") that say what was measured and how, a line of column names, and one line
/// per band and row. Numbers have the fewest digits from which the same double can be read; unknown values
/// are empty. There are no dates and no folders: the same photograph gives the same bytes. `lines` adds the
/// columns rayleigh_* and sigma_rayleigh_*, `observer_km` (for an observer above the air) the column
/// tangent_altitude_km.
std::string profile_csv(const Photo& photo, const Profile& profile,
                        const ElevationOfPixel& elevation_of_pixel = {},
                        const LineBrightness* lines = nullptr, std::optional<double> observer_km = {});

}  // namespace vegard::fit
