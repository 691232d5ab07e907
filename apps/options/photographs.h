// Photographs that a scene names itself, [[fit.photo]], and what a photograph on the command line adds to a
// scene.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"
#include "fit/photo/photo_facts.h"
#include "sim/base/picture/picture_metadata.h"
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

/// Whether large photographs are averaged while they are read (fit/photo/averaging.h).
enum class PhotoPixels { of_file, for_fit };

/// The photograph of the command line, or those that the scene names. Throws Error(usage) where there is
/// none, or both, and as reading does.
std::vector<fit::Photo> photographs_asked(const PhotoWords& words, const sim::Scene& scene,
                                          PhotoPixels pixels = PhotoPixels::of_file);

/// scene.fit.photos, read and masked, in their order; files are relative to the scene's. A decoding by the
/// sensor goes by that of the photograph's own scene. Throws Error(unreadable_input) with the photograph's
/// name.
std::vector<fit::Photo> photographs_of(const sim::Scene& scene, PhotoPixels pixels = PhotoPixels::of_file);

/// The scene's file and the photographs with their masks, for the result.
std::vector<fit::InputFile> inputs_of(const std::string& scene_file, const std::string& scene_sha256,
                                      const std::vector<fit::Photo>& photos);

/// That of the file, with the picture's size from its pixels where its head does not say it.
sim::PictureMetadata metadata_of(const std::string& photo);

/// Takes into the scene what neither its file nor `changes` ("path=value", of --set) give, and says on
/// standard output what was taken and what is to be noted. Throws Error(unreadable_input).
std::vector<fit::PhotoFact> take_from_photograph(sim::Scene& scene, const std::string& photo,
                                                 const std::vector<std::string>& changes);

}  // namespace vegard::apps
