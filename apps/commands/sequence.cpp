#include "apps/commands/commands.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/memory_limit.h"
#include "apps/options/photo_options.h"
#include "apps/options/picture_lists.h"
#include "apps/options/refusals.h"
#include "apps/options/scene_options.h"
#include "apps/options/standard_streams.h"
#include "apps/output/terminal.h"
#include "fit/answer/input_files.h"
#include "fit/radar/radar_refusal.h"
#include "fit/report/netcdf/run_dataset.h"
#include "fit/report/run_directory.h"
#include "fit/report/table/sequence_files.h"
#include "fit/report/table/shared_physics_files.h"
#include "fit/scene_fit.h"
#include "fit/sequence.h"
#include "fit/shared_physics.h"
#include "sim/base/error.h"
#include "sim/base/file/csv_table.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/sha256.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/version.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/decoding_word.h"
#include "sim/scene/table/table_files.h"

namespace vegard::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char *kPhysicsTable = "physics.csv", *kPhysics = "physics.json";

struct SequenceRequest {
  std::string memory_limit;
  SceneOptions scene;
  std::vector<std::string> photos;
  std::string mask, decoding, out, reports = "all";
  int threads = 0;
  int max_evaluations = fit::FitOptions().max_evaluations;
  bool overwrite = false, netcdf = false;
};

/// True for what manifest() has written, in this version or an older one.
bool is_manifest(const std::string& text) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  return json.is_object() && json.contains("scene_sha256") && json.contains("max_evaluations") &&
         json.contains("version");
}

/// What makes one sequence another, its photographs apart: those are distinguished by their rows.
std::string manifest(const SequenceRequest& options, const sim::Scene& scene) {
  nlohmann::ordered_json json;
  json["scene_sha256"] = sim::sha256(sim::write_scene(scene));
  for (const auto& [path, sum] : sim::table_sums(scene)) json["tables_sha256"][path] = sum;
  if (!options.mask.empty()) json["mask_sha256"] = sim::sha256_of_file(options.mask);
  if (!options.decoding.empty()) json["decoding"] = options.decoding;
  json["max_evaluations"] = options.max_evaluations;
  json["version"] = sim::version();
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// The sequence's folder: manifest, frames/NAME (a run) and frames/NAME.json (its row, written last).
class Folder {
 public:
  explicit Folder(std::string path) : path_(std::move(path)) {}

  std::string file(const std::string& name) const { return path_ + "/" + name; }
  std::string run(const std::string& frame) const { return path_ + "/frames/" + frame; }
  std::string row(const std::string& frame) const { return run(frame) + ".json"; }

  /// Makes it, or goes on in it. A sequence of something else is begun again if `overwrite`: its rows are
  /// removed, and its tables and the runs of `photos` will be replaced. Throws Error(existing_output) before
  /// anything is touched unless what is there is a sequence of vegard's, and what will be replaced are runs.
  void begin(const std::string& text, bool overwrite, const std::vector<SequencePhoto>& photos) const {
    const auto in_the_way = [](const std::string& file, const std::string& problem) {
      return sim::Error(sim::ErrorKind::existing_output, problem).file(file);
    };
    std::error_code error;
    const std::string found = sim::read_input(file(kManifest)).bytes;
    const bool is_known = found == text;
    if (!is_known && fs::exists(path_, error) && !fs::is_empty(path_, error)) {
      if (!is_manifest(found))
        throw in_the_way(path_,
                         "exists already, and is no sequence: it has no sequence.json that vegard wrote")
            .hint("choose another name");
      if (!overwrite)
        throw in_the_way(path_, "is of another sequence, scene or version")
            .hint("use --overwrite to fit it again, or choose another name");
    }
    for (const char* name : {kManifest, kTable, kPlot, kNetcdf, kPhysicsTable, kPhysics}) {
      const fs::file_status status = fs::symlink_status(file(name), error);
      if (fs::exists(status) && !fs::is_regular_file(status))  // what a link leads to would be replaced
        throw in_the_way(file(name), "is in the way, and is no file that vegard wrote")
            .hint("choose another name");
    }
    for (const SequencePhoto& photo : photos) {
      check_row(row(photo.name));
      const bool may_be_done = is_known && fs::exists(row(photo.name), error);
      if (!may_be_done && fs::exists(fs::symlink_status(run(photo.name), error)))
        fit::check_run_directory(run(photo.name), true);
    }
    fs::create_directories(path_ + "/frames", error);
    if (error) throw sim::unwritable(path_, error.value());
    if (is_known) return;
    std::vector<std::string> rows;
    for (fs::directory_iterator entry(path_ + "/frames", error), end; !error && entry != end;
         entry.increment(error))
      if (entry->path().extension() == ".json") rows.push_back(entry->path().string());
    if (error) throw sim::unwritable(path_, error.value());
    for (const std::string& row : rows) check_row(row);
    for (const std::string& row : rows) fs::remove(row, error);
    sim::write_whole(file(kManifest), text, true);
  }

  /// Removes the run of a frame that an older fit has left. Throws if what stands there is none.
  void drop_run(const std::string& frame) const {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(run(frame), error))) return;
    fit::check_run_directory(run(frame), true);
    fs::remove_all(run(frame), error);
    if (error) throw sim::unwritable(run(frame), error.value());
  }

  /// The row of a frame that is done: of this photograph at this time.
  std::optional<fit::SequenceRow> done(const SequencePhoto& photo, const fit::Photo& read) const {
    const std::string text = sim::read_input(row(photo.name)).bytes;
    if (text.empty()) return {};
    fit::SequenceRow found = fit::sequence_row_of(text, row(photo.name));
    if (found.photo_sha256 != read.sha256 || found.time_s != photo.time_s || found.decoding != read.decoding)
      return {};
    return found;
  }

 private:
  /// Throws unless there is none, or a row that vegard wrote: what stands there goes.
  static void check_row(const std::string& row) {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(row, error);
    if (!fs::exists(status)) return;
    const sim::InputFile found = sim::read_input(row);
    if (!fs::is_regular_file(status) || !found.problem.empty())
      throw sim::Error(sim::ErrorKind::existing_output,
                       "is in the way of a frame's row, and is no file that can be read")
          .file(row)
          .hint("move it, or choose another name");
    fit::sequence_row_of(found.bytes, row);
  }

  static constexpr const char *kManifest = "sequence.json", *kTable = "sequence.csv", *kPlot = "sequence.svg",
                              *kNetcdf = fit::kSequenceNetcdf;
  std::string path_;
};

