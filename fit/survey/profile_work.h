// The results of a survey that come from the vertical profiles of a frame: peak positions of strips of the
// picture, brightness, thickness and colour.
#pragma once

#include "fit/photo/photo.h"
#include "fit/survey/survey_answer.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Strips side by side of the scene's region, from the left; the items of their numbers are 1, 2, ...
inline constexpr int kSurveyStrips = 5;

/// Of each strip whose light stands out of its noise: azimuth and elevation of the brightest place in a
/// channel (deg), its brightness and that of the strip's darkest place (of white), how far below and above it
/// half of what is between them is reached (deg), and red and blue over green of what is above the darkest,
/// all of profiles smoothed by two pixels. The error of a brightness is that of the pixels' noise; where a
/// camera or JPEG has smoothed that, it is too small (extract_profile()). The verdict is "good", or "none" if
/// no strip has such light. Throws sim::Error(scene) if the frame's size is not the camera's.
WorkAnswer profile_answer(const Photo& photo, const sim::Scene& scene, int channel);

}  // namespace vegard::fit
