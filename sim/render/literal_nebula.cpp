#include "sim/render/literal_nebula.h"

namespace vegard::sim {

Image literal_nebula_picture(const Scene&, const Nebula&, const Image*, int) { return {}; }

}  // namespace vegard::sim
