// `vegard animate SCENE -o frames/####.exr` or `-o movie.mp4`: a scene over time.
#pragma once

#include <CLI/CLI.hpp>

#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// The scene of frame n: time.start_s + n / fps, in double precision, all else as it is. Printed with as many
/// digits as it takes to read the same number again, it can be given to `vegard render --set time.start_s`.
sim::Scene scene_of_frame(const sim::Scene& scene, int frame, double frames_per_second);

/// Adds the subcommand; its callback sets `exit_code`, which must outlive the parsing, and throws sim::Error.
void add_animate_command(CLI::App& app, int& exit_code);

}  // namespace vegard::apps