void write_tables(const Folder& folder, const std::vector<fit::SequenceRow>& rows, bool netcdf) {
  sim::write_whole(folder.file("sequence.csv"), fit::sequence_csv(rows), true);
  sim::write_whole(folder.file("sequence.svg"), fit::plot_svg(fit::sequence_plot(rows)), true);
  if (netcdf) sim::write_netcdf(fit::sequence_dataset(rows), folder.file(fit::kSequenceNetcdf), true);
}

/// What the frames say together of the emission tables; empty if none says anything.
fit::SharedPhysics physics_of(const std::vector<fit::SequenceRow>& rows) {
  std::vector<fit::FrameOfNight> frames;
  bool any = false;
  for (const fit::SequenceRow& row : rows) {
    const bool converged = row.verdict == fit::Verdict::good || row.verdict == fit::Verdict::doubtful;
    frames.push_back({converged, row.physics, row.numbers});
    any = any || !row.physics.modes.empty();
  }
  return any ? fit::share_physics(frames) : fit::SharedPhysics();
}

/// Writes what the frames say together, or removes it where they say nothing.
void write_physics(const Folder& folder, const std::vector<fit::SequenceRow>& rows,
                   const fit::SharedPhysics& shared) {
  const std::string table = folder.file(kPhysicsTable), facts = folder.file(kPhysics);
  if (shared.frames.empty()) {
    std::error_code ignored;
    for (const std::string& file : {table, facts}) fs::remove(file, ignored);
    return;
  }
  fit::NamesOfFrames names{"frame,time_s", {}};
  std::vector<std::string> frames;
  for (const fit::SequenceRow& row : rows) {
    frames.push_back(row.frame);
    names.rows.push_back(sim::csv_cell(row.frame) + "," + sim::csv_number(row.time_s));
  }
  sim::write_whole(table, fit::shared_physics_csv(shared, names), true);
  sim::write_whole(facts, fit::shared_physics_json(shared, frames), true);
}

