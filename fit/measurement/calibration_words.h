// What a calibration says: lines for people, a table of stars, JSON.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "fit/measurement/camera_calibration.h"

namespace vegard::fit {

/// The table of the stars that were recognised blindly; empty if there are none.
std::string recognised_table(const CameraCalibration& found);

/// "lens: equidistant", "rms: 0.123 px over 40 of 41 stars; ...", "the axis is known to 0.01 deg, ...".
std::string lens_line(const Calibration& calibration);
std::string rms_line(const Calibration& calibration);
std::string axis_line(const Calibration& calibration);

void tell_calibration(const CameraCalibration& found, const Tell& tell);

/// The numbers as JSON: calibration_json(), or what the stars say of a picture without time and place.
nlohmann::ordered_json answer_json(const CameraCalibration& found);

}  // namespace vegard::fit
