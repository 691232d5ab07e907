// What a survey's fits say of the emission tables, as their database has it.
#pragma once

#include <optional>
#include <string>

#include "fit/sequence.h"
#include "fit/shared_physics.h"
#include "fit/survey/survey.h"

namespace vegard::fit {

/// Returns what the frame says of the modes, and how its main numbers (fit/report/table/sequence_files.h)
/// follow them, with nine and six digits; none if it says nothing.
std::optional<std::string> physics_of_row(const SequenceRow& row);

/// Returns the answer of a fit as one picture of a night; without such knowledge, one that says nothing.
/// Throws sim::Error(unreadable_input), naming `database`, if WorkAnswer::physics is something else.
FrameOfNight frame_of_night(const WorkAnswer& fit, const std::string& database);

}  // namespace vegard::fit
