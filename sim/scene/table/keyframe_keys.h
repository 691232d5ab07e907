// The keys of [[key]], each named once for the reader, the writer and the listings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/structs/keyframe.h"

namespace vegard::sim {

inline const char* const key_table = "key";
inline const char* const key_time = "time_s";
inline const char* const key_path_word = "path";
inline const char* const key_value = "value";
inline const char* const key_ease = "ease";

struct KeyframeKey {
  std::string key, unit, meaning, type;
};
const std::vector<KeyframeKey>& keyframe_keys();

/// Returns nothing for an unknown word.
std::optional<KeyEase> ease_of_word(const std::string& word);
std::string word_of_ease(KeyEase ease);
/// All words: "\"monotone\", … or \"hold\"".
std::string ease_type();

}  // namespace vegard::sim
