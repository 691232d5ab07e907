#include "fit/measurement/measure_stages.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "fit/answer/input_files.h"
#include "fit/measurement/traces_picture.h"
#include "fit/photo/mask/mask_picture.h"
#include "fit/photo/scene_photos.h"
#include "fit/report/border/border_run.h"
#include "fit/report/map_run.h"
#include "sim/base/file/sha256.h"
#include "sim/base/number/constants.h"
#include "sim/base/shown_text.h"
#include "sim/base/utc_time.h"
#include "sim/scene/file/camera_file.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/parameter_rules.h"
#include "sim/scene/rows/value_words.h"
#include "sim/view/camera/camera.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::fit {
namespace {

namespace fs = std::filesystem;
constexpr double kLowestMapped_deg = 8.0;  // light at the horizon becomes a ring in the farthest cells
constexpr double kBesideTraces_deg = 12.0, kBelowTraces_deg = 6.0;
constexpr double kMappedShare = 0.25;  // of the brightest trace's light: fainter ones are the map's clutter
constexpr double kBlur_px = 1.2;       // what lenses and demosaicing leave of a point
constexpr double kMapModelError = 0.03;

/// Where one border was traced.
struct TracedRange {
  double middle_deg, half_width_deg, lowest_deg;
};

/// The ranges of azimuth of all traces that are claimed to be aurora, but the faint ones.
std::vector<TracedRange> traced_ranges(const Border& border, const sim::Scene& scene) {
  double brightest = 0.0;
  for (const BorderTrace& trace : border.traces)
    if (trace.is_claimed() && trace.measured > 0) brightest = std::max(brightest, trace.mean_brightness());
  std::vector<TracedRange> ranges;
  for (const BorderTrace& trace : border.traces) {
    const BorderSummary summary = border_summary(trace, scene);
    if (!trace.is_claimed() || trace.measured == 0 || !std::isfinite(summary.from_azimuth_deg) ||
        trace.mean_brightness() < kMappedShare * brightest)
      continue;
    double range = std::fmod(summary.to_azimuth_deg - summary.from_azimuth_deg, 360.0);
    if (range < 0.0) range += 360.0;
    ranges.push_back({summary.from_azimuth_deg + 0.5 * range, 0.5 * range, summary.lowest_deg});
  }
  return ranges;
}

/// Pixels whose light a map is not to explain: all but those near the azimuths of the traces, from below
/// their border up.
PixelSet away_from_traces(const Border& border, const sim::Scene& scene) {
  const std::vector<TracedRange> ranges = traced_ranges(border, scene);
  const sim::DirectionMap directions = sim::direction_map(scene.camera);
  PixelSet out(directions.width, directions.height);
  for (std::size_t i = 0; i < out.in.size(); ++i) {
    const double azimuth = directions.azimuth_deg[i], elevation = directions.elevation_deg[i];
    const bool is_used = std::any_of(ranges.begin(), ranges.end(), [&](const TracedRange& range) {
      return std::abs(std::remainder(azimuth - range.middle_deg, 360.0)) <=
                 range.half_width_deg + kBesideTraces_deg &&
             elevation >= std::max(kLowestMapped_deg, range.lowest_deg - kBelowTraces_deg);
    });
    out.in[i] = is_used ? 0 : 1;
  }
  return out;
}

/// Masks all but pixels of light near the borders, without stars.
bool mask_for_map(MeasureRun& run, MeasureStage& stage) {
  run.write("region.png", mask_png(away_from_traces(*run.result.border, *run.result.border_scene)));
  MaskRequest mask;
  mask.drawn = {run.in_run("region.png")};
  mask.stars = true;
  MeasureRun::Words words = {"mask",   run.request.photo,        "-o",     run.in_run("mask.png"),
                             "--draw", run.in_run("region.png"), "--stars"};
  if (!run.sky_mask.empty()) {
    words.insert(words.end(), {"--draw", run.sky_mask});
    mask.drawn.push_back(run.sky_mask);
  }
  return run.run_stage(stage, run.with_common(words), [&](const Tell& tell) {
    const Mask made = make_mask(read_photo(run.request.photo, run.decoding()), mask, tell);
    run.write("mask.png", mask_png(made.left_out));
    tell_mask(made, false, tell);
  });
}

void map_light(MeasureRun& run, MeasureStage& stage) {
  const MeasureRun::Words words = run.with_common(run.with_site(
      {"map", run.in_run("scene.toml"), "--camera", run.result.camera_file, "--photo", run.request.photo,
       "--mask", run.in_run("mask.png"), "--out", run.in_run("map"), "--replicates",
       std::to_string(run.request.replicates), "--threads", std::to_string(run.request.threads)}));
  run.run_stage(stage, words, [&](const Tell& tell) {
    sim::Scene scene = sim::read_scene(run.in_run("scene.toml"));
    sim::take_camera(scene, run.result.camera_file);
    MapRunFacts facts;
    facts.command = stage.command;
    const std::string scene_sha256 = sim::sha256_of_file(run.in_run("scene.toml"));
    check_map_directory(run.in_run("map"), true);
    facts.from_photograph = run.make_scene_ready(scene, tell);
    std::vector<Photo> photos;  // a list of initial values would copy the picture
    photos.push_back(photograph_for(scene, run.request.photo, run.in_run("mask.png"), run.request.decoding));
    facts.inputs = inputs_of(run.in_run("scene.toml"), scene_sha256, photos);
    MapOptions options;
    options.threads = run.request.threads;
    options.replicates = run.request.replicates;
    FileJournal journal(journal_file(run.in_run("map")), subject_of_map(options, scene, photos),
                        run.request.resume ? JournalMode::resume : JournalMode::overwrite);
    if (run.follower.map_begins) run.follower.map_begins(options);
    try {
      run.result.map.emplace(mapped_photos(scene, photos, std::move(options), journal));
    } catch (const MapStopped&) {
      run.result.is_map_interrupted = true;
      stage.exit_code = kStageInterrupted;
      return;
    }
    const PhotoMap& made = *run.result.map;
    write_map(made, photos, run.in_run("map"), true, facts, tell);
    if (!made.result.interrupted && !run.request.keep_journal) journal.remove();
    for (const char* file :
         {"scene.toml", "mask.png", "map/report.html", "map/precipitation.fits", "map/curtains.csv"})
      stage.files.emplace_back(file);
    stage.numbers = map_json(made.result, made.curtains, made.verdicts, facts);
    stage.exit_code = made.result.interrupted ? kStageInterrupted
                      : made.is_good()        ? kStageGood
                                              : kStageDoubted;
  });
}

/// Whether the reference field is known at this time.
bool has_reference_field(const std::string& time_utc) {
  constexpr double kSecondsPerYear = 31556952.0;
  const std::optional<double> seconds = sim::utc_seconds(time_utc);
  const double year = 1970.0 + seconds.value_or(-1e12) / kSecondsPerYear;
  return year > sim::kFirstIgrfYear && year < sim::kLastIgrfYear - 0.1;
}

/// The place and the time, by which the reference field goes.
std::string site_lines(const Measurement& m) {
  return fmt::format("[site]\nlatitude_deg = {}\nlongitude_deg = {}\naltitude_m = {}\ntime_utc = \"{}\"\n",
                     sim::real_text(m.site->latitude_deg), sim::real_text(m.site->longitude_deg),
                     sim::real_text(m.site->height_m), m.time_utc);
}

/// Returns the scene that the map and later fits are made with, beside the camera.
std::string scene_for_map(const MeasureRun& run) {
  const double focal_px = sim::camera_view(*run.result.camera).lens.focal_px;
  const bool is_reference = run.request.reference_field && has_reference_field(run.result.time_utc);
  return fmt::format(
      "# For vegard map and vegard fit, with --camera {}, by vegard measure of {}\n"
      "seed = 1\n"
      "{}[field]\n"
      "model = \"{}\"     # follows from the site{}\n"
      "[sensor]\n"
      "response = \"grey\"    # the green channel alone: the camera's colours are not known\n"
      "[emission]\n"
      "lines = [{}]\n"
      "[blur]\n"
      "width_deg = [{:.3g}]  # assumed: {} px\n"
      "[fit]\n"
      "model_error = {}\n",
      std::filesystem::path(run.result.camera_file).filename().string(), sim::comment_words(run.result.photo),
      is_reference ? site_lines(run.result) : "", is_reference ? "igrf" : "dipole",
      is_reference ? " and the time" : "", sim::real_text(run.request.line_nm),
      kBlur_px / focal_px / sim::kRadiansPerDegree, kBlur_px, kMapModelError);
}

/// The traces that are claimed, a sentence each, and what the others look like.
std::string border_words(const Measurement& m) {
  const Border& border = *m.border;
  std::string words;
  std::size_t told = 0, more = 0;
  for (std::size_t t = 0; t < border.traces.size(); ++t) {
    if (!border.traces[t].is_claimed() || border.traces[t].measured == 0) continue;
    if (told == kNamedTraces) {
      ++more;
      continue;
    }
    words += (told++ == 0 ? "" : " ") + border_sentence(border, t, *m.border_scene) + ".";
  }
  if (more > 0) words += fmt::format(" And {} more in the table.", more);
  if (told == 0) {
    words = "No lower border of aurora was measured.";
    for (const std::string& note : border.notes) words += " " + note;
  }
  if (const std::string others = unclaimed_words(border); !others.empty())
    words += " Not claimed to be aurora: " + others + ".";
  return words;
}

}  // namespace

