// The pictures that a scene's [composite] names.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/view/film/composite.h"

namespace vegard::fit {

/// Reads them and fills them into the camera's frame; every picture of an animation can share them. Names are
/// relative to the scene's file. A mask takes the place of the foreground's alpha; a mask without a
/// foreground is a black one. Throws Error(unreadable_input) with the file and the scene's key; Error(scene)
/// for a foreground that would hide the whole sky, having neither.
sim::CompositePictures read_composite_pictures(const sim::Scene& scene);

/// The names of all files beside tables that the scene reads, those of volumes and of march.depth included.
std::vector<std::string> picture_files(const sim::Scene& scene);

}  // namespace vegard::fit
