#include "apps/decoding.h"

#include "sim/scene/rows/decoding_word.h"

namespace vegard::apps {

void add_decoding_option(CLI::App& command, std::string& word) {
  const CLI::Validator is_word(
      [](std::string& text) {
        const auto complaint = sim::decoding_complaint(text);
        return complaint ? complaint->problem + "; expected " + complaint->expected : std::string();
      },
      "WORD");
  command
      .add_option(
          "--decoding", word,
          "How numbers become light: auto (sRGB for integers, linear for floats), srgb, srgb:EXPONENT, "
          "linear, gamma:2.2, curve:FILE.csv, sensor (as the scene's sensor encodes), unknown or "
          "unknown:2 (a fit finds it); default: the scene's")
      ->check(is_word);
}

fit::Decoding decoding_of(const std::string& word, const std::string& scene_word, const sim::Scene* scene,
                          const std::string& beside) {
  return word.empty() ? fit::decoding_of_word(scene_word, scene, beside) : fit::decoding_of_word(word);
}

}  // namespace vegard::apps