void measure_border(MeasureRun& run) {
  MeasureStage& stage = run.begin("The lower border of the light");
  if (run.result.camera_file.empty()) {
    stage.found = "Without the camera's pointing there is no elevation, and so no distance.";
    return;
  }
  MeasureRun::Words words = run.with_site(
      {"border", run.result.camera_file, "--photo", run.request.photo, "--out", run.in_run("border")});
  if (!run.sky_mask.empty()) words.insert(words.end(), {"--mask", run.sky_mask});
  run.run_stage(stage, run.with_common(words), [&](const Tell& tell) {
    sim::Scene scene = sim::read_scene(run.result.camera_file);
    const std::string scene_sha256 = sim::sha256_of_file(run.result.camera_file);
    check_border_directory(run.in_run("border"), true);
    run.make_scene_ready(scene, tell);
    const Photo photo = photograph_for(scene, run.request.photo, run.sky_mask, run.request.decoding);
    const BorderRunFacts facts{stage.command, inputs_of(run.result.camera_file, scene_sha256, photo),
                               photo.decoding};
    const Border& traced =
        run.result.border.emplace(traced_border(scene, photo, {}, run.in_run("border"), true, facts, tell));
    stage.files = {"border/report.html", "border/border.csv"};
    stage.numbers = border_json(traced, scene, facts);
    run.write(stage, "traces.svg", traces_svg(traced, photo, scene), tell);
    run.result.main_border = main_border(traced, scene, run.result.pointing_error_deg);
    run.result.border_scene = std::move(scene);
    if (traced.measured == 0) stage.exit_code = kStageDoubted;
  });
  if (!run.result.border) return;
  run.result.pictures.insert(run.result.pictures.begin(), "traces.svg");
  stage.found = border_words(run.result);
  if (run.result.main_border)
    stage.trust = run.result.has_azimuth && !run.result.is_skyline_open ? Trust::good : Trust::doubtful;
}

