// Sets keys that a scene file does not give from the metadata of its photograph.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "fit/photo/photo_facts.h"
#include "sim/base/picture/picture_metadata.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct PhotoDefaults {
  sim::Scene scene;
  std::vector<PhotoFact> taken;    ///< the keys that were set, in the order of a scene file
  std::vector<std::string> notes;  ///< remarks for the user, in sentences without a full stop
};

/// Returns the scene with those values of photo_facts() that neither its file gives (Scene::lines) nor
/// `also_given`, the paths of keys that were set after the file was read. A field of view is used for a
/// pinhole camera only; width and height are set together or not at all, and so are latitude and longitude; a
/// size that the scene already has is not counted as taken. A value outside of a key's limits is not used,
/// and noted. No other keys change. The magnetic field does not either: a note says so if the field is the
/// default one although the site is not the default site.
PhotoDefaults with_photo_defaults(const sim::Scene& scene, const sim::PictureMetadata& metadata,
                                  const std::set<std::string>& also_given = {});

}  // namespace vegard::fit
