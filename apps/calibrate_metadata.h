// What a picture's own words add to what `vegard calibrate` was asked.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/calibrate_options.h"
#include "fit/photo/photo_facts.h"
#include "sim/base/picture/picture_metadata.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

struct PictureSays {
  fit::SkyOfPicture sky;              ///< sky_of(), and what it left out
  std::optional<sim::Scene> camera;   ///< that of --camera, with the picture's focal length if it has none
  std::vector<fit::PhotoFact> taken;  ///< what was taken, in the order of a scene file
  std::vector<std::string> notes;
};

/// The time unless --time is given (that in --camera is of another picture); the place unless --site or the
/// camera's site is, and its height only together with it; the field of view if --camera is a pinhole that
/// says neither it nor a size of its own. Nothing with --no-metadata. Throws Error(usage).
PictureSays with_metadata(const CalibrateOptions& options, const std::optional<sim::Scene>& camera_scene,
                          const sim::PictureMetadata& metadata);

}  // namespace vegard::apps
