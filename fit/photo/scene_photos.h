// The photographs that are looked at with a scene: one that is named, or those of its [[fit.photo]]; and what
// one adds to the scene.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "fit/photo/photo.h"
#include "fit/photo/photo_defaults.h"
#include "sim/base/picture/picture_metadata.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Whether large photographs are averaged while they are read (fit/photo/averaging.h).
enum class PhotoPixels { of_file, for_fit };

/// A decoding's word that is given, or where it is empty the scene's own. The scene's table of a curve is
/// that of the scene; what is given stands where it says.
Decoding decoding_for(const sim::Scene& scene, const std::string& word);

/// One photograph, a file or a frame of one, by a decoding's word and with a mask; both may be empty. Throws
/// as read_photo(), decoding_of_word() and apply_mask() do.
Photo photograph_for(const sim::Scene& scene, const std::string& file, const std::string& mask,
                     const std::string& decoding, PhotoPixels pixels = PhotoPixels::of_file);

/// scene.fit.photos, read and masked, in their order; files are relative to the scene's. A decoding by the
/// sensor goes by that of the photograph's own scene. Throws Error(unreadable_input) with the photograph's
/// name.
std::vector<Photo> photographs_of(const sim::Scene& scene, PhotoPixels pixels = PhotoPixels::of_file);

/// photo_metadata(), with the picture's size from its pixels where its head does not say it.
sim::PictureMetadata metadata_with_size(const std::string& photo);

/// with_photo_defaults() of a photograph's own words, checked as a whole. Throws Error(unreadable_input),
/// Error(scene).
PhotoDefaults taken_from_photograph(const sim::Scene& scene, const std::string& photo,
                                    const std::set<std::string>& also_given = {});

}  // namespace vegard::fit
