// The scenes of a survey's cameras as on command lines: a file, a camera's file, changes.
#pragma once

#include <string>
#include <vector>

#include "fit/survey/survey.h"
#include "fit/survey/survey_frame.h"
#include "fit/survey/survey_plan.h"

namespace vegard::apps {

/// Converts names of files in a survey or a plan to names that can be opened.
struct SurveyPlaces {
  std::string folder;  ///< ends with /, or is empty
  std::string operator()(const std::string& name) const;
};

/// Returns a camera's scene, decoding and mask during one of its calibrations, checked for the work. Throws
/// as scene_of().
fit::SurveyEye survey_eye(const fit::SurveyCamera& camera, int calibration, const SurveyPlaces& place,
                          const std::vector<fit::SurveyWork>& work);

/// Returns the inputs that determine it, for the plan.
fit::PlanInput survey_setup(const fit::SurveyCamera& camera, int calibration, const SurveyPlaces& place,
                            const std::vector<fit::SurveyWork>& work);

/// Returns the eye of a plan's block. Throws Error(existing_output) if any of its inputs has changed since
/// the plan was made.
fit::SurveyEye planned_eye(const fit::SurveyPlan& plan, int camera, int calibration);

/// Throws as planned_eye() does for any of the plan's blocks; to be called once before many processes would
/// each find the error.
void check_planned_eyes(const fit::SurveyPlan& plan);

}  // namespace vegard::apps
