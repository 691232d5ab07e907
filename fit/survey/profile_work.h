// The results of a survey that come from the vertical profiles of a frame: peak positions of strips of the
// picture, brightness, thickness and colour.
#pragma once

#include "fit/photo/photo.h"
#include "fit/survey/survey_answer.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

/// Number of adjacent strips into which the scene's region is divided; their items are 1, 2, ... from the
/// left.
inline constexpr int kSurveyStrips = 5;

/// Measures each strip whose light is significant above its noise, in profiles smoothed by two pixels:
/// azimuth and elevation (deg) of the brightest point in a channel; its brightness and that of the strip's
/// darkest point (as fractions of white); the angles (deg) below and above the brightest point at which half
/// of the difference is reached; and the ratios of red and of blue to green for the light above the darkest
/// point. The error of a brightness is that of the pixels' noise; if a camera or JPEG has smoothed the noise,
/// the error is too small (extract_profile()). The verdict is "good", or "none" if no strip has such light.
/// Throws sim::Error(scene) if the frame's size is not the camera's.
WorkAnswer profile_answer(const Photo& photo, const sim::Scene& scene, int channel);

}  // namespace vegard::fit
