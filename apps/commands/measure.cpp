#include "apps/commands/commands.h"

#include <memory>
#include <string>
#include <vector>

#include "apps/options/exit_code.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/site_words.h"
#include "apps/options/standard_streams.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "fit/answer/trust.h"
#include "fit/measurement/measure.h"

namespace vegard::apps {
namespace {

int run_measure(fit::MeasureRequest request, const std::string& at, const std::vector<std::string>& site) {
  request.photo = picture_at(request.photo, at);
  if (!site.empty()) request.site = site_place(site);
  end_at_once_when_interrupted();
  const fit::Measurement found = fit::measure(request, {said_with_progress(), [](fit::MapOptions& map) {
                                                          map.stop = &watch_for_interrupt();
                                                          map.progress = map_progress();
                                                        }});
  answer_with(fit::measure_json(found));
  json_answer()["report"] = found.out + "/report.html";
  if (found.is_map_interrupted) return exit_code_of_interruption();
  return found.trust == fit::Trust::good ? good : doubted;
}

}  // namespace

void add_measure_command(Program& program) {
  struct MeasureWords {
    fit::MeasureRequest request;
    std::string at;
    std::vector<std::string> site;
  };
  const auto words = std::make_shared<MeasureWords>();
  fit::MeasureRequest& request = words->request;
  request.command = program.command_line();
  const Command command = program.add(
      "measure", "Find camera, distance and, where possible, energy of the aurora in one photograph");
  command.option("PHOTO", request.photo, "A photograph of any format that is read").required();
  add_at_option(command, words->at);
  command
      .option(
          "--time", request.time,
          "Beginning of the exposure, ISO 8601 in UTC or with a zone (default: from the picture's metadata)")
      .type_name("TIME");
  add_site_option(command, words->site);
  command.option("--out", request.out, "The folder to write (default: PHOTO's name with _measured)")
      .type_name("RUN");
  command.option("--camera", request.camera, "A camera file, if the pointing is known")
      .type_name("CAMERA.toml");
  command.option("--mask", request.mask, "A mask of the sky, if there is one: white = use")
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
  command.runs([words] { return run_measure(words->request, words->at, words->site); });
}

}  // namespace vegard::apps
