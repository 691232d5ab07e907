#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands/commands.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/photographs.h"
#include "apps/options/refusals.h"
#include "apps/options/scene_options.h"
#include "apps/options/spectrum_options.h"
#include "apps/options/standard_streams.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "fit/measurement/sky_light.h"
#include "fit/photo/filter_stack.h"
#include "fit/photo/photo.h"
#include "fit/report/map_run.h"
#include "fit/search/file_journal.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/sha256.h"

namespace vegard::apps {
namespace {

struct MapRequest {
  std::string memory_limit;
  SceneOptions scene;
  PhotoWords photo;
  SpectrumOptions spectrum;
  std::string out;
  int threads = 0;
  int replicates = fit::MapOptions().replicates;
  double sparsity = 0.0;
  double farthest_km = 0.0;
  double altitude_scale = fit::MapOptions().altitude_scale;
  bool overwrite = false, resume = false, no_metadata = false, netcdf = false;
};

std::vector<NamedInput> files_of_map(const MapRequest& options, const sim::Scene& scene) {
  std::vector<NamedInput> inputs = inputs_of_scene(options.scene, scene);
  inputs.push_back({options.photo.file, "the photograph"});
  inputs.push_back({options.photo.mask, "the mask"});
  for (const fit::FilterFile& filter : filter_files(options.photo.filters))
    inputs.push_back({filter.file, "the photograph"});
  return inputs;
}

fit::JournalMode journal_mode(const MapRequest& options) {
  if (options.resume) return fit::JournalMode::resume;
  return options.overwrite ? fit::JournalMode::overwrite : fit::JournalMode::fresh;
}

int run_map(const MapRequest& options, const std::string& command) {
  const sim::ElectronSpectrum spectrum = electron_spectrum(options.spectrum);
  sim::Scene scene = scene_of(options.scene);
  const std::string scene_sha256 = sim::sha256_of_file(options.scene.file);
  if (options.out.empty()) throw usage_error("--out", "is missing", "the directory to write");
  const bool replaces = options.overwrite || (options.resume && fit::is_interrupted_map(options.out));
  protect_inputs_inside("--out", options.out, files_of_map(options, scene));
  fit::check_map_directory(options.out, replaces);
  std::vector<fit::PhotoFact> from_photograph;
  const std::string photo =
      options.photo.filters.empty() ? options.photo.file : filter_files(options.photo.filters).front().file;
  if (scene.fit.photos.empty() && !photo.empty() && !options.no_metadata)
    from_photograph = take_from_photograph(scene, photo, options.scene.changes);
  const std::vector<fit::Photo> photos = photographs_asked(options.photo, scene);
  fit::MapOptions map_options;
  map_options.threads = options.threads;
  map_options.replicates = options.replicates;
  map_options.sparsity = options.sparsity;
  map_options.farthest_km = options.farthest_km;
  map_options.altitude_scale = options.altitude_scale;
  map_options.spectrum = spectrum;
  map_options.stop = &watch_for_interrupt();
  fit::FileJournal journal(fit::journal_file(options.out), fit::subject_of_map(map_options, scene, photos),
                           journal_mode(options));
  if (journal.found() > 0) tell_progress("vegard: going on after %d finished steps\n", journal.found());
  map_options.progress = map_progress();
  std::optional<fit::PhotoMap> made;
  try {
    made = fit::mapped_photos(scene, photos, std::move(map_options), journal);
  } catch (const fit::MapStopped&) {
    tell("vegard: interrupted before there was a map; the same command with --resume goes on\n");
    return exit_code_of_interruption();
  }
  const fit::PhotoMap& map = *made;
  if (!journal.problem().empty()) tell("vegard: this map cannot be resumed: %s\n", journal.problem().c_str());
  fit::MapRunFacts facts;
  facts.command = command;
  facts.netcdf = options.netcdf;
  facts.inputs = fit::inputs_of(options.scene.file, scene_sha256, photos);
  facts.from_photograph = from_photograph;
  fit::write_map(map, photos, options.out, replaces, facts, journal, said());
  if (map.result.interrupted) tell("vegard: interrupted; the same command with --resume goes on\n");
  answer_with(sim::input_bytes(options.out + "/map.json", "a map"));
  json_answer()["report"] = options.out + "/report.html";
  return map.result.interrupted ? interrupted : map.is_good() ? good : doubted;
}

}  // namespace

void add_map_command(Program& program) {
  const auto options = std::make_shared<MapRequest>();
  const Command command = program.add(
      "map", "Map the precipitation that a photograph shows, of any shape, and find its curtains");
  add_scene_options(command, options->scene);
  command
      .option("--photo", options->photo.file,
              "A photograph of any format that is read; left out: those of the scene's [[fit.photo]]")
      .type_name("IMAGE");
  add_filter_option(command, options->photo.filters);
  add_at_option(command, options->photo.at);
  command.option("--out", options->out, "The directory to write").type_name("RUN");
  command.option("--mask", options->photo.mask, "An image of the same size: white = use").type_name("IMAGE");
  add_decoding_option(command, options->photo.decoding);
  add_no_metadata_option(command, options->no_metadata);
  add_threads_option(command, options->threads);
  command
      .option("--replicates", options->replicates,
              "Perturbed solutions from which error bars follow (0: no error bars)")
      .range(0, 1000)
      .shows_default();
  command
      .option(
          "--sparsity", options->sparsity,
          "Penalty of each lit cell, in chi2 / 2 (0: chosen by cross-validation over blocks of the picture)")
      .range(0.0, 1000.0);
  command
      .option("--farthest-km", options->farthest_km,
              "Farthest distance that is mapped (0: as far as the picture shows a lower border)")
      .range(0.0, 2000.0);
  command
      .option("--altitude-scale", options->altitude_scale,
              "Multiply all altitudes of the tables' atmosphere by this, to see what changes")
      .range(0.9, 1.2)
      .shows_default();
  add_spectrum_options(command, options->spectrum);
  command.flag("--netcdf", options->netcdf, "Also write the map as netCDF: RUN/precipitation.nc");
  command.flag("--overwrite", options->overwrite,
               "Replace an existing map; without --resume, discard the steps of an interrupted one");
  command.flag("--resume", options->resume,
               "Continue a map that was interrupted, from the finished steps in RUN.part");
  command.runs([options, words = program.command_line()] {
    options->photo = with_frames_chosen(options->photo);
    return run_map(*options, words);
  });
}

}  // namespace vegard::apps