void measure_map(MeasureRun& run) {
  if (!run.request.no_map && prepare_map(run).empty()) finish_map(run);
}

std::string prepare_map(MeasureRun& run) {
  MeasureStage& stage = run.begin("Where electrons of which energy fall");
  const bool has_border = run.result.main_border.has_value();
  std::string why;
  if (!run.result.has_azimuth || !has_border || !run.result.site) {
    why = std::string("it needs ") + (!run.result.has_azimuth ? "the camera's directions in the sky"
                                      : !has_border ? "a lower border that is claimed to be aurora's"
                                                    : "the place");
  } else if (!mask_for_map(run, stage)) {
    why = stage.found;
    if (!why.empty() && why.back() == '.') why.pop_back();
  } else {
    run.write("scene.toml", scene_for_map(run));
    return {};
  }
  stage.found = "There is no map: " + why + ".";
  return why;
}

void finish_map(MeasureRun& run) {
  MeasureStage& stage = run.result.stages.back();
  map_light(run, stage);
  if (!run.result.map || run.result.map->result.interrupted) {
    run.result.is_map_interrupted = run.result.is_map_interrupted || run.result.map.has_value();
    stage.found = "There is no map: " + (run.result.is_map_interrupted ? "it was interrupted." : stage.found);
    run.result.map.reset();
    return;
  }
  const PhotoMap& map = *run.result.map;
  run.result.main_curtain =
      main_curtain(map.result, map.curtains, run.result.border->traces[run.result.main_border->trace],
                   *run.result.border_scene);
  stage.trust = run.result.map->is_good() ? Trust::good : Trust::doubtful;
  for (const QuantityVerdict& v : run.result.map->verdicts)
    stage.found += (stage.found.empty() ? "" : " ") + v.quantity + ": " + trust_name(v.trust) +
                   (v.value.empty() ? "" : ", " + v.value) + ".";
}

}  // namespace vegard::fit
