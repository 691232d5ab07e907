// Reads and writes scene files, which are TOML.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Reads and validates a scene file. Alternative forms are converted to the canonical one: start_km + end_km
/// to centre, bearing and length; focal_length_mm + sensor_width_mm to hfov_deg. Throws
/// Error(unreadable_input) if there is no such file, Error(scene) with file, line, key, expected and hint.
Scene read_scene(const std::string& file);

/// The same from text; messages show `name` as the file.
Scene parse_scene(const std::string& text, const std::string& name);

/// Returns a valid scene file with every value at full precision: parse_scene(write_scene(s)) == s. `comment`
/// becomes the leading comment, one '#' per line.
std::string write_scene(const Scene& scene, const std::string& comment = {});

}  // namespace vegard::sim
