// How a photograph's numbers are taken, as a command line or a scene says it.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "fit/photo/photo.h"

namespace vegard::apps {

/// Adds --decoding; `word` stays empty if it is not given, and must outlive the parsing.
void add_decoding_option(CLI::App& command, std::string& word);

/// The command line's word (sim/scene/rows/decoding_word.h), or where it is empty the scene's. The scene's
/// table of a curve is that of `scene`, or a file in the folder `beside`; the command line's stands where it
/// says.
fit::Decoding decoding_of(const std::string& word, const std::string& scene_word,
                          const sim::Scene* scene = nullptr, const std::string& beside = {});

}  // namespace vegard::apps
