// --line NM=FILE: one file per filter in place of a photograph.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "fit/photo/filter_stack.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Adds --line; `words` stays empty if it is not given, and must outlive the parsing.
void add_filter_option(CLI::App& command, std::vector<std::string>& words);

/// The files that --line names. Throws Error(usage) for words of another shape.
std::vector<fit::FilterFile> filter_files(const std::vector<std::string>& words);

/// Throws Error(usage) unless the scene's sensor has a filter per line.
void check_filters(const sim::Scene& scene);

}  // namespace vegard::apps
