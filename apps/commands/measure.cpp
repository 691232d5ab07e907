#include "apps/commands/commands.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/refusals.h"
#include "apps/options/site_words.h"
#include "apps/options/standard_streams.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "fit/answer/trust.h"
#include "fit/measurement/measure.h"
#include "fit/measurement/together/measure_together.h"

namespace vegard::apps {
namespace {

/// The words of the command line; lists have one for each of several photographs.
struct MeasureWords {
  fit::MeasureRequest request;
  std::vector<std::string> photos, times, sites, cameras, masks;
  std::string at, earth = "wgs84";
  double clock_error_s = 2.0, drift_km_s = 0.5;
  std::optional<double> pointing_error_deg;
};

/// The value for one of several pictures, of a list with one for each or none; an empty one is none.
std::string value_for(const std::string& key, const std::vector<std::string>& values, std::size_t picture,
                      std::size_t pictures) {
  if (values.empty()) return {};
  if (values.size() == pictures) return values[picture];
  throw usage_error(key, fmt::format("it is given {} times for {} photographs", values.size(), pictures),
                    "once for each photograph, in their order");
}

fit::MeasureRequest request_for(const MeasureWords& words, std::size_t picture) {
  const std::size_t pictures = words.photos.size();
  fit::MeasureRequest request = words.request;
  request.photo = picture_at(words.photos[picture], words.at);
  request.time = value_for("--time", words.times, picture, pictures);
  request.camera = value_for("--camera", words.cameras, picture, pictures);
  request.mask = value_for("--mask", words.masks, picture, pictures);
  const std::string site = value_for("--site", words.sites, picture, pictures);
  if (!site.empty()) request.site = site_of_text(site);
  return request;
}

/// Says what is found, and lets the maps be interrupted.
fit::MeasureFollower follower() {
  return {said_with_progress(), [](fit::MapOptions& map) {
            map.stop = &watch_for_interrupt();
            map.progress = map_progress();
          }};
}

int run_measure_together(const MeasureWords& words) {
  fit::TogetherRequest together;
  together.out = words.request.out;
  if (together.out.empty())
    throw usage_error("--out", "is missing", "the folder to write, for several photographs");
  together.overwrite = words.request.overwrite;
  together.resume = words.request.resume;
  together.no_map = words.request.no_map;
  together.command = words.request.command;
  together.earth = words.earth == "sphere" ? fit::EarthShape::sphere : fit::EarthShape::wgs84;
  together.clock_error_s = words.clock_error_s;
  together.drift_km_s = words.drift_km_s;
  together.pointing_error_deg = words.pointing_error_deg;
  for (std::size_t i = 0; i < words.photos.size(); ++i) together.pictures.push_back(request_for(words, i));
  end_at_once_when_interrupted();
  const fit::TogetherMeasurement found = fit::measure_together(together, follower());
  answer_with(fit::together_json(found));
  json_answer()["report"] = found.out + "/report.html";
  if (found.is_map_interrupted) return exit_code_of_interruption();
  return found.trust == fit::Trust::good ? good : doubted;
}

int run_measure(const MeasureWords& words) {
  if (words.photos.size() > 1) return run_measure_together(words);
  const fit::MeasureRequest request = request_for(words, 0);
  end_at_once_when_interrupted();
  const fit::Measurement found = fit::measure(request, follower());
  answer_with(fit::measure_json(found));
  json_answer()["report"] = found.out + "/report.html";
  if (found.is_map_interrupted) return exit_code_of_interruption();
  return found.trust == fit::Trust::good ? good : doubted;
}

}  // namespace

void add_measure_command(Program& program) {
  const auto words = std::make_shared<MeasureWords>();
  fit::MeasureRequest& request = words->request;
  request.command = program.command_line();
  const Command command = program.add(
      "measure", "Find camera, distance and, where possible, energy or height of the aurora in photographs");
  command
      .option("PHOTO", words->photos,
              "A photograph of any format that is read; two or more of the same aurora from other places "
              "give its "
              "height by geometry")
      .required();
  add_at_option(command, words->at);
  command
      .option(
          "--time", words->times,
          "Beginning of the exposure, ISO 8601 in UTC or with a zone (default: from the picture's metadata)")
      .repeated()
      .one_an_occurrence()
      .type_name("TIME");
  add_repeated_site_option(command, words->sites);
  command.option("--out", request.out, "The folder to write (default: PHOTO's name with _measured)")
      .type_name("RUN");
  command.option("--camera", words->cameras, "A camera file, if the pointing is known")
      .repeated()
      .one_an_occurrence()
      .type_name("CAMERA.toml");
  command.option("--mask", words->masks, "A mask of the sky, if there is one: white = use")
      .repeated()
      .one_an_occurrence()
      .type_name("IMAGE");
  command
      .option("--line", request.line_nm, "Wavelength of the emission line, of a picture through one filter")
      .type_name("NM")
      .range(100.0, 2000.0)
      .shows_default();
  add_decoding_option(command, request.decoding, SceneOfDecoding::none);
  command.option("--replicates", request.replicates, "Perturbed solutions for the map's error bars")
      .range(0, 1000)
      .shows_default();
  add_threads_option(command, request.threads);
  command.flag("--no-map", request.no_map, "Leave out the map of precipitation");
  command.flag("--overwrite", request.overwrite, "Replace a measurement that exists");
  command.flag("--resume", request.resume,
               "Go on with a measurement that was interrupted, from the finished steps of its map");
  command
      .option("--clock-error", words->clock_error_s,
              "Of several photographs: standard error of each camera's clock, in s")
      .type_name("S")
      .finite_range(0.0, 60.0)
      .shows_default();
  command
      .option("--drift-km-s", words->drift_km_s,
              "Of several photographs: how fast the light may drift, standard deviation of each component")
      .finite_range(0.0, 100.0)
      .shows_default();
  command
      .option(
          "--pointing-error", words->pointing_error_deg,
          "Of several photographs: standard error of the cameras' directions (default: as their files say)")
      .type_name("DEG")
      .finite_range(0.0, 30.0);
  command
      .option("--earth", words->earth,
              "Of several photographs: the ellipsoid with refraction, or the sphere of this program's scenes")
      .one_of({"wgs84", "sphere"})
      .shows_default();
  command.runs([words] { return run_measure(*words); });
}

}  // namespace vegard::apps
