#include "sim/render/volume_files.h"

namespace vegard::sim {

VolumeFiles read_volume_files(const Scene&) { return {}; }

}  // namespace vegard::sim
