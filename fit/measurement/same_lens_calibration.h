// The cameras of several pictures that have one lens: the stage that `vegard calibrate --same-lens` runs.
#pragma once

#include <vector>

#include "fit/measurement/camera_calibration.h"

namespace vegard::fit {

/// Calibrates each picture alone, as calibrate_camera() does, then all that are recognised together; the
/// others have no calibration and no answer. Throws Error(unreadable_input) if fewer than two are recognised
/// or their sizes differ, and what calibrate_camera() throws.
std::vector<CameraCalibration> calibrate_same_lens(const std::vector<CalibrationRequest>& requests,
                                                   const Tell& tell);

}  // namespace vegard::fit
