// vegard brightness SCENE: how bright a scene is, in the words and units of people.
#pragma once

#include <CLI/CLI.hpp>

namespace vegard::apps {

void add_brightness_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
