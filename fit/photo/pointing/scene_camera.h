// A calibration's camera as a scene has it, and back.
#pragma once

#include <string>
#include <vector>

#include "fit/photo/pointing/calibration.h"
#include "sim/scene/structs/site.h"

namespace vegard::fit {

/// A scene's camera in a frame of this size: its centre keeps its place to the frame's middle.
SkyCamera sky_camera_of(const sim::Camera& camera, const Frame& frame);

/// The calibrated camera. Numbers beyond the limits of a scene are for sim::validate() to find.
sim::Camera scene_camera_of(const Calibration& calibration);

/// Where, when and from what the calibration was made; for the head of its files.
struct CalibrationOrigin {
  std::string stars;  ///< the table, picture or maps the stars come from, without their folders
  std::string image;
  bool site_known = false;
  sim::Site site;  ///< with time_utc, if it is known
  /// What was taken from the picture's own words (fit/photo/photo_facts.h, fact_text()).
  std::vector<std::string> from_photograph;
};

/// A scene file with [camera] and, where it is known, [site]; lens, rms, error bars and version in comments.
std::string camera_toml(const Calibration& calibration, const CalibrationOrigin& origin);

}  // namespace vegard::fit
