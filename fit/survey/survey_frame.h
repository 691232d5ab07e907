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
  int block = 0, number = 0;  ///< of the frame, inside of its block
  const WorkAnswer* before =
      nullptr;  ///< the fit of the last frame of the block that has one; null: there is none
};

/// The frames of a survey, one after another. Of a file of many it keeps its hash, and where it has come to
/// in it: it is read once and not once for each of its frames.
class SurveyPictures {
 public:
  /// `sha256`: of the file as it stands there; set before what cannot be read is thrown. Throws as
  /// PictureSeries does.
  PictureBytes read(const std::string& name, std::string& sha256);

 private:
  PictureSeries series_;
  std::string hashed_, sha256_;
};

/// Opens the frame and does the plan's work with it. Whatever is wrong with it is in the answer. None if
/// options.stop was raised meanwhile. The same frame, eye and answer before give the same answer, for every
/// number of threads. `eye` may be null for a frame that is skipped.
std::optional<FrameAnswer> survey_frame(const FrameTask& task, const SurveyEye* eye,
                                        const FitOptions& options, SurveyPictures& pictures);

}  // namespace vegard::fit
