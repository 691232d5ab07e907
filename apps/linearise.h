// `vegard linearise`: a photograph back to linear light, by a scene's sensor.
#pragma once

#include <CLI/CLI.hpp>

namespace vegard::apps {

void add_linearise_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
