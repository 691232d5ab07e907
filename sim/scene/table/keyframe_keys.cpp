#include "sim/scene/table/keyframe_keys.h"

#include <array>
#include <utility>

namespace vegard::sim {
namespace keyframe_keys_table {

constexpr std::array<std::pair<KeyEase, const char*>, 5> kEases = {{{KeyEase::monotone, "monotone"},
                                                                    {KeyEase::catmull_rom, "catmull-rom"},
                                                                    {KeyEase::linear, "linear"},
                                                                    {KeyEase::smooth, "smooth"},
                                                                    {KeyEase::hold, "hold"}}};

}  // namespace keyframe_keys_table

const std::vector<KeyframeKey>& keyframe_keys() {
  static const std::vector<KeyframeKey> keys = {
      {key_time, "s", "on the scene's clock; the keys of a path in order", "a number"},
      {key_path_word, "", "of a number or a vector of the scene", "a text"},
      {key_value, "", "its value then; of a vector one for each component", "a number or an array of them"},
      {key_ease, "", "the way on to the next key; default \"monotone\"", ease_type()},
  };
  return keys;
}

std::optional<KeyEase> ease_of_word(const std::string& word) {
  for (const auto& [ease, its_word] : keyframe_keys_table::kEases)
    if (word == its_word) return ease;
  return std::nullopt;
}

std::string word_of_ease(KeyEase ease) {
  return keyframe_keys_table::kEases[static_cast<std::size_t>(ease)].second;
}

std::string ease_type() {
  std::string words;
  for (const auto& [ease, word] : keyframe_keys_table::kEases)
    words += (words.empty()           ? std::string()
              : ease == KeyEase::hold ? std::string(" or ")
                                      : std::string(", ")) +
             "\"" + word + "\"";
  return words;
}

}  // namespace vegard::sim
