// The height profiles of a scene's footprints, as their key `light` asks for them.
#pragma once

#include "sim/light/colours_profile.h"
#include "sim/light/profile_table.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The two colours of a footprint as amounts of the scene's lines, by what its sensor makes of them.
ColourLadder colour_ladder(const Scene& scene, const Footprint& footprint);

/// profile_table() of the scene's lines, or of light = "colours" that table in its colours.
ProfileTable footprint_profiles(const Scene& scene, const Footprint& footprint, double ln_least,
                                double ln_most);

}  // namespace vegard::sim