void tell_physics(const fit::SharedPhysics& shared) {
  if (shared.frames.empty()) return;
  say("%s\n", fit::shared_physics_words(shared).c_str());
  for (const std::string& sentence : fit::asked_of_tables(shared)) say("%s\n", sentence.c_str());
  for (const fit::SharedMean& mean : shared.means)
    if (fit::is_main_number(mean.name))
      say("mean %s %s %s, of it %s in common\n", mean.name.c_str(),
          sim::number_with_error(mean.value, mean.sigma()).c_str(), mean.unit.c_str(),
          sim::short_number(mean.sigma_common, 2).c_str());
}

void tell_row(const fit::SequenceRow& row, bool was_done) {
  say("%s: %s%s", row.frame.c_str(), fit::verdict_name(row.verdict),
      was_done       ? " (done before)"
      : row.searched ? " (full search)"
                     : "");
  for (const fit::SequenceNumber& n : row.numbers)
    if (n.name.find(".energy_") != std::string::npos || n.name.compare(0, 8, "distance") == 0)
      say("  %s %s %s", n.name.c_str(), sim::number_with_error(n.value, n.sigma).c_str(), n.unit.c_str());
  say("\n");
  show_output();
}

/// 0 if all are good, else that of the worst.
ExitCode exit_code_of(const std::vector<fit::SequenceRow>& rows) {
  ExitCode code = good;
  for (const fit::SequenceRow& row : rows) {
    if (row.verdict == fit::Verdict::failed) return not_converged;
    if (row.verdict == fit::Verdict::doubtful) code = doubted;
  }
  return code;
}

bool wants_report(const SequenceRequest& options, fit::Verdict verdict) {
  return options.reports == "all" || (options.reports == "doubtful" && verdict != fit::Verdict::good);
}

/// Refuses a scene of several photographs at once.
void check_sequence(const sim::Scene& scene) {
  fit::refuse_radars(scene, "a sequence");
  if (!scene.fit.photos.empty())
    throw with_place(sim::Error(sim::ErrorKind::scene, "a sequence fits one photograph after another")
                         .file(scene.file)
                         .key("fit.photo")
                         .expected("a scene without [[fit.photo]]")
                         .hint("vegard fit fits them all at once"),
                     scene);
}

void check_decoding_of_sequence(const SequenceRequest& options, const sim::Scene& scene) {
  if (decoding_of(options.decoding, scene.fit.decoding, &scene).kind == fit::Decoding::Kind::unknown)
    throw usage_error(
        "--decoding", "a sequence is of one camera, and so of one transfer curve", "one that is known",
        "fit one frame by itself with --decoding unknown, and give all the curve that it finds");
}

/// The files that the sequence reads, which its folder must not replace.
std::vector<NamedInput> inputs_of_sequence(const SequenceRequest& options, const sim::Scene& scene,
                                           const std::vector<SequencePhoto>& photos) {
  std::vector<NamedInput> inputs = inputs_of_scene(options.scene, scene);
  for (const SequencePhoto& photo : photos) inputs.push_back({photo.file, "the photograph"});
  for (const std::string& word : options.photos) inputs.push_back({word, "the list of photographs"});
  inputs.push_back({options.mask, "the mask"});
  if (!options.decoding.empty())
    inputs.push_back({sim::decoding_word(options.decoding).file, "the transfer curve"});
  return inputs;
}

fit::Photo read_frame(const SequenceRequest& options, const sim::Scene& scene, const std::string& file) {
  fit::Photo photo = fit::read_photo(file, decoding_of(options.decoding, scene.fit.decoding, &scene), &scene,
                                     fit::averaging_for_fit(scene));
  if (!options.mask.empty()) fit::apply_mask(photo, options.mask);
  return photo;
}

/// Writes the run of a frame where it is wanted. An older one is removed, with its row.
void write_frame_run(const SequenceRequest& options, const Folder& folder, const std::string& frame,
                     const fit::FitResult& result, const fit::Photo& photo) {
  std::error_code ignored;
  fs::remove(folder.row(frame), ignored);
  if (!wants_report(options, result.verdict)) {
    folder.drop_run(frame);
    return;
  }
  fit::RunContext context;
  context.threads = options.threads;
  context.netcdf = options.netcdf;
  fit::write_run(folder.run(frame), true, result, photo, context);
}

