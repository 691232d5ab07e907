// A camera from stars, from maps or from another program's solution: the stage that `vegard calibrate` runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "fit/measurement/calibration_request.h"
#include "fit/measurement/words.h"
#include "fit/photo/photo.h"
#include "fit/photo/pointing/blind/sky_place.h"
#include "fit/photo/pointing/scene_camera.h"

namespace vegard::fit {

/// Stars recognised without a camera to start from.
struct BlindStars {
  PictureStars picture;             ///< of which nothing but the words is known if nothing was found
  std::optional<SkyPlace> place;    ///< none: no stars were recognised
  std::optional<LocalStars> local;  ///< with time and site
};

struct CameraCalibration {
  std::optional<Photo> photo;
  Frame frame;
  SkyOfPicture sky;
  std::vector<FoundStar> points;    ///< of light, if the request asks for them
  std::optional<BlindStars> blind;  ///< of a request that is blind()
  /// None: no stars were recognised, or they are not known in azimuth and elevation.
  std::optional<Calibration> calibration;
  CalibrationOrigin origin;
  std::string chance;      ///< why no stars were recognised from an earlier camera; empty: they were
  bool has_answer = true;  ///< whether it gives all that was asked for
};

/// Tells what was taken from the picture and how its stars were found, not yet what the calibration gives.
/// Throws Error(usage) for what does not belong together and for what is lacking, Error(unreadable_input),
/// Error(scene).
CameraCalibration calibrate_camera(const CalibrationRequest& request, const Tell& tell);

/// That time or place is another picture's: how many of the recognised stars were below the horizon.
std::string elsewhere_line(const LocalStars& local);

}  // namespace vegard::fit
