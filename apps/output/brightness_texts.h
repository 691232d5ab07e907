// The brightness of a scene as text and as JSON.
#pragma once

#include <string>

#include "sim/render/brightness_report.h"

namespace vegard::apps {

/// As text in aligned columns, with a new line at the end.
std::string brightness_text(const sim::BrightnessReport& report);

/// As JSON: docs/file_formats.md, "Brightness (JSON)".
std::string brightness_json(const sim::BrightnessReport& report);

}  // namespace vegard::apps
