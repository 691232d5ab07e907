#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands/commands.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/photographs.h"
#include "apps/options/picture_lists.h"
#include "apps/options/refusals.h"
#include "apps/options/scene_options.h"
#include "apps/options/spectrum_options.h"
#include "apps/options/standard_streams.h"
#include "apps/output/animation/movie.h"
#include "apps/output/progress_bar.h"
#include "apps/output/terminal.h"
#include "fit/map/sequence/frame_check.h"
#include "fit/measurement/sky_light.h"
#include "fit/photo/filter_stack.h"
#include "fit/photo/photo.h"
#include "fit/photo/photo_metadata.h"
#include "fit/report/map_run.h"
#include "fit/report/map_sequence/map_sequence_run.h"
#include "fit/search/file_journal.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/sha256.h"
#include "sim/base/utc_time.h"

namespace vegard::apps {
namespace {

struct MapRequest {
  std::string memory_limit;
  SceneOptions scene;
  PhotoWords photo;
  SpectrumOptions spectrum;
  std::string out;
  int threads = 0;
  std::optional<int> replicates;
  double sparsity = 0.0;
  double farthest_km = 0.0;
  double altitude_scale = fit::MapOptions().altitude_scale;
  bool overwrite = false, resume = false, no_metadata = false, netcdf = false;
  bool geojson = false, kml = false, magnetic_grid = false;
  std::vector<std::string> sequence;
  double time_step_s = 0.0;
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

fit::MapOptions map_options_of(const MapRequest& options) {
  fit::MapOptions map_options;
  map_options.threads = options.threads;
  constexpr int kOfSequence = 6;
  map_options.replicates =
      options.replicates.value_or(options.sequence.empty() ? fit::MapOptions().replicates : kOfSequence);
  map_options.sparsity = options.sparsity;
  map_options.farthest_km = options.farthest_km;
  map_options.altitude_scale = options.altitude_scale;
  map_options.spectrum = electron_spectrum(options.spectrum);
  map_options.stop = &watch_for_interrupt();
  map_options.progress = map_progress();
  return map_options;
}

/// A frame of the sequence.
fit::Photo frame_of(const MapRequest& options, const sim::Scene& scene, const std::string& file) {
  PhotoWords words = options.photo;
  words.file = file;
  return std::move(photographs_asked(words, scene).front());
}

/// Encodes a sequence's film; false, with the reason told, where that cannot be.
bool encoded_film(const std::vector<std::string>& pictures, const std::string& movie) {
  constexpr double kFramesPerSecond = 8.0;
  try {
    return !write_movie(movie, pictures, kFramesPerSecond, false).empty();
  } catch (const sim::Error& error) {
    tell("vegard: there is no film: %s\n", error.what());
    return false;
  }
}

int tell_sequence(const MapRequest& options, const fit::MapSequenceRun& run, const fit::CameraWatch& camera) {
  bool all_good = true;
  for (const fit::MappedFrame& frame : run.frames()) all_good = all_good && frame.is_good;
  for (const fit::CurtainTrack& track : run.tracks()) {
    const fit::TrackedCurtain &first = track.frames.front(), &last = track.frames.back();
    const auto words = [](const fit::WithError& v) {
      return sim::number_with_error(v.value, std::isfinite(v.error) ? std::optional(v.error) : std::nullopt);
    };
    say("curtain %d, %zu frames: distance %s to %s km, E0 %s to %s keV\n", track.number, track.frames.size(),
        words(first.distance_km).c_str(), words(last.distance_km).c_str(), words(first.energy_kev).c_str(),
        words(last.energy_kev).c_str());
  }
  for (const std::string& words : camera.words()) say("%s\n", words.c_str());
  answer_with(sim::input_bytes(options.out + "/map_sequence.json", "a sequence of maps"));
  json_answer()["report"] = options.out + "/report.html";
  say("%s\n", (options.out + "/report.html").c_str());
  return all_good ? good : doubted;
}

int run_map_sequence(const MapRequest& options, const std::string& command) {
  sim::Scene scene = scene_of(options.scene);
  const std::string scene_sha256 = sim::sha256_of_file(options.scene.file);
  if (options.out.empty()) throw usage_error("--out", "is missing", "the directory to write");
  if (!options.photo.file.empty() || !options.photo.filters.empty())
    throw usage_error("--sequence", "cannot be together with --photo or --line", "the frames");
  if (!options.photo.at.empty()) throw usage_error("--at", "chooses one frame", "all frames of a sequence");
  if (options.geojson || options.kml || options.magnetic_grid)
    throw usage_error(options.geojson ? "--geojson"
                      : options.kml   ? "--kml"
                                      : "--magnetic-grid",
                      "is of the map of one photograph", "--sequence without it");
  GivenTimes given;
  if (options.time_step_s > 0.0) given.step_s = options.time_step_s;
  const TimedPictures pictures = timed_pictures(options.sequence, given);
  if (pictures.times.kind == fit::PictureTimes::Kind::number)
    throw usage_error("--sequence", "the frames do not say when they were taken", "--step SECONDS",
                      "or a list with a line FILE TIME_S for each");
  std::vector<NamedInput> inputs = files_of_map(options, scene);
  for (const std::string& file : pictures.files) inputs.push_back({file, "a frame"});
  protect_inputs_inside("--out", options.out, inputs);
  fit::check_map_sequence_directory(options.out, options.overwrite);
  if (!options.no_metadata) take_from_photograph(scene, pictures.files.front(), options.scene.changes);
  fit::MapFrames frames;
  fit::MapSequenceRunFacts facts;
  facts.command = command;
  std::vector<std::string> sums;
  fit::FrameCheck check(scene);
  std::vector<char> sky;  // pixels that the mask leaves
  for (std::size_t i = 0; i < pictures.files.size(); ++i) {
    // All of them now, not after hours.
    const fit::Photo read = frame_of(options, scene, pictures.files[i]);
    const double time_s = pictures.times.seconds[i] - pictures.times.seconds.front();
    if (sky.empty() && !options.photo.mask.empty()) sky = fit::pixels_left_by(options.photo.mask, read);
    check.add(read, options.no_metadata ? sim::PictureMetadata() : fit::photo_metadata(pictures.files[i]),
              time_s, sky);
    for (const fit::InputFile& input : fit::inputs_of(options.scene.file, scene_sha256, read))
      if (std::none_of(facts.inputs.begin(), facts.inputs.end(), [&](const fit::InputFile& known) {
            return known.role == input.role && known.name == input.name;
          }))
        facts.inputs.push_back(input);
    sums.push_back(read.sha256);
    frames.names.push_back(fit::stem_of_picture(pictures.files[i]));
    frames.time_s.push_back(time_s);
  }
  facts.camera = check.camera();
  frames.read = [&](std::size_t i) { return frame_of(options, scene, pictures.files[i]); };
  fit::MapOptions map_options = map_options_of(options);
  fit::JournalSubject subject = fit::subject_of_map(map_options, scene, {frames.read(0)});
  subject.push_back({"--replicates", std::to_string(map_options.replicates)});
  for (std::size_t i = 0; i < frames.names.size(); ++i)
    subject.push_back(
        {"frame " + std::to_string(i + 1) + " at " + sim::short_number(frames.time_s[i], 17) + " s",
         sums[i]});
  fit::FileJournal journal(fit::journal_file(options.out), subject, journal_mode(options));
  if (journal.found() > 0) tell_progress("vegard: going on after %d finished steps\n", journal.found());
  map_options.journal = &journal;
  const std::string utc = pictures.times.kind == fit::PictureTimes::Kind::utc
                              ? sim::utc_text(pictures.times.seconds.front())
                              : std::string();
  fit::MapSequenceRun run(frames.names, frames.time_s, utc);
  try {
    facts.sequence = sim::placing_errors(scene, [&] {
      return fit::map_sequence(scene, frames, map_options,
                               [&](const fit::MapOfFrame& frame) { run.add(frame); });
    });
  } catch (const fit::MapStopped&) {
    tell("vegard: interrupted; the same command with --resume goes on\n");
    return exit_code_of_interruption();
  }
  map_options.progress = {};
  run.write(options.out, options.overwrite, facts, encoded_film);
  journal.remove();
  return tell_sequence(options, run, check.camera());
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
  fit::MapOptions map_options = map_options_of(options);
  fit::FileJournal journal(fit::journal_file(options.out), fit::subject_of_map(map_options, scene, photos),
                           journal_mode(options));
  if (journal.found() > 0) tell_progress("vegard: going on after %d finished steps\n", journal.found());
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
  facts.geojson = options.geojson;
  facts.kml = options.kml;
  facts.magnetic_grid = options.magnetic_grid;
  facts.inputs = fit::inputs_of(options.scene.file, scene_sha256, photos);
  facts.from_photograph = from_photograph;
  fit::write_map(map, photos, options.out, replaces, facts, said());
  if (!map.result.interrupted) journal.remove();
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
  command
      .option(
          "--sequence", options->sequence,
          "The frames of one camera that stood still, with their times: images, a list (.txt), a folder, a "
          "film or a file of frames; one solution for all of them")
      .type_name("IMAGE");
  command
      .option("--step", options->time_step_s,
              "Time from one frame of the sequence to the next in seconds, in the order given (0: by their "
              "times)")
      .range(0.0, 3600.0);
  command.option("--out", options->out, "The directory to write").type_name("RUN");
  command.option("--mask", options->photo.mask, "An image of the same size: white = use").type_name("IMAGE");
  add_decoding_option(command, options->photo.decoding);
  add_no_metadata_option(command, options->no_metadata);
  add_threads_option(command, options->threads);
  command
      .option(
          "--replicates", options->replicates,
          "Perturbed solutions from which error bars follow (left out: 16, or 6 of a sequence; 0: no error "
          "bars)")
      .range(0, 1000);
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
  command.flag("--geojson", options->geojson, "Also write the curtains for maps: RUN/curtains.geojson");
  command.flag("--kml", options->kml, "The same for Google Earth and others: RUN/curtains.kml");
  command.flag("--magnetic-grid", options->magnetic_grid,
               "Draw magnetic latitude and longitude, of the scene's dipole, beside the geographic");
  command.flag("--overwrite", options->overwrite,
               "Replace an existing map; without --resume, discard the steps of an interrupted one");
  command.flag("--resume", options->resume,
               "Continue a map that was interrupted, from the finished steps in RUN.part");
  command.runs([options, words = program.command_line()] {
    if (!options->sequence.empty()) return run_map_sequence(*options, words);
    if (options->time_step_s > 0.0) throw usage_error("--step", "is of a sequence", "--sequence");
    options->photo = with_frames_chosen(options->photo);
    return run_map(*options, words);
  });
}

}  // namespace vegard::apps
