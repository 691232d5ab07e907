// Fills keys that a scene leaves open from the metadata of its photograph.
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
  std::vector<PhotoFact> taken;    ///< in the order of a scene file
  std::vector<std::string> notes;  ///< what is worth knowing of it, in sentences without a full stop
};

/// The scene with those of photo_facts() that neither its file gives (Scene::lines) nor `also_given`, paths
/// that have been set since. A field of view is taken by a pinhole only; one axis of a picture's size is not
/// taken without the other, nor a latitude without its longitude; a size that the scene has anyway is none to
/// take. A value outside of a key's limits is left, with a note. Nothing else is touched: not the magnetic
/// field, which a note mentions where it is still the default's at a place that is not.
PhotoDefaults with_photo_defaults(const sim::Scene& scene, const sim::PictureMetadata& metadata,
                                  const std::set<std::string>& also_given = {});

}  // namespace vegard::fit
