// What `vegard calibrate` holds against its own answer.
#pragma once

#include <optional>
#include <vector>

#include "apps/commands/calibrate_options.h"
#include "fit/photo/photo.h"
#include "fit/photo/pointing/calibration.h"

namespace vegard::apps {

/// Appends to the warnings of a calibration by stars: bright stars in view that match nothing in the picture,
/// an axis away from the zenith where --camera or a fisheye's circle say that it is there, and what stars
/// cannot tell. `usable`: per pixel of the photograph, whether the mask leaves it; empty: all are.
void add_doubts(fit::Calibration& calibration, const CalibrateOptions& options,
                const std::optional<sim::Scene>& camera_file, const fit::SkyOfPicture& sky,
                const std::optional<fit::Photo>& photo, const std::vector<char>& usable);

}  // namespace vegard::apps
