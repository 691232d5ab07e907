// How a photograph's numbers are taken, as a command line or a scene says it.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "fit/photo.h"

namespace vegard::apps {

/// Adds --decoding; `word` stays empty if it is not given, and must outlive the parsing.
void add_decoding_option(CLI::App& command, std::string& word);

/// "auto", "srgb", "linear" or "sensor": the command line's word, or where it is empty the scene's.
fit::Decoding decoding_of(const std::string& word, const std::string& scene_word);

}  // namespace vegard::apps
