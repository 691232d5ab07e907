#include "apps/decoding.h"

namespace vegard::apps {

void add_decoding_option(CLI::App& command, std::string& word) {
  command
      .add_option(
          "--decoding", word,
          "auto: sRGB for integers, linear for floats; sensor: as the scene's sensor encodes (default: the "
          "scene's)")
      ->check(CLI::IsMember({"auto", "srgb", "linear", "sensor"}));
}

fit::Decoding decoding_of(const std::string& word, const std::string& scene_word) {
  const std::string& said = word.empty() ? scene_word : word;
  if (said == "srgb") return fit::Decoding::srgb;
  if (said == "linear") return fit::Decoding::linear;
  if (said == "sensor") return fit::Decoding::sensor;
  return fit::Decoding::automatic;
}

}  // namespace vegard::apps
