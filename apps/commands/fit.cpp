#include "apps/commands/commands.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

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
#include "fit/answer/tables_correction.h"
#include "fit/derivative_check.h"
#include "fit/map/curtains/stored_map.h"
#include "fit/photo/photo.h"
#include "fit/report/run_directory.h"
#include "fit/report/table/curtain_steps_table.h"
#include "fit/report/table/result_json.h"
#include "fit/scene_fit.h"
#include "fit/search/file_journal.h"
#include "fit/version.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/sha256.h"
#include "sim/base/version.h"
#include "sim/scene/file/named_files.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/decoding_word.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/photo_scene.h"
#include "sim/scene/table/table_files.h"

namespace vegard::apps {
namespace {

std::string share_text(double share) { return std::isfinite(share) ? fmt::format("{:.1e}", share) : "-"; }

void print(const std::vector<fit::DerivativeCheck>& checks) {
  std::size_t widest = 9;
  for (const fit::DerivativeCheck& check : checks) widest = std::max(widest, check.name.size());
  say_result(
      "Of each column of the Jacobian: its length (sigmas per natural step: the parameter itself, or one of "
      "its unit),\nand how far central differences are from it, relative, by step (share of a natural "
      "step).\n\n");
  json_answer()["steps"] = fit::derivative_steps();
  json_answer()["parameters"] = Json::array();
  std::string header = fmt::format("{:<{}}  {:>8}", "parameter", widest, "length");
  for (const double step : fit::derivative_steps()) header += fmt::format("  {:>7.0e}", step);
  say_result(header + "  best at  verdict\n");
  for (const fit::DerivativeCheck& check : checks) {
    std::string line = fmt::format("{:<{}}  {:>8}", check.name, widest, share_text(check.effect));
    for (const double difference : check.differences) line += fmt::format("  {:>7}", share_text(difference));
    const char* const verdict = fit::derivative_verdict_name(check.verdict);
    say_result(line + fmt::format("  {:7.0e}  {}\n", check.best_step, verdict));
    Json differences = Json::array();
    for (const double difference : check.differences) differences.push_back(json_number(difference));
    json_answer()["parameters"].push_back({{"name", check.name},
                                           {"length", json_number(check.effect)},
                                           {"differences", differences},
                                           {"best_step", json_number(check.best_step)},
                                           {"verdict", verdict}});
  }
}

/// Prints a table. Returns `good` if all derivatives agree with differences, `doubted` if one does not or has
/// no effect, `interrupted` after Ctrl-C.
ExitCode print_derivative_check(const sim::Scene& scene, const fit::Photo& photo, int threads) {
  const std::atomic<bool>& stop = watch_for_interrupt();
  std::vector<fit::DerivativeCheck> checks;
  {
    ProgressBar bar("differences");
    checks = placing_errors(scene, [&] {
      return fit::check_derivatives(
          scene, photo, threads, [&bar](double share) { bar.update(share); }, &stop);
    });
  }
  print(checks);
  if (stop.load()) return interrupted;
  const auto count = [&](fit::DerivativeVerdict verdict) {
    return std::count_if(checks.begin(), checks.end(),
                         [verdict](const fit::DerivativeCheck& check) { return check.verdict == verdict; });
  };
  const long differ = count(fit::DerivativeVerdict::differ), inert = count(fit::DerivativeVerdict::no_effect);
  if (differ == 0 && inert == 0) {
    say_result("All derivatives agree with differences.\n");
    return good;
  }
  if (differ > 0)
    say_result(fmt::format("{} of {} derivatives differ from differences.\n", differ, checks.size()));
  if (inert > 0)
    say_result(fmt::format("{} of {} parameters have no effect on what is fitted.\n", inert, checks.size()));
  if (inert == static_cast<long>(checks.size()))
    say_result(
        "Is the model's light anywhere near the photograph's at this start? Where it is not, the gains are "
        "held at 0:\ncheck the best.toml of a run instead.\n");
  return doubted;
}

struct FitRequest {
  std::string memory_limit;
  SceneOptions scene;
  PhotoWords photo;
  std::string from_map;
  std::string out;
  int threads = 0;
  int max_evaluations = fit::FitOptions().max_evaluations;
  bool overwrite = false, netcdf = false;
  bool resume = false;
  bool check_derivatives = false;
  bool intervals = false;
  bool stability = false;
  bool no_metadata = false;
  int bootstrap = 0, mcmc = 0;
};

/// All files that the fit reads.
std::vector<NamedInput> files_read(const FitRequest& options, const sim::Scene& scene) {
  std::vector<NamedInput> inputs = inputs_of_scene(options.scene, scene);
  for (const sim::PhotoEntry& entry : scene.fit.photos)  // what it alone has may name files too
    for (const NamedInput& input : inputs_of_scene({}, sim::scene_of_photo(scene, entry)))
      inputs.push_back(input);
  inputs.push_back({options.photo.file, "the photograph"});
  inputs.push_back({options.photo.mask, "the mask"});
  if (!options.from_map.empty()) inputs.push_back({options.from_map + "/map.json", "the map"});
  for (const fit::FilterFile& filter : filter_files(options.photo.filters))
    inputs.push_back({filter.file, "the photograph"});
  if (!options.photo.decoding.empty())
    inputs.push_back({sim::decoding_word(options.photo.decoding).file, "the transfer curve"});
  return inputs;
}

/// What the fit reports while it works: a bar on a terminal, elsewhere one line a stage.
class Account {
 public:
  void tell(const std::string& stage, int evaluations, double chi2_per_dof, double share) {
    std::string text = fmt::format("{}: {} evaluations", stage, evaluations);
    // A search on a cheaper model has no chi2 that could be compared with the end's.
    if (std::isfinite(chi2_per_dof)) text += ", chi2 / dof " + sim::short_number(chi2_per_dof, 3);
    bar_.update(share, text);
    if (isatty(STDERR_FILENO) == 1 || !stages_.insert(stage).second) return;
    const std::optional<double> to_go = bar_.seconds_to_go();
    apps::tell_progress("%s (%s%s)\n", text.c_str(), duration_text(bar_.elapsed_seconds()).c_str(),
                        to_go ? (", about " + duration_text(*to_go) + " to go").c_str() : "");
  }

