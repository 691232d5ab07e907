// The photographs that a scene names itself, [[fit.photo]].
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// scene.fit.photos, read and masked, in their order; files are relative to the scene's. A decoding by the
/// sensor goes by that of the photograph's own scene. Throws Error(unreadable_input) with the photograph's
/// name.
std::vector<fit::Photo> photographs_of(const sim::Scene& scene);

/// The scene's file and the photographs with their masks, for the result.
std::vector<fit::InputFile> inputs_of(const std::string& scene_file, const std::string& scene_sha256,
                                      const std::vector<fit::Photo>& photos);

}  // namespace vegard::apps
