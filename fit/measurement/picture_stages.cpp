#include "fit/measurement/measure_stages.h"

#include <cmath>
#include <filesystem>
#include <utility>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "fit/photo/mask/mask_picture.h"
#include "fit/photo/picture_field_of_view.h"
#include "fit/photo/scene_photos.h"
#include "fit/photo/taken_time.h"
#include "fit/sky_kind/sky_kind.h"
#include "sim/base/utc_time.h"
#include "sim/scene/file/scene_toml.h"

namespace vegard::fit {
namespace {

/// What the picture says, and what is known then of time and place, as JSON.
std::string picture_numbers(const MeasureRun& run, const PhotoFacts& facts) {
  nlohmann::ordered_json numbers = {{"facts", nlohmann::ordered_json::array()}, {"notes", facts.notes}};
  for (const PhotoFact& fact : facts.facts)
    numbers["facts"].push_back({{"path", fact.path}, {"value", fact.value}, {"source", fact.source}});
  if (!run.result.time_utc.empty()) numbers["time_utc"] = run.result.time_utc;
  if (run.result.site)
    numbers["site"] = {{"latitude_deg", run.result.site->latitude_deg},
                       {"longitude_deg", run.result.site->longitude_deg},
                       {"altitude_m", run.result.site->height_m}};
  return json_line(numbers);
}

/// Masks the sky in one way; `finder` are the words that ask for it.
bool mask_sky(MeasureRun& run, MeasureStage& stage, const MeasureRun::Words& finder,
              const MaskRequest& mask) {
  MeasureRun::Words words = {"mask", run.request.photo, "-o", run.sky_mask};
  words.insert(words.end(), finder.begin(), finder.end());
  if (mask.text) words.push_back("--text");
  return run.run_stage(stage, run.with_common(words), [&](const Tell& tell) {
    const Photo photo = read_photo(run.request.photo, run.decoding());
    Mask made = make_mask(photo, mask, tell);
    run.write("sky.png", mask_png(made.left_out));
    if (made.skyline) run.write("horizon.csv", horizon_csv(made.skyline->horizon, photo.file_name));
    tell_mask(made, false, tell);
    stage.numbers = json_line(mask_json(made));
    if (made.used_px() > 0) run.result.sky_kind = kind_of_sky(photo, made.left_out);
    // A set has a byte for each pixel, and later stages read the file.
    made.parts.clear();
    made.left_out = {};
    run.result.sky = std::move(made);
  });
}

/// Takes the time of a given camera's file where none is known. Returns whether it did.
bool take_time_of_camera(MeasureRun& run) {
  if (run.request.camera.empty() || !run.result.time_utc.empty()) return false;
  run.result.time_utc = sim::read_scene(run.request.camera).site.time_utc;
  return !run.result.time_utc.empty();
}

}  // namespace

void describe_picture(MeasureRun& run) {
  MeasureStage& stage = run.begin("What the picture says of itself");
  const sim::PictureMetadata metadata = metadata_with_size(run.request.photo);
  PhotoFacts facts = photo_facts(metadata);
  const std::string light = run.request.decoding.empty() ? assumed_light(run.request.photo) : "";
  if (!light.empty()) facts.notes.push_back(light);
  run.result.has_field_of_view = picture_field_of_view(metadata).hfov_deg.has_value();
  std::vector<double> place;
  for (const PhotoFact& fact : facts.facts) {
    run.follower.tell(fact_text(fact));
    // Latitude, longitude, altitude: in the order of a scene file.
    if (fact.path.rfind("site.l", 0) == 0 || (fact.path == "site.altitude_m" && place.size() == 2))
      place.push_back(as_written(fact.value));
    if (fact.path == "site.time_utc" && run.result.time_utc.empty())
      run.result.time_utc = fact.value.substr(1, fact.value.size() - 2);
  }
  for (const std::string& note : facts.notes) run.follower.tell(note);
  if (!run.result.site && place.size() >= 2 && std::abs(place[0]) <= 90.0)
    run.result.site = sim::Observer{place[0], place[1], place.size() > 2 ? place[2] : 0.0};
  const bool is_of_camera = run.result.is_time_of_camera = take_time_of_camera(run);
  // A camera's file has the time of its stars.
  if (!is_of_camera) {
    run.result.middle_after_s = middle_after_s(metadata);
    run.middle_after_s = run.result.middle_after_s.value_or(0.0);
  }
  const bool has_time = !run.result.time_utc.empty(), has_site = run.result.site.has_value();
  stage.trust = has_time && has_site   ? Trust::good
                : has_time || has_site ? Trust::doubtful
                                       : Trust::unconstrained;
  stage.found = (has_time ? "Taken at " + run.result.time_utc : "The time is not known") +
                (has_site ? "; from " + site_text(*run.result.site) + "." : "; the place is not known.");
  if (is_of_camera) stage.found += " The time is that of the camera's file.";
  if (!light.empty()) stage.found += " Its light: " + light + ".";
  if (!has_time) stage.lacking = "the time: --time 2014-02-21T19:30:40Z";
  if (!has_site) stage.lacking += std::string(has_time ? "" : "; ") + "the place: --site LATITUDE,LONGITUDE";
  run.follower.tell(stage.found);
  stage.numbers = picture_numbers(run, facts);
}

void find_sky(MeasureRun& run) {
  MeasureStage& stage = run.begin("Which part of it is sky");
  run.sky_mask = run.in_run("sky.png");
  MaskRequest mask;
  bool is_masked = false;
  if (!run.request.mask.empty()) {
    mask.drawn = {run.request.mask};
    is_masked = mask_sky(run, stage, {"--draw", run.request.mask}, mask);
  } else {
    mask.text = mask.finds_circle = true;
    is_masked = mask_sky(run, stage, {"--circle", "auto"}, mask);
    if (!is_masked) {
      mask.finds_circle = false;
      mask.finds_skyline = true;
      is_masked =
          mask_sky(run, stage, {"--horizon", "auto", "--horizon-csv", run.in_run("horizon.csv")}, mask);
    }
    if (!is_masked) {
      mask.finds_skyline = false;
      is_masked = mask_sky(run, stage, {}, mask);
    }
  }
  if (!is_masked) {
    run.sky_mask.clear();
    return;
  }
  if (run.result.sky_kind) run.follower.tell("seen as a whole: " + run.result.sky_kind->sentence);
  stage.files = {"sky.png"};
  const bool is_whole = run.request.mask.empty() && !mask.finds_circle && !mask.finds_skyline;
  stage.trust = is_whole ? Trust::doubtful : Trust::good;
  stage.found = "What the given mask leaves.";
  if (mask.finds_circle) stage.found = "A fisheye's circle: " + words_of(*run.result.sky->circle);
  if (mask.finds_skyline) {
    stage.files.emplace_back("horizon.csv");
    stage.found = "Above a skyline: " + words_of(*run.result.sky->skyline);
  }
  if (!is_whole) return;
  stage.found = "Neither a fisheye's circle nor a skyline was found: all of it counts as sky.";
  stage.lacking = "a mask that leaves out the ground: --mask MASK.png (vegard mask)";
}

void doubt_skyline(MeasureRun& run) {
  const std::vector<PixelPoint> skyline = run.skyline();
  if (!run.result.has_azimuth || skyline.empty()) return;
  const sim::Scene scene = sim::read_scene(run.result.camera_file);
  const Photo photo = read_photo(run.request.photo, decoding_for(scene, run.request.decoding));
  SkyOfPicture sky;
  constexpr double kDay_s = 86400.0;
  if (!run.result.time_utc.empty()) sky.julian_date = sim::julian_date(run.result.time_utc);
  if (sky.julian_date) *sky.julian_date += run.middle_after_s / kDay_s;
  sky.observer = run.result.site;
  run.result.skyline_doubt = skyline_doubt(skyline, scene.camera, photo, sky);
  if (!run.result.skyline_doubt) return;
  const SkylineDoubt& doubt = *run.result.skyline_doubt;
  MeasureStage& stage = run.begin("Whether the skyline is the ground's");
  MaskRequest mask;
  mask.text = true;
  mask_sky(run, stage, {}, mask);
  stage.files = {"sky.png"};
  stage.found = fmt::format("The skyline is {:.0f} to {:.0f}° above the horizon over {:.0f}° of azimuth, ",
                            doubt.from_deg, doubt.to_deg, doubt.azimuths_deg);
  if (doubt.has_stars()) {
    stage.trust = Trust::good;
    stage.found += fmt::format(
        "and {} stars shine below it ({:.1f} would by chance): it is no ground, but perhaps the light's own "
        "border, and nothing is masked by it.",
        doubt.stars_below, doubt.by_chance);
    return;
  }
  run.result.is_skyline_open = true;
  stage.trust = Trust::doubtful;
  stage.found +=
      "and is as smooth as a border of light, which it may be: nothing is masked by it. If it is a ridge or "
      "a roof, a border measured there is that of the ground.";
  stage.lacking = "a mask of what is ground: --mask MASK.png (vegard mask)";
}

}  // namespace vegard::fit
