// Command-line options for a photograph: its decoding, the filters through which it was taken, its time, and
// whether its metadata are used.
#pragma once

#include <string>
#include <vector>

#include "apps/options/command.h"
#include "fit/photo/filter_stack.h"
#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Whether a command has a scene, whose decoding is the default and whose sensor can be inverted.
enum class SceneOfDecoding { known, none };

/// Adds --decoding; `word` stays empty if it is not given, and must outlive the parsing. Without a scene the
/// option refuses "sensor".
void add_decoding_option(const Command& command, std::string& word,
                         SceneOfDecoding scene = SceneOfDecoding::known);

/// Returns the decoding of the command line's word (sim/scene/rows/decoding_word.h) or, if that is empty, of
/// the scene's word. A curve table named by the scene's word is the one in `scene`; one named on the command
/// line is read from its file.
fit::Decoding decoding_of(const std::string& word, const std::string& scene_word,
                          const sim::Scene* scene = nullptr);

/// Adds --line; `words` stays empty if it is not given, and must outlive the parsing.
void add_filter_option(const Command& command, std::vector<std::string>& words);

/// The files in the values of --line. Throws Error(usage) for values of another form.
std::vector<fit::FilterFile> filter_files(const std::vector<std::string>& words);

/// Throws Error(usage) unless the scene's sensor has a filter per line.
void check_filters(const sim::Scene& scene);

/// Adds --at; `time` stays empty if it is not given, and must outlive the parsing.
void add_at_option(const Command& command, std::string& time);

/// Returns the picture's name with the frame of its file that was taken at `time`; unchanged if `time` is
/// empty. Throws Error(usage, unreadable_input).
std::string picture_at(const std::string& picture, const std::string& time);

/// Adds --no-metadata; `off` must outlive the parsing.
void add_no_metadata_option(const Command& command, bool& off);

}  // namespace vegard::apps
