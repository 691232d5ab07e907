#include "apps/options/photo_options.h"

#include <optional>

#include "apps/options/refusals.h"
#include "fit/photo/frames/frame_name.h"
#include "sim/base/file/input_file.h"
#include "sim/base/utc_time.h"
#include "sim/scene/rows/decoding_word.h"
#include "sim/view/colour/sensor_response.h"

namespace vegard::apps {

void add_decoding_option(const Command& command, std::string& word, SceneOfDecoding scene) {
  const bool has_scene = scene == SceneOfDecoding::known;
  const auto complaint_of = [has_scene](const std::string& text) {
    const auto complaint = sim::decoding_complaint(text);
    if (complaint) return complaint->problem + "; expected " + complaint->expected;
    if (!has_scene && text == "sensor")
      return std::string("there is no scene with a sensor; expected auto, srgb or linear");
    return std::string();
  };
  command
      .option("--decoding", word,
              has_scene ? "How the picture's numbers become light: auto (sRGB for integers, linear for "
                          "floats), srgb, srgb:EXPONENT, linear, gamma:2.2, curve:FILE.csv, sensor (inverse "
                          "of the scene's sensor), unknown or unknown:2 (fitted); default: the scene's"
                        : "How the picture's numbers become light: auto (the default: sRGB for integers, "
                          "linear for floats), srgb, srgb:EXPONENT, linear, gamma:2.2 or curve:FILE.csv")
      .check(complaint_of, "WORD");
}

fit::Decoding decoding_of(const std::string& word, const std::string& scene_word, const sim::Scene* scene) {
  return word.empty() ? fit::decoding_of_word(scene_word, scene) : fit::decoding_of_word(word);
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

void add_at_option(const Command& command, std::string& time) {
  command
      .option("--at", time,
              "Choose the frame of this time in a file of many (ISO 8601, UTC or with a zone); FILE#12 "
              "chooses by number, from 0")
      .type_name("TIME");
}

std::string picture_at(const std::string& picture, const std::string& time) {
  if (time.empty()) return picture;
  const std::optional<double> utc_s = sim::utc_seconds(time);
  if (!utc_s)
    throw usage_error("--at", "'" + time + "' is no time",
                      "ISO 8601 such as 2014-03-10T06:05:33Z, or with a zone, 2014-03-10T07:05:33+01:00");
  if (picture.empty()) throw usage_error("--at", "no photograph is named", "one with many frames in it");
  if (fit::frame_name(picture).is_chosen())
    throw usage_error("--at", "'" + picture + "' names a frame already", "one of both");
  // What cannot be read is reported where it is to be read.
  if (!sim::why_no_input(picture).empty()) return picture;
  if (!fit::is_frame_file(picture)) throw usage_error("--at", picture + " is no file of frames", "no --at");
  const std::vector<fit::FrameHead> frames = fit::frame_index(picture).frames;
  const int number = fit::frame_at(frames, *utc_s, picture);
  return frames.size() > 1 ? fit::name_of_frame(picture, number) : picture;
}

void add_no_metadata_option(const Command& command, bool& off) {
  command.flag("--no-metadata", off,
               "Do not fill what the scene leaves out (place, time, size, field of view, exposure) from the "
               "photograph's metadata");
}

}  // namespace vegard::apps
