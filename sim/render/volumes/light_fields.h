// The emitters of a scene as fields in space, for grids: footprints, nebulae, grids, and what is on the Sun.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/light/emitter.h"
#include "sim/render/volumes/volume_files.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Whose frame a field is in: fields of one frame can go into one grid, but a nebula's is its own alone.
enum class FieldFrame { ground, sun, nebula };

struct NamedField {
  std::string what;  ///< "volume 'arc'", for messages
  std::unique_ptr<const LightField> field;
  FieldFrame frame = FieldFrame::ground;
};

/// They must not outlive scene and files. Throws Error(usage) for strands so thin that where they are takes
/// more than `memory_limit` bytes, of each loop, bundle or rope, and Error(scene) for a loop whose own grid
/// does.
std::vector<NamedField> light_fields(const Scene& scene, const VolumeFiles& files, int threads,
                                     std::uint64_t memory_limit = std::uint64_t{4} << 30);

}  // namespace vegard::sim
