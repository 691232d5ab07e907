// The stages of a measurement, in their order. Each does its command's work, tells what it found, and puts
// that into the run.
#pragma once

#include <string>

#include "fit/measurement/measure_run.h"

namespace vegard::fit {

// The picture (picture_stages.cpp).

/// What the picture says of itself.
void describe_picture(MeasureRun& run);
/// Which part of it is sky.
void find_sky(MeasureRun& run);
/// Whether the skyline is the ground's: a light's sharp lower border over a dark sky may have passed for one,
/// and what is below it is sky then.
void doubt_skyline(MeasureRun& run);

// Where the camera points (pointing_stages.cpp).

/// The title of the stage that tries a skyline.
inline constexpr const char* kHorizonStage = "Where the camera points: the horizon";

/// By its file, by stars, or by a skyline.
void find_camera(MeasureRun& run);

// The light (light_stages.cpp).

/// The lower border.
void measure_border(MeasureRun& run);
/// A map of the electrons near the borders, if one is wanted and possible.
void measure_map(MeasureRun& run);
/// Its two parts. The first begins the stage and writes the mask and the scene; it says there what is lacking
/// and returns it, part of a sentence, where no map is possible; else an empty text. The second makes the
/// map.
std::string prepare_map(MeasureRun& run);
void finish_map(MeasureRun& run);

// All of them (measure.cpp).

/// The stages before the map.
void measure_before_map(MeasureRun& run);
/// The answer by what the stages have found up to now: written and told.
void conclude_measurement(MeasureRun& run);

}  // namespace vegard::fit
