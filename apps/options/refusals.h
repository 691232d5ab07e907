// Errors of the command line or of the scene that it names, with their place.
#pragma once

#include "fit/measurement/words.h"
#include "sim/scene/structs/line_of.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

// Errors about an option, and errors of the scene, with its file and line.
using fit::usage_error;
using sim::placing_errors;
using sim::with_place;

}  // namespace vegard::apps