 private:
  ProgressBar bar_{"fitting"};
  std::set<std::string> stages_;
};

/// All that the answer depends on. Comments and the order of keys in the scene's file do not count.
fit::JournalSubject subject_of(const FitRequest& options, const sim::Scene& scene,
                               const std::vector<fit::Photo>& photos,
                               const std::optional<fit::StoredMap>& map) {
  fit::JournalSubject subject = {
      {"the version of vegard", sim::version()},
      {"the version of a library",
       fit::ceres_version() + ", " + sim::eigen_version() + ", " + fit::opencv_version()},
      {"the scene", sim::sha256(sim::write_scene(scene))}};
  for (const auto& [path, sum] : sim::table_sums(scene)) subject.push_back({"the table of " + path, sum});
  for (const sim::RadarEntry& radar : scene.fit.radars)
    subject.push_back(
        {"the file of radar " + radar.name, sim::sha256_of_file(sim::table_place(scene, radar.file))});
  for (const sim::NamedFile& named : sim::named_files(scene))
    for (const std::string& name : sim::files_of_name(named.name))
      subject.push_back({"the file of " + named.path, sim::sha256_of_file(sim::table_place(scene, name))});
  for (std::size_t i = 0; i < photos.size(); ++i) {
    const std::string which = photos.size() > 1 ? " " + std::to_string(i + 1) : "";
    subject.push_back({"the photograph" + which, photos[i].sha256});
    subject.push_back({"the mask" + which, photos[i].mask_sha256});
    subject.push_back({"the decoding" + which, photos[i].decoding});
  }
  subject.push_back({"--max-evaluations", std::to_string(options.max_evaluations)});
  if (map) subject.push_back({"the map", map->sha256});
  return subject;
}

/// A run that Ctrl-C has left is what --resume goes on with; any other is kept.
bool is_interrupted_run(const std::string& directory) {
  const sim::InputFile file = sim::read_input(directory + "/result.json", fit::kMaxResultBytes);
  const nlohmann::json json = nlohmann::json::parse(file.bytes, nullptr, false);
  // A damaged one may have anything under these names.
  const auto says = [&](const char* name, const nlohmann::json& value) {
    const auto found = json.find(name);
    return found != json.end() && *found == value;
  };
  return json.is_object() && (says("verdict", fit::verdict_name(fit::Verdict::interrupted)) ||
                              says("validation_interrupted", true));
}

fit::JournalMode journal_mode(const FitRequest& options) {
  if (options.resume) return fit::JournalMode::resume;
  return options.overwrite ? fit::JournalMode::overwrite : fit::JournalMode::fresh;
}

/// A photograph whose transfer curve was unknown is decoded by what was found of it afterwards.
fit::FitResult fitted(const FitRequest& options, const sim::Scene& scene, std::vector<fit::Photo>& photos,
                      const std::optional<fit::StoredMap>& map, fit::Journal& journal) {
  Account account;
  fit::SceneFitOptions fit_options;
  fit_options.threads = options.threads;
  fit_options.max_evaluations = options.max_evaluations;
  fit_options.journal = &journal;
  fit_options.intervals = options.intervals;
  fit_options.bootstrap = options.bootstrap;
  fit_options.mcmc = options.mcmc;
  fit_options.progress = [&account](const std::string& stage, int evaluations, double chi2_per_dof,
                                    double share) { account.tell(stage, evaluations, chi2_per_dof, share); };
  fit_options.stop = &watch_for_interrupt();
  fit_options.stability = options.stability;
  return placing_errors(scene,
                        [&] { return fit::fit_scene(scene, photos, map ? &*map : nullptr, fit_options); });
}

/// A number of a map's curtain, of which there are too many to be read one by one.
bool is_of_curve(const fit::FitResult& result, const std::string& path) {
  if (result.curtain_steps.empty()) return false;
  for (const sim::Sheet& sheet : result.best.sheets)
    for (const std::string& beginning : {"sheet." + sheet.name + ".", sheet.name + "_across_km_"})
      if (path.compare(0, beginning.size(), beginning) == 0) return true;
  return false;
}

/// Behind "good" or "doubtful": why, or which errors there are.
std::string words_of_trust(const fit::DerivedNumber& d) {
  if (d.trust != fit::Trust::good) return ": " + d.trust_reason;
  if (!d.systematic) return {};
  return "; statistical ± " + sim::short_number(*d.sigma, 2) + ", by the fit's choices ± " +
         sim::short_number(*d.systematic, 2);
}

void print_answer(const fit::FitResult& result, const std::string& report) {
  say_verdict(result.verdict == fit::Verdict::good     ? Tone::good
              : result.verdict == fit::Verdict::failed ? Tone::bad
                                                       : Tone::doubtful,
              result.verdict_line);
  for (const fit::CurtainStep& step : result.curtain_steps)
    say("%s\n", fit::curtain_step_in_words(step).c_str());
  std::size_t widest = 0;
  std::size_t coefficients = 0, of_curves = 0;
  for (const fit::FittedParameter& p : result.parameters) {
    if (p.of_profile)
      ++coefficients;
    else if (is_of_curve(result, p.path))
      ++of_curves;
    else
      widest = std::max(widest, p.path.size());
  }
  for (const fit::TiedNumber& t : result.tied)
    if (!is_of_curve(result, t.path)) widest = std::max(widest, t.path.size());
  for (const fit::FittedParameter& p : result.parameters) {
    if (p.of_profile || is_of_curve(result, p.path)) continue;
    say("  %-*s  %s%s%s%s\n", static_cast<int>(widest), p.path.c_str(),
        sim::number_with_error(p.value, p.sigma).c_str(), p.unit.empty() ? "" : " ", p.unit.c_str(),
        p.at_limit ? "  (at a limit)" : "");
  }
  for (const fit::TiedNumber& t : result.tied) {
    if (is_of_curve(result, t.path)) continue;
    say("  %-*s  %s%s%s = %s\n", static_cast<int>(widest), t.path.c_str(),
        sim::number_with_error(t.value, t.sigma).c_str(), t.unit.empty() ? "" : " ", t.unit.c_str(),
        t.equals.c_str());
  }
  if (of_curves > 0)
    say("  %zu numbers of %zu curve%s: see the report\n", of_curves, result.best.sheets.size(),
        result.best.sheets.size() == 1 ? "" : "s");
  if (coefficients > 0) say("  %zu coefficients of free-form profiles: see profile.csv\n", coefficients);
  for (const fit::DerivedNumber& d : result.derived) {
    if (d.is_detail) continue;  // in the report
    if (!d.why_none.empty())
      say("  %s: %s\n", d.name.c_str(), d.why_none.c_str());
    else
      say("  %s: %s%s%s (%s%s)\n", d.name.c_str(), sim::number_with_error(d.value, d.error()).c_str(),
          d.unit.empty() ? "" : " ", d.unit.c_str(), fit::trust_name(d.trust), words_of_trust(d).c_str());
  }
  for (const fit::TablesCorrection& correction : result.tables)
    say("%s\n", fit::correction_words(correction).c_str());
  for (const fit::FittedPhoto& photo : result.photos)
    say("decoding%s: %s\n", photo.name.empty() ? "" : (" of " + photo.name).c_str(), photo.decoding.c_str());
  if (result.compared.draws && result.best.fit.model == sim::FitModel::expected)
    say("compared with one draw of beams: folds, curls and undulating borders have no mean over all draws\n");
  if (result.transfer_curve)
    say("to take the curve as known: --decoding %s\n", result.transfer_curve->decoding_word.c_str());
  say("%s\n", report.c_str());
}

ExitCode exit_code_of(fit::Verdict verdict) {
  switch (verdict) {
    case fit::Verdict::good:
      return good;
    case fit::Verdict::doubtful:
      return doubted;
    case fit::Verdict::failed:
      return not_converged;
    case fit::Verdict::interrupted:
      return interrupted;
  }
  return internal_error;
}

int run_fit(const FitRequest& options, const std::string& command) {
  sim::Scene scene = moving_scene_of(options.scene);
  fit::require_still(scene);
  // Now, not after the fit: someone may edit the file meanwhile.
  const std::string scene_sha256 = sim::sha256_of_file(options.scene.file);
  const bool replaces = options.overwrite || (options.resume && is_interrupted_run(options.out));
  if (!options.check_derivatives) {
    if (options.out.empty()) throw usage_error("--out", "is missing", "the run's directory to write");
    protect_inputs_inside("--out", options.out, files_read(options, scene));
    fit::check_run_directory(options.out, replaces);
  }
  std::optional<fit::StoredMap> map;
  if (!options.from_map.empty()) {
    map = fit::read_stored_map(options.from_map);
    if (scene.emission.modes.empty() && scene.emission.uncertainty != sim::TablesUncertainty::none) {
      scene.emission.modes = map->modes;
      sim::validate(scene);
    }
  }
  std::vector<fit::PhotoFact> from_photograph;
  const std::string photo =
      options.photo.filters.empty() ? options.photo.file : filter_files(options.photo.filters).front().file;
  if (scene.fit.photos.empty() && !photo.empty() && !options.no_metadata)
    from_photograph = take_from_photograph(scene, photo, options.scene.changes);
  const sim::Scene first = map ? fit::scene_of_ridges(scene, map->curtains) : scene;
  sim::Scene estimated = first;
  if (!options.photo.filters.empty() ||
      decoding_of(options.photo.decoding, scene.fit.decoding, &scene).kind == fit::Decoding::Kind::unknown)
    estimated.fit.average_rows = 0;  // such photographs are not averaged
  check_memory_of_fit(estimated, options.threads, options.memory_limit);
  std::vector<fit::Photo> photos = photographs_asked(options.photo, scene, fit::PhotoPixels::for_fit);
  if (map) {
    std::vector<std::string> decodings;
    for (const fit::Photo& one : photos) decodings.push_back(one.decoding);
    fit::check_same_subject(*map, scene, fit::inputs_of(options.scene.file, scene_sha256, photos), decodings);
  }
  if (options.check_derivatives) {
    if (!scene.fit.photos.empty())
      throw usage_error("--check-derivatives", "is for one photograph", "a scene without [[fit.photo]]");
    return print_derivative_check(first, photos.front(), options.threads);
  }
  fit::FileJournal journal(fit::journal_file(options.out), subject_of(options, scene, photos, map),
                           journal_mode(options));
  if (journal.dropped() > 0)
    tell("vegard: %d of %d steps of the journal are left out: %s, and each step rests on those before it\n",
         journal.dropped(), journal.dropped() + journal.found(), journal.why_dropped().c_str());
  if (journal.found() > 0) tell_progress("vegard: going on after %d finished steps\n", journal.found());
  fit::FitResult result = fitted(options, scene, photos, map, journal);
  if (!journal.problem().empty()) tell("vegard: this fit cannot be resumed: %s\n", journal.problem().c_str());
  result.inputs = fit::inputs_of(options.scene.file, scene_sha256, photos);
  fit::add_radar_files(result);
  result.command = command;
  result.from_photograph = from_photograph;
  fit::RunContext context;
  context.threads = options.threads;
  context.netcdf = options.netcdf;
  fit::write_run(options.out, replaces, result, photos, context);
  if (result.verdict == fit::Verdict::interrupted)
    tell("vegard: interrupted; the same command with --resume goes on\n");
  else if (result.validation_interrupted)
    tell(
        "vegard: the fit is finished, the validation of its error bars was interrupted; the same command "
        "with --resume goes on\n");
  else
    journal.remove();
  answer_with(fit::result_json(result));
  json_answer()["report"] = options.out + "/report.html";
  print_answer(result, options.out + "/report.html");
  return result.validation_interrupted ? interrupted : exit_code_of(result.verdict);
}

}  // namespace

void add_fit_command(Program& program) {
  const auto options = std::make_shared<FitRequest>();
  const Command command = program.add("fit", "Fit a scene to a photograph or to several, and write a report");
  add_scene_options(command, options->scene);
  command
      .option("--photo", options->photo.file,
              "A photograph of any format that is read; left out: those of the scene's [[fit.photo]]")
      .type_name("IMAGE");
  add_filter_option(command, options->photo.filters);
  add_at_option(command, options->photo.at);
  command.option("--out", options->out, "The directory to write").type_name("RUN");
  command
      .option("--from-map", options->from_map,
              "Start from the curtains of this vegard map of the photograph, and add curves where the data "
              "need them")
      .type_name("RUN");
  command.option("--mask", options->photo.mask, "An image of the same size: white = use").type_name("IMAGE");
  add_decoding_option(command, options->photo.decoding);
  add_no_metadata_option(command, options->no_metadata);
  add_threads_option(command, options->threads);
  command.option("--max-evaluations", options->max_evaluations, "Stop after this number of evaluations")
      .range(1, 1000000)
      .shows_default();
  add_memory_option(command, options->memory_limit);
  command.flag(
      "--intervals", options->intervals,
      "Validate the error bars by profile likelihood: the other parameters are fitted again at each value");
  command
      .option("--bootstrap", options->bootstrap,
              "Validate the error bars by a bootstrap with this number of resamplings of the bands (1000 "
              "suffice)")
      .type_name("N")
      .range(2, 1000000);
  command
      .option("--mcmc", options->mcmc,
              "Validate the error bars by a Markov chain of this length, after a burn-in of a quarter of it "
              "(at most 200)")
      .type_name("STEPS")
      .range(2, 1000000);
  command.flag("--stability", options->stability,
               "Repeat the fit from its answer with other regions, bands, sky, air, curve and model error, "
               "which gives systematic errors");
  command.flag("--netcdf", options->netcdf, "Also write the result as netCDF: RUN/result.nc");
  command.flag("--overwrite", options->overwrite,
               "Replace an existing run; without --resume, discard the steps of an interrupted one");
  command.flag("--resume", options->resume,
               "Continue a fit that was interrupted, from the finished steps in RUN.part");
  command.flag("--check-derivatives", options->check_derivatives,
               "Only compare each free parameter's derivative with finite differences (needs no --out)");
  command.runs([options, words = program.command_line()] {
    options->photo = with_frames_chosen(options->photo);
    return run_fit(*options, words);
  });
}

}  // namespace vegard::apps
