// Reads the photographs that belong to a scene: one that the caller names, or those of [[fit.photo]]; and
// completes the scene from a photograph's metadata.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "fit/photo/photo.h"
#include "fit/photo/photo_defaults.h"
#include "sim/base/picture/picture_metadata.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// The pixels of a photograph: those of the file, or averaged by averaging_for_fit() (fit/photo/averaging.h).
enum class PhotoPixels { of_file, for_fit };

/// Returns the decoding that `word` names, or scene.fit.decoding if `word` is empty. A curve's table in the
/// scene's word is relative to the scene's file; one in another word is relative to the working directory.
Decoding decoding_for(const sim::Scene& scene, const std::string& word);

/// Reads one photograph, a file or a frame of one. `mask`: file of a mask, `decoding`: word of a decoding;
/// both may be empty. Throws as read_photo(), decoding_of_word() and apply_mask() do.
Photo photograph_for(const sim::Scene& scene, const std::string& file, const std::string& mask,
                     const std::string& decoding, PhotoPixels pixels = PhotoPixels::of_file);

/// Reads and masks the photographs of scene.fit.photos, in their order; file names are relative to the
/// scene's file. Decoding::sensor uses the sensor of the photograph's own scene. Throws
/// Error(unreadable_input) with the photograph's name.
std::vector<Photo> photographs_of(const sim::Scene& scene, PhotoPixels pixels = PhotoPixels::of_file);

/// Returns photo_metadata(); if they lack the picture's size, the picture is decoded to find it.
sim::PictureMetadata metadata_with_size(const std::string& photo);

/// Returns with_photo_defaults() for a photograph's metadata, after a check of the resulting scene. Throws
/// Error(unreadable_input), Error(scene).
PhotoDefaults taken_from_photograph(const sim::Scene& scene, const std::string& photo,
                                    const std::set<std::string>& also_given = {});

}  // namespace vegard::fit
