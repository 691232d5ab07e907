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
  std::string mask;                           ///< name with which the file can be opened; empty: none
  int channel = 1;                            ///< in which borders are traced
  std::shared_ptr<const FrameFilter> filter;  ///< null if the work does not include the filter
};

/// Checks that the work is possible, which does not depend on the frame: for instance that there is something
/// to fit. Throws sim::Error(scene) or (unreadable_input) if it is not.
void check_eye(const SurveyEye& eye, const std::vector<SurveyWork>& work);

/// Returns a hash of everything on which the answers depend: the contents of the scene and of its tables and
/// files, the mask, the curve of the decoding, the channel, and the filter's trees. `decoding`: the word for
/// eye.decoding.
std::string eye_sha256(const SurveyEye& eye, const std::string& decoding);

}  // namespace vegard::fit
