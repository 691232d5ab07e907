// The input files that a result depends on.
#pragma once

#include <string>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"

namespace vegard::fit {

/// The scene's file and the photographs with their masks, for FitResult::inputs.
std::vector<InputFile> inputs_of(const std::string& scene_file, const std::string& scene_sha256,
                                 const std::vector<Photo>& photos);
std::vector<InputFile> inputs_of(const std::string& scene_file, const std::string& scene_sha256,
                                 const Photo& photo);

/// Adds the radars' files, with the role "radar", to the inputs of a result.
void add_radar_files(FitResult& result);

}  // namespace vegard::fit
