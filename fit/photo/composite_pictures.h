// Reads the pictures (foreground, background, masks) that a scene's [composite] names.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/structs/scene.h"
#include "sim/view/film/composite.h"

namespace vegard::fit {

/// Reads the pictures and scales them to the camera's frame; all pictures of an animation can share them.
/// Names are relative to the scene's file. A mask replaces the foreground's alpha; a mask without a
/// foreground picture makes a black foreground. Throws Error(unreadable_input) with the file and the scene's
/// key; Error(scene) for a foreground with neither alpha nor mask, which would hide the whole sky.
sim::CompositePictures read_composite_pictures(const sim::Scene& scene);

/// Returns the names of all files except tables that the scene reads, including those of volumes and of
/// march.depth.
std::vector<std::string> picture_files(const sim::Scene& scene);

}  // namespace vegard::fit
