// The keogram of one camera's night, made from the frames' pictures.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "fit/measure/keogram.h"
#include "fit/report/plot/plot.h"
#include "fit/survey/report/night_digest.h"
#include "fit/survey/report/night_plots.h"
#include "fit/survey/survey_frame.h"
#include "fit/survey/survey_plan.h"

namespace vegard::fit {

/// The frames of a survey and their cameras.
struct SurveyFrames {
  const SurveyPlan* plan = nullptr;
  EyeOfPlan eye;  ///< may throw sim::Error
};

struct NightKeogram {
  std::optional<Keogram> keogram;  ///< none: no frame could be shown
  int columns = 0;                 ///< number of frames in it
  int unreadable = 0;              ///< number of selected frames that could not be read
  std::string why_none;            ///< why there is no keogram
};

/// Makes the keogram from one measured frame in each of `most` equal intervals of the night. It is along the
/// vertical plane at the camera's azimuth (or that of the magnetic meridian, if the camera looks higher than
/// 60 degrees); if the pictures do not show this plane, it consists of their middle columns. Frames that
/// cannot be read, or whose camera, size or decoding differs from the first one's, are left out. The result
/// does not depend on the number of threads.
NightKeogram night_keogram(const SurveyReader& reader, const CameraNight& night, const SurveyFrames& frames,
                           int most);

/// Returns where a border crosses the keogram's plane, as an angle on the keogram's axis: the elevation at
/// the azimuth at which the axis begins, or 180 degrees minus the elevation beyond the zenith. Between its
/// two azimuths the border is taken for the great circle that is highest where the border is; it is not
/// continued beyond them. None if the border does not reach the plane, or the keogram's positions are rows.
std::optional<double> crossing_deg(const BorderAtTime& border, const KeogramLine& line);

/// Plots the keogram with the border over it where the border crosses the keogram's plane, for the same span
/// of time as the other plots of the page.
Plot keogram_with_border(const Keogram& keogram, const NightDigest& digest, const ShownSpan& span);

}  // namespace vegard::fit
