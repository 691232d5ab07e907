// The scenes of a survey's cameras, as command lines give them: a file, a camera's file, changes.
#pragma once

#include <string>
#include <vector>

#include "fit/survey/survey.h"
#include "fit/survey/survey_eye.h"
#include "fit/survey/survey_plan.h"

namespace vegard::apps {

/// Names of a survey's or of a plan's files as they may be opened.
struct SurveyPlaces {
  std::string folder;  ///< ends with /, or is empty
  std::string operator()(const std::string& name) const;
};

/// A camera's scene, decoding and mask during one of its calibrations, checked for the work. Throws as
/// scene_of().
fit::SurveyEye survey_eye(const fit::SurveyCamera& camera, int calibration, const SurveyPlaces& place,
                          const std::vector<fit::SurveyWork>& work);

/// What it is worked out by, for the plan.
fit::PlanInput survey_setup(const fit::SurveyCamera& camera, int calibration, const SurveyPlaces& place,
                            const std::vector<fit::SurveyWork>& work);

/// The eye of a plan's block. Throws Error(existing_output) if anything in it is not as the plan had it.
fit::SurveyEye planned_eye(const fit::SurveyPlan& plan, int camera, int calibration);

/// Throws as planned_eye() does for any of the plan's blocks: once, before many processes find it out.
void check_planned_eyes(const fit::SurveyPlan& plan);

}  // namespace vegard::apps
