// What a command line says of the photograph that it names: its decoding, the filters that it was taken
// through, and whether its own words count.
#pragma once

#include <string>
#include <vector>

#include "apps/options/command.h"
#include "fit/photo/filter_stack.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Adds --decoding; `word` stays empty if it is not given, and must outlive the parsing.
void add_decoding_option(const Command& command, std::string& word);

/// The command line's word (sim/scene/rows/decoding_word.h), or where it is empty the scene's. The scene's
/// table of a curve is that of `scene`; the command line's stands where it says.
fit::Decoding decoding_of(const std::string& word, const std::string& scene_word,
                          const sim::Scene* scene = nullptr);

/// Adds --line; `words` stays empty if it is not given, and must outlive the parsing.
void add_filter_option(const Command& command, std::vector<std::string>& words);

/// The files that --line names. Throws Error(usage) for words of another shape.
std::vector<fit::FilterFile> filter_files(const std::vector<std::string>& words);

/// Throws Error(usage) unless the scene's sensor has a filter per line.
void check_filters(const sim::Scene& scene);

/// Adds --at; `time` stays empty if it is not given, and must outlive the parsing.
void add_at_option(const Command& command, std::string& time);

/// The picture's name, with the frame of its file chosen that was taken at `time`; as it is without one.
/// Throws Error(usage, unreadable_input).
std::string picture_at(const std::string& picture, const std::string& time);

/// Adds --no-metadata; `off` must outlive the parsing.
void add_no_metadata_option(const Command& command, bool& off);

}  // namespace vegard::apps
