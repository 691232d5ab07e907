// `vegard describe PHOTO [-o SCENE.toml]`: what a picture says of itself, and a scene to begin with.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "sim/base/picture/picture_metadata.h"

namespace vegard::apps {

/// What is known, line by line, and what follows from it in a scene's keys.
std::string description_text(const std::string& photo_name, const sim::PictureMetadata& metadata);

/// Adds the subcommand; its callback sets `exit_code`, which must outlive the parsing, and throws sim::Error.
void add_describe_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
