#include <unistd.h>

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/commands.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/memory_limit.h"
#include "apps/options/photo_options.h"
#include "apps/options/photographs.h"
#include "apps/options/refusals.h"
#include "apps/options/scene_options.h"
#include "apps/options/standard_streams.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "fit/map/curtains.h"
#include "fit/map/map_fit.h"
#include "fit/map/map_verdicts.h"
#include "fit/photo/filter_stack.h"
#include "fit/photo/photo.h"
#include "fit/report/map_run.h"
#include "fit/search/file_journal.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/sha256.h"
#include "sim/base/version.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/table_files.h"

namespace vegard::apps {
namespace {

struct MapRequest {
  std::string memory_limit;
  SceneOptions scene;
  PhotoWords photo;
  std::string out;
  int threads = 0;
  int replicates = fit::MapOptions().replicates;
  double sparsity = 0.0;
  double farthest_km = 0.0;
  double altitude_scale = fit::MapOptions().altitude_scale;
  bool overwrite = false, resume = false, no_metadata = false, netcdf = false;
};

/// What the map reports while it works: a bar on a terminal, elsewhere one line a stage.
class MapAccount {
 public:
  void tell(const std::string& stage, double chi2_per_value, double share) {
    const std::string text = stage + ": chi2 / values " + sim::short_number(chi2_per_value, 3);
    bar_.update(share, text);
    if (isatty(STDERR_FILENO) == 1 || !stages_.insert(stage).second) return;
    const std::optional<double> to_go = bar_.seconds_to_go();
    apps::tell_progress("%s (%s%s)\n", stage.c_str(), duration_text(bar_.elapsed_seconds()).c_str(),
                        to_go ? (", about " + duration_text(*to_go) + " to go").c_str() : "");
  }

 private:
  ProgressBar bar_{"mapping"};
  std::set<std::string> stages_;
};

std::vector<NamedInput> files_of_map(const MapRequest& options, const sim::Scene& scene) {
  std::vector<NamedInput> inputs = inputs_of_scene(options.scene, scene);
  inputs.push_back({options.photo.file, "the photograph"});
  inputs.push_back({options.photo.mask, "the mask"});
  for (const fit::FilterFile& filter : filter_files(options.photo.filters))
    inputs.push_back({filter.file, "the photograph"});
  return inputs;
}

fit::JournalSubject subject_of(const MapRequest& options, const sim::Scene& scene,
                               const std::vector<fit::Photo>& photos) {
  fit::JournalSubject subject = {{"the version of vegard", sim::version()},
                                 {"the kind of work", "a map"},
                                 {"the scene", sim::sha256(sim::write_scene(scene))},
                                 {"--sparsity", sim::short_number(options.sparsity, 17)},
                                 {"--farthest-km", sim::short_number(options.farthest_km, 17)},
                                 {"--altitude-scale", sim::short_number(options.altitude_scale, 17)}};
  for (const auto& [path, sum] : sim::table_sums(scene)) subject.push_back({"the table of " + path, sum});
  for (std::size_t i = 0; i < photos.size(); ++i) {
    const std::string which = photos.size() > 1 ? " " + std::to_string(i + 1) : "";
    subject.push_back({"the photograph" + which, photos[i].sha256});
    subject.push_back({"the mask" + which, photos[i].mask_sha256});
    subject.push_back({"the decoding" + which, photos[i].decoding});
  }
  return subject;
}

fit::JournalMode journal_mode(const MapRequest& options) {
  if (options.resume) return fit::JournalMode::resume;
  return options.overwrite ? fit::JournalMode::overwrite : fit::JournalMode::fresh;
}

ExitCode exit_code_of(const fit::MapResult& result, const std::vector<fit::QuantityVerdict>& verdicts) {
  if (result.interrupted) return interrupted;
  for (const fit::QuantityVerdict& v : verdicts)
    if (v.trust != fit::Trust::good) return doubted;
  return good;
}

int run_map(const MapRequest& options, const std::string& command) {
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
  fit::FileJournal journal(fit::journal_file(options.out), subject_of(options, scene, photos),
                           journal_mode(options));
  if (journal.found() > 0) tell_progress("vegard: going on after %d finished steps\n", journal.found());

  fit::MapOptions map_options;
  map_options.threads = options.threads;
  map_options.replicates = options.replicates;
  map_options.sparsity = options.sparsity;
  map_options.farthest_km = options.farthest_km;
  map_options.altitude_scale = options.altitude_scale;
  map_options.journal = &journal;
  map_options.stop = &watch_for_interrupt();
  fit::MapResult result = [&] {
    MapAccount account;
    map_options.progress = [&account](const std::string& stage, double chi2, double share) {
      account.tell(stage, chi2, share);
    };
    try {
      return placing_errors(scene, [&] { return fit::map_photos(scene, photos, map_options); });
    } catch (const sim::Error&) {
      journal.remove();  // there is nothing to go on with
      throw;
    }
  }();
  if (!journal.problem().empty()) tell("vegard: this map cannot be resumed: %s\n", journal.problem().c_str());
  const std::vector<fit::Curtain> curtains = fit::find_curtains(result);
  fit::MapRunFacts facts;
  facts.faint = fit::find_faint_curtains(result);
  facts.command = command;
  facts.netcdf = options.netcdf;
  facts.inputs = fit::inputs_of(options.scene.file, scene_sha256, photos);
  facts.from_photograph = from_photograph;
  for (std::size_t i = 0; i < photos.size(); ++i)
    facts.decodings.emplace_back(result.photos[i].name, photos[i].decoding);
  fit::write_map_run(options.out, replaces, result, curtains, facts);
  if (result.interrupted)
    tell("vegard: interrupted; the same command with --resume goes on\n");
  else
    journal.remove();
  answer_with(sim::input_bytes(options.out + "/map.json", "a map"));
  json_answer()["report"] = options.out + "/report.html";
  const std::vector<fit::QuantityVerdict> verdicts = fit::map_verdicts(result, curtains);
  for (const fit::QuantityVerdict& v : verdicts)
    say_verdict(v.trust == fit::Trust::good ? Tone::good : Tone::doubtful,
                v.quantity + ": " + fit::trust_name(v.trust) + (v.value.empty() ? "" : ", ") + v.value +
                    " (" + v.reason + ")");
  say("%zu curtain%s\n%s\n", curtains.size(), curtains.size() == 1 ? "" : "s",
      (options.out + "/report.html").c_str());
  return exit_code_of(result, verdicts);
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
  command.option("--threads", options->threads, "Threads to use (0: all cores); the result is the same")
      .range(0, 1024);
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
