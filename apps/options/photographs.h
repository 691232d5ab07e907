// Photographs that a scene names itself, [[fit.photo]], and what a photograph on the command line adds to a
// scene.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/input_files.h"
#include "fit/photo/photo.h"
#include "fit/photo/photo_facts.h"
#include "fit/photo/scene_photos.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// What a command line says of the photograph that it names, of --photo, --at, --mask, --decoding and --line.
struct PhotoWords {
  std::string file, at, mask, decoding;
  std::vector<std::string> filters;
};

/// With the frames at `at` in the names of its files (picture_at()), and no `at` any more. Throws
/// Error(usage, unreadable_input).
PhotoWords with_frames_chosen(PhotoWords words);

/// The photograph of the command line, or those that the scene names. Throws Error(usage) where there is
/// none, or both, and as reading does.
std::vector<fit::Photo> photographs_asked(const PhotoWords& words, const sim::Scene& scene,
                                          fit::PhotoPixels pixels = fit::PhotoPixels::of_file);

/// Takes into the scene what neither its file nor `changes` ("path=value", of --set) give, and says on
/// standard output what was taken and what is to be noted. Throws Error(unreadable_input).
std::vector<fit::PhotoFact> take_from_photograph(sim::Scene& scene, const std::string& photo,
                                                 const std::vector<std::string>& changes);

}  // namespace vegard::apps
