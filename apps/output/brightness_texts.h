// What is known of a scene's brightness, as text and as JSON.
#pragma once

#include <string>

#include "sim/render/brightness_report.h"

namespace vegard::apps {

/// For people: aligned, with a new line at the end.
std::string brightness_text(const sim::BrightnessReport& report);

/// For programs: docs/file_formats.md, "Brightness (JSON)".
std::string brightness_json(const sim::BrightnessReport& report);

}  // namespace vegard::apps
