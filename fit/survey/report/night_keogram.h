// The keogram of one camera's night, of the frames themselves.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "fit/measure/keogram.h"
#include "fit/report/plot/plot.h"
#include "fit/survey/report/night_digest.h"
#include "fit/survey/report/night_plots.h"
#include "fit/survey/survey_eye.h"
#include "fit/survey/survey_plan.h"

namespace vegard::fit {

/// Where the frames of a survey are, and what their cameras are.
struct SurveyFrames {
  const SurveyPlan* plan = nullptr;
  std::function<SurveyEye(int camera, int calibration)> eye;  ///< of the plan's; may throw sim::Error
};

struct NightKeogram {
  std::optional<Keogram> keogram;  ///< none: no frame could be shown
  int columns = 0;                 ///< frames that are in it
  int unreadable = 0;              ///< that were to be, and could not be read
  std::string why_none;            ///< of no keogram
};

/// Of the frames that were measured one in each of `most` equal stretches of the night; along the plane
/// through the zenith at the camera's azimuth (that of the magnetic meridian, if the camera looks higher than
/// 60 degrees), or, where it shows nothing of it, of the picture's middle columns. A frame whose camera,
/// size or decoding is not that of the first, or that cannot be read, is left out. The same for every number
/// of threads.
NightKeogram night_keogram(const SurveyReader& reader, const CameraNight& night, const SurveyFrames& frames,
                           int most);

/// The keogram with the border over it, on the same span of time as the other plots of the page.
Plot keogram_with_border(const Keogram& keogram, const NightDigest& digest, const ShownSpan& span);

}  // namespace vegard::fit
