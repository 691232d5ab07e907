// The analysis of one frame of a survey.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/frames/picture_bytes.h"
#include "fit/search/fit_options.h"
#include "fit/survey/survey_answer.h"
#include "fit/survey/survey_eye.h"
#include "fit/survey/survey_plan.h"

namespace vegard::fit {

struct FrameTask {
  const SurveyPlan* plan = nullptr;
  int block = 0, number = 0;  ///< the block, and the frame's number within it
  const WorkAnswer* before =
      nullptr;  ///< the latest fit of an earlier frame of the block; null if there is none
};

/// Reads the frames of a survey, one after another. For a file with many frames it keeps the hash and the
/// position in the file, so that the file is read once and not once for each frame.
class SurveyPictures {
 public:
  /// Reads a frame. Sets `sha256` to the hash of the file as stored, also if an error is thrown because the
  /// frame cannot be read. Throws as PictureSeries does.
  PictureBytes read(const std::string& name, std::string& sha256);

 private:
  PictureSeries series_;
  std::string hashed_, sha256_;
};

/// Reads the frame and does the plan's work with it. Errors of the frame are reported in the answer. None if
/// options.stop was set meanwhile. The answer depends only on the frame, `eye` and FrameTask::before, not on
/// the number of threads. `eye` may be null for a frame that is skipped.
std::optional<FrameAnswer> survey_frame(const FrameTask& task, const SurveyEye* eye,
                                        const FitOptions& options, SurveyPictures& pictures);

}  // namespace vegard::fit
