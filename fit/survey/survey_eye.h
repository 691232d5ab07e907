// The scene, mask, decoding and filter with which a camera's frames are analysed during one of its
// calibrations.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fit/photo/decoding.h"
#include "fit/survey/filter/frame_filter.h"
#include "fit/survey/survey.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

struct SurveyEye {
  sim::Scene scene;  ///< with the camera of the calibration
  Decoding decoding;
  std::string mask;                           ///< a file's name as it may be opened; empty: none
  int channel = 1;                            ///< that a border is traced in
  std::shared_ptr<const FrameFilter> filter;  ///< null where the work is without
};

/// What keeps the work from being done with any frame: nothing to fit, for instance. Throws sim::Error(scene,
/// unreadable_input).
void check_eye(const SurveyEye& eye, const std::vector<SurveyWork>& work);

/// Of all that the answers depend on: the scene with its tables and files, whatever their names, the mask,
/// the curve of the decoding, the channel, and the filter's trees. `decoding`: the word that eye.decoding was
/// made of.
std::string eye_sha256(const SurveyEye& eye, const std::string& decoding);

}  // namespace vegard::fit
