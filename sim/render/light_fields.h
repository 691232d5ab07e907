// The emitters of a scene as fields in space, for grids: footprints, nebulae and grids.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/light/emitter.h"
#include "sim/render/volume_files.h"
#include "sim/scene/scene.h"

namespace vegard::sim {

struct NamedField {
  std::string what;  ///< "volume 'arc'", for messages
  std::unique_ptr<const LightField> field;
};

/// They must not outlive scene and files.
std::vector<NamedField> light_fields(const Scene& scene, const VolumeFiles& files, int threads);

}  // namespace vegard::sim
