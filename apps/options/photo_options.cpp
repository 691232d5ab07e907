#include "apps/options/photo_options.h"

#include "apps/options/refusals.h"
#include "sim/scene/rows/decoding_word.h"
#include "sim/view/colour/sensor_response.h"

namespace vegard::apps {

void add_decoding_option(const Command& command, std::string& word) {
  const auto complaint_of = [](const std::string& text) {
    const auto complaint = sim::decoding_complaint(text);
    return complaint ? complaint->problem + "; expected " + complaint->expected : std::string();
  };
  command
      .option("--decoding", word,
              "How numbers become light: auto (sRGB for integers, linear for floats), srgb, srgb:EXPONENT, "
              "linear, gamma:2.2, curve:FILE.csv, sensor (as the scene's sensor encodes), unknown or "
              "unknown:2 (a fit finds it); default: the scene's")
      .check(complaint_of, "WORD");
}

fit::Decoding decoding_of(const std::string& word, const std::string& scene_word, const sim::Scene* scene,
                          const std::string& beside) {
  return word.empty() ? fit::decoding_of_word(scene_word, scene, beside) : fit::decoding_of_word(word);
}

void add_filter_option(const Command& command, std::vector<std::string>& words) {
  command
      .option("--line", words,
              "A grey picture through the filter of one emission line, 557.7=a.fits; one to three of them, "
              "in place of a photograph")
      .type_name("NM=FILE")
      .repeated();
}

std::vector<fit::FilterFile> filter_files(const std::vector<std::string>& words) {
  std::vector<fit::FilterFile> files;
  for (const std::string& word : words) files.push_back(fit::filter_file(word));
  return files;
}

void check_filters(const sim::Scene& scene) {
  if (sim::sees_through_filters(scene)) return;
  throw usage_error("--line", "the scene's sensor.response is \"" + scene.sensor.response + "\"",
                    "\"filters\", an imager with a filter per line", "--set sensor.response=filters");
}

void add_no_metadata_option(const Command& command, bool& off) {
  command.flag("--no-metadata", off,
               "Do not take what the scene leaves out (place, time, size, field of view, exposure) from "
               "the photograph's own words");
}

}  // namespace vegard::apps
