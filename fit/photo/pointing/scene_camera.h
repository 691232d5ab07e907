// Converts a calibration's camera to that of a scene, and back.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/photo/pointing/calibration.h"
#include "fit/photo/star_instant.h"
#include "sim/scene/structs/site.h"

namespace vegard::fit {

/// Returns a scene's camera for a frame of this size, with the same offset of its centre from the frame's
/// middle.
SkyCamera sky_camera_of(const sim::Camera& camera, const Frame& frame);

/// Returns the calibrated camera. Its numbers may be beyond a scene's limits, which sim::validate() checks.
sim::Camera scene_camera_of(const Calibration& calibration);

/// The origin of a calibration, for the head of its files.
struct CalibrationOrigin {
  std::string stars;  ///< the table, picture or maps from which the stars come, without folders
  std::string image;
  int same_lens = 1;  ///< number of pictures that the lens was fitted to
  bool site_known = false;
  sim::Site site;                      ///< with time_utc, if it is known: the instant of the stars
  std::optional<StarInstant> instant;  ///< if directions were computed from the time
  /// The facts that come from the picture's metadata (fact_text() of fit/photo/photo_facts.h).
  std::vector<std::string> from_photograph;
};

/// Returns a scene file with [camera] and, if it is known, [site], with lens, rms, error bars and version in
/// comments.
std::string camera_toml(const Calibration& calibration, const CalibrationOrigin& origin);

/// Returns how well directions are known by the text of such a file, typically; none if it does not say, or
/// if it is not from stars.
std::optional<double> direction_error_deg_in(std::string_view camera_toml);

}  // namespace vegard::fit
