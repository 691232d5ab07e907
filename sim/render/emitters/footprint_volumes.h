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

/// Makes the emitter of one look at a footprint of the scene; the light of an exposure is the sum over all
/// looks. A look at a box may have several instants. T is double or FreeDual.
template <class T>
std::unique_ptr<Emitter<T>> footprint_emitter(const Scene& scene, const Footprint& footprint,
                                              const VolumeFiles& files, const NumberAs<T>& number,
                                              int threads, const FootprintLook& look = {});

/// Makes the footprint's field in the observer's east, north and up, at the scene's start.
std::unique_ptr<LightField> footprint_field(const Scene& scene, const Footprint& footprint,
                                            const VolumeFiles& files, int threads);

// The pictures from which a footprint is made.

/// Returns the pictures of one footprint among those that have been read (sim/scene/file/named_files.h).
/// They live as long as `files`.
FootprintPictures footprint_pictures(const VolumeFiles& files, const Footprint& footprint);

// The height profiles of a scene's footprints, according to their key `light`.

/// Returns the two colours of a footprint as amounts of the scene's lines, by the colours that the sensor
/// gives these lines.
ColourLadder colour_ladder(const Scene& scene, const Footprint& footprint);

/// Returns profile_table() of the scene's lines; with light = "colours", that table in the footprint's
/// colours.
ProfileTable footprint_profiles(const Scene& scene, const Footprint& footprint, double ln_least,
                                double ln_most);

}  // namespace vegard::sim
