// Scene files: TOML in and out.
#pragma once

#include <string>

#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Reads and validates a scene file. Alternative forms are turned into the canonical one: start_km + end_km
/// into centre, bearing and length; focal_length_mm + sensor_width_mm into hfov_deg. Throws
/// Error(unreadable_input) if there is no such file, Error(scene) with file, line, key, expected and hint.
Scene read_scene(const std::string& file);

/// The same from text; `name` stands for the file in messages.
Scene parse_scene(const std::string& text, const std::string& name);

/// A valid scene file with every value written out at full precision: parse_scene(write_scene(s)) == s.
/// `comment` becomes the leading comment, one '#' a line.
std::string write_scene(const Scene& scene, const std::string& comment = {});

}  // namespace vegard::sim
