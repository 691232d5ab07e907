// From a photograph to an answer: the stages of `vegard measure`, one after the other.
//
// Every stage is a command of vegard's own, which is shown and kept: what a stage writes is what the command
// writes, and whoever wants something else at one stage goes on by hand from there. A stage that fails ends
// nothing: the measurement says what it lacked, and what can be had without it.
#pragma once

#include <string>

#include "fit/measurement/measurement.h"

namespace vegard::fit {

/// Writes the folder with its report and returns what is in it. Throws Error(usage) for a time that nobody
/// can read, Error(unreadable_input, scene) for a picture or a camera that is none, before anything is
/// written; Error(existing_output, unwritable_output).
Measurement measure(const MeasureRequest& request, const MeasureFollower& follower = {});

/// Returns the page, which shows pictures in its own folder. The same measurement gives the same bytes.
std::string measure_page(const Measurement& measurement);

/// The stages with their numbers, and the answer.
std::string measure_json(const Measurement& measurement);

}  // namespace vegard::fit
