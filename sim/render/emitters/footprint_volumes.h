// The footprints of a scene as emitters, and as fields in space.
#pragma once

#include <memory>

#include "sim/emit/footprint/map/make_footprint.h"
#include "sim/light/colours_profile.h"
#include "sim/light/emitter.h"
#include "sim/light/profile_table.h"
#include "sim/render/emitters/footprint_looks.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// T is double or FreeDual. The footprint is one of the scene's. An exposure's light is the sum of all looks,
/// of which this is one. Those of a box may have several instants.
template <class T>
std::unique_ptr<Emitter<T>> footprint_emitter(const Scene& scene, const Footprint& footprint,
                                              const VolumeFiles& files, const NumberAs<T>& number,
                                              int threads, const FootprintLook& look = {});

/// As a field in the observer's east, north and up, at the scene's start.
std::unique_ptr<LightField> footprint_field(const Scene& scene, const Footprint& footprint,
                                            const VolumeFiles& files, int threads);

// Which of the pictures that have been read a footprint is made from.

/// Those of one footprint, of what has been read (sim/scene/file/scene_pictures.h). They live as long as
/// `files`.
FootprintPictures footprint_pictures(const VolumeFiles& files, const Footprint& footprint);

// The height profiles of a scene's footprints, as their key `light` asks for them.

/// The two colours of a footprint as amounts of the scene's lines, by what its sensor makes of them.
ColourLadder colour_ladder(const Scene& scene, const Footprint& footprint);

/// profile_table() of the scene's lines, or of light = "colours" that table in its colours.
ProfileTable footprint_profiles(const Scene& scene, const Footprint& footprint, double ln_least,
                                double ln_most);

}  // namespace vegard::sim