/// Says where the table is, and answers with all rows.
void tell_sequence(const Folder& folder, const std::vector<fit::SequenceRow>& rows,
                   const fit::SharedPhysics& shared) {
  std::vector<std::string> outputs = {folder.file("sequence.csv"), folder.file("sequence.svg")};
  if (!shared.frames.empty())
    outputs.insert(outputs.end(), {folder.file(kPhysicsTable), folder.file(kPhysics)});
  json_answer() = {{"outputs", json_names(outputs)}, {"frames", Json::array()}};
  for (const fit::SequenceRow& row : rows)
    json_answer()["frames"].push_back(Json::parse(fit::sequence_row_json(row)));
  tell_physics(shared);
  say("%s\n", folder.file("sequence.csv").c_str());
}

int run_sequence(const SequenceRequest& options, const std::string& command) {
  const sim::Scene scene = moving_scene_of(options.scene);
  fit::require_still(scene);
  check_sequence(scene);
  const std::string scene_sha256 = sim::sha256_of_file(options.scene.file);
  const std::vector<SequencePhoto> photos = sequence_photos(options.photos, scene);
  check_decoding_of_sequence(options, scene);
  check_memory_of_fit(scene, options.threads, options.memory_limit);
  for (const SequencePhoto& photo : photos) read_frame(options, scene, photo.file);  // now, not after hours
  protect_inputs_inside("--out", options.out, inputs_of_sequence(options, scene, photos));
  const Folder folder(options.out);
  folder.begin(manifest(options, scene), options.overwrite, photos);

  fit::FitOptions fit_options;
  fit_options.threads = options.threads;
  fit_options.max_evaluations = options.max_evaluations;
  fit_options.stop = &watch_for_interrupt();
  std::vector<fit::SequenceRow> rows;
  bool chain_is_old = true;  // a frame depends on the one before it
  for (const SequencePhoto& frame : photos) {
    const fit::Photo photo = read_frame(options, scene, frame.file);
    if (chain_is_old)
      if (const auto row = folder.done(frame, photo)) {
        rows.push_back(*row);
        tell_row(rows.back(), true);
        continue;
      }
    chain_is_old = false;
    fit::FrameFit fitted = placing_errors(scene, [&] {
      return fit::fit_frame(scene, photo, frame.time_s, rows.empty() ? nullptr : &rows.back(), fit_options);
    });
    if (fit_options.stop->load()) {
      tell("interrupted; the same command goes on from here\n");
      return interrupted;
    }
    fitted.result.inputs = fit::inputs_of(options.scene.file, scene_sha256, photo);
    fitted.result.command = command;
    write_frame_run(options, folder, frame.name, fitted.result, photo);
    rows.push_back(fit::sequence_row(frame.name, frame.time_s, scene, fitted, photo));
    sim::write_whole(folder.row(frame.name), fit::sequence_row_json(rows.back()));
    write_tables(folder, rows, options.netcdf);
    tell_row(rows.back(), false);
  }
  write_tables(folder, rows, options.netcdf);
  const fit::SharedPhysics shared = physics_of(rows);
  write_physics(folder, rows, shared);
  tell_sequence(folder, rows, shared);
  return exit_code_of(rows);
}

}  // namespace

void add_sequence_command(Program& program) {
  const auto options = std::make_shared<SequenceRequest>();
  const Command command = program.add(
      "sequence", "Fit a scene to a series of photographs, each from the answer of the one before");
  add_scene_options(command, options->scene);
  command
      .option("--photos", options->photos,
              "Images in their order, or one list (.txt) with a line \"FILE\" or \"FILE TIME_S\" for each")
      .required()
      .type_name("IMAGE");
  command.option("-o,--out", options->out, "The folder to write; an unfinished one is continued")
      .required()
      .type_name("DIR");
  command.option("--mask", options->mask, "An image of the same size: white = use").type_name("IMAGE");
  add_decoding_option(command, options->decoding);
  add_memory_option(command, options->memory_limit);
  add_threads_option(command, options->threads);
  command
      .option("--max-evaluations", options->max_evaluations, "Stop a frame after this number of evaluations")
      .range(1, 1000000)
      .shows_default();
  command
      .option("--reports", options->reports,
              "Frames whose complete run with pictures is written: all, those that are not good, or none; "
              "every frame has its row")
      .one_of({"all", "doubtful", "none"})
      .shows_default();
  command.flag("--netcdf", options->netcdf,
               "Also write netCDF: DIR/sequence.nc, and result.nc in each frame's run");
  command.flag("--overwrite", options->overwrite,
               "Fit frames again that another scene or version has fitted");
  command.runs([options, words = program.command_line()] { return run_sequence(*options, words); });
}

}  // namespace vegard::apps
