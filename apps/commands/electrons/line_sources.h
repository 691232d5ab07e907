// `vegard lines --sources`: the brightness of lines due to precipitating electrons, for each source reaction.
#pragma once

#include <string>

#include "apps/commands/electrons/electron_options.h"
#include "apps/options/exit_code.h"

namespace vegard::apps {

struct LineSourcesRequest {
  ElectronOptions electrons;
  std::string reactions, output, plot;
  double oxygen_factor = 1.0;
  std::optional<double> seconds;
};

/// Adds the options that require the flag `sources`.
void add_line_source_options(const Command& command, const Option& sources, LineSourcesRequest& request);

ExitCode run_line_sources(const LineSourcesRequest& request, bool overwrite);

}  // namespace vegard::apps
