// Reads the photographs of a command: those that a scene names ([[fit.photo]]), or the one on the command
// line, and takes values from it into the scene.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/input_files.h"
#include "fit/photo/photo.h"
#include "fit/photo/photo_facts.h"
#include "fit/photo/scene_photos.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// The options for a photograph: --photo, --at, --mask, --decoding and --line.
struct PhotoWords {
  std::string file, at, mask, decoding;
  std::vector<std::string> filters;
};

/// Returns the options with the frame at the time `at` chosen in the names of files (picture_at()), and `at`
/// empty. Throws Error(usage, unreadable_input).
PhotoWords with_frames_chosen(PhotoWords words);

/// Reads the photograph of the command line, or those that the scene names. Throws Error(usage) where there
/// is none, or both, and as reading does.
std::vector<fit::Photo> photographs_asked(const PhotoWords& words, const sim::Scene& scene,
                                          fit::PhotoPixels pixels = fit::PhotoPixels::of_file);

/// Takes values from the photograph's metadata into the scene which neither its file nor `changes`
/// ("path=value", from --set) give. Prints on standard output what was taken and what the user should note.
/// Throws Error(unreadable_input).
std::vector<fit::PhotoFact> take_from_photograph(sim::Scene& scene, const std::string& photo,
                                                 const std::vector<std::string>& changes);

}  // namespace vegard::apps
