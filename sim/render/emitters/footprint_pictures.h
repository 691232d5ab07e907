// Which of the pictures that have been read a footprint is made from.
#pragma once

#include "sim/emit/footprint/map/make_footprint.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Those of one footprint, of what has been read (sim/scene/file/scene_pictures.h). They live as long as
/// `files`.
FootprintPictures footprint_pictures(const VolumeFiles& files, const Footprint& footprint);

}  // namespace vegard::sim
