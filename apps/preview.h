// `vegard preview`: a scene at reduced cost, to try its parameters: in a window, or as frames.
#pragma once

#include <CLI/CLI.hpp>

namespace vegard::apps {

void add_preview_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
