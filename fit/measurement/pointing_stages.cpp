#include "fit/measurement/calibration_words.h"
#include "fit/measurement/measure_stages.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "fit/photo/pointing/catalogue_sky.h"
#include "fit/photo/pointing/held_out.h"
#include "fit/report/calibration_plots.h"
#include "sim/base/utc_time.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {
namespace {

/// What hills, woods and houses leave open of a horizon.

/// Returns the site of which site_text() speaks.
sim::Observer site_as_written(const sim::Observer& site) {
  const auto digits = [](double value) { return as_written(fmt::format("{:.10g}", value)); };
  return {digits(site.latitude_deg), digits(site.longitude_deg), digits(site.height_m)};
}

/// Returns the lowest points of a skyline in ten parts of the picture's width: hills stand above the horizon,
/// nothing below it. There are none of a skyline that is too short.
std::vector<PixelPoint> horizon_points(const std::vector<PixelPoint>& skyline) {
  constexpr std::size_t kParts = 10;
  std::vector<PixelPoint> points;
  if (skyline.size() < 10 * kParts) return points;
  for (std::size_t part = 0; part < kParts; ++part) {
    const auto begin = skyline.begin() + static_cast<std::ptrdiff_t>(part * skyline.size() / kParts);
    const auto end = skyline.begin() + static_cast<std::ptrdiff_t>((part + 1) * skyline.size() / kParts);
    points.push_back(
        *std::max_element(begin, end, [](const auto& a, const auto& b) { return a.y_px < b.y_px; }));
  }
  return points;
}

/// The place over which stars that are known by right ascension and declination alone stood about the zenith
/// at a time; none without stars.
std::optional<sim::Observer> place_below(const std::vector<StarSighting>& stars, const std::string& time) {
  double up[3] = {0.0, 0.0, 0.0};
  for (const StarSighting& star : stars) {
    // The table of recognised stars has as many digits.
    const sim::Equatorial place = equatorial_place({star.enu[0], star.enu[1], star.enu[2]});
    const sim::Direction at{as_written(fmt::format("{:.4f}", place.right_ascension_deg)),
                            as_written(fmt::format("{:.4f}", place.declination_deg))};
    double one[3];
    sim::enu_of_direction(at, one);
    for (int i = 0; i < 3; ++i) up[i] += one[i];
  }
  const double length = std::sqrt(up[0] * up[0] + up[1] * up[1] + up[2] * up[2]);
  if (!(length > 0.0)) return std::nullopt;
  for (double& v : up) v /= length;
  const sim::Direction middle = sim::direction_of_enu(up);
  const double longitude_deg =
      std::remainder(middle.azimuth_deg - sim::mean_sidereal_time_deg(*sim::julian_date(time)), 360.0);
  return sim::Observer{middle.elevation_deg, longitude_deg};
}

/// Finds the lens by recognised stars whose time or place is not known, as if they stood about the zenith.
void lens_by_stars(MeasureRun& run) {
  const std::string time = "2000-01-01T12:00:00Z";
  const std::optional<sim::Observer> place =
      place_below(run.result.stars->blind->picture.recognition.stars(), time);
  if (!place) return;
  const std::string latitude = fmt::format("{:.4f}", place->latitude_deg),
                    longitude = fmt::format("{:.4f}", place->longitude_deg);
  MeasureStage& stage = run.begin("Its lens: the same stars, as if they stood about the zenith");
  const MeasureRun::Words words = {"calibrate",
                                   run.in_run("stars.csv"),
                                   "--image",
                                   run.request.photo,
                                   "--no-metadata",
                                   "--no-refraction",
                                   "--time",
                                   time,
                                   "--site=" + latitude + "," + longitude,
                                   "-o",
                                   run.in_run("lens.toml"),
                                   "--overwrite"};
  const bool is_found = run.run_stage(stage, words, [&](const Tell& tell) {
    CalibrationRequest calibration;
    calibration.stars = run.in_run("stars.csv");
    calibration.image = run.request.photo;
    calibration.output = run.in_run("lens.toml");
    calibration.no_metadata = calibration.vacuum = true;
    calibration.time = time;
    calibration.site = sim::Observer{as_written(latitude), as_written(longitude)};
    CameraCalibration& found = run.result.lens.emplace(calibrate_camera(calibration, tell));
    found.photo.reset();
    tell_calibration(found, tell);
    run.write(stage, "lens.toml", camera_toml(*found.calibration, found.origin), tell);
    stage.numbers = json_line(answer_json(found));
  });
  if (!is_found) return;
  run.lens_file = run.in_run("lens.toml");
  stage.trust = Trust::good;
  stage.found = lens_line(*run.result.lens->calibration) + "; " + rms_line(*run.result.lens->calibration) +
                ". Where that file points to means nothing.";
}

/// Tries the stars first: they alone determine the azimuth.
bool camera_by_stars(MeasureRun& run) {
  MeasureStage& stage = run.begin("Where the camera points: stars");
  MeasureRun::Words words = {"calibrate",
                             "--image",
                             run.request.photo,
                             "-o",
                             run.in_run("camera.toml"),
                             "--stars-out",
                             run.in_run("stars.csv"),
                             "--overlay",
                             run.in_run("stars.png")};
  if (!run.sky_mask.empty()) words.insert(words.end(), {"--mask", run.sky_mask});
  // A time that the picture tells has an error that is not seen in its text.
  const std::string time = run.request.time.empty() ? "" : run.result.time_utc;
  if (!time.empty()) words.insert(words.end(), {"--time", time});
  if (run.result.site) words.push_back("--site=" + site_text(*run.result.site));
  run.run_stage(stage, run.with_common(words), [&](const Tell& tell) {
    CalibrationRequest calibration;
    calibration.image = run.request.photo;
    calibration.output = run.in_run("camera.toml");
    calibration.keeps_recognised = true;
    calibration.mask = run.sky_mask;
    calibration.decoding = run.request.decoding;
    calibration.time = time;
    if (run.result.site) calibration.site = site_as_written(*run.result.site);
    CameraCalibration& found = run.result.stars.emplace(calibrate_camera(calibration, tell));
    if (found.calibration) tell_calibration(found, tell);
    if (const std::string table = recognised_table(found); !table.empty())
      run.write(stage, "stars.csv", table, tell);
    if (found.calibration) {
      run.write(stage, "camera.toml", camera_toml(*found.calibration, found.origin), tell);
      run.write(stage, "stars.png", star_overlay(*found.calibration, *found.photo), tell);
    } else if (found.blind && found.blind->place) {
      run.write(stage, "stars.png", star_overlay(found.blind->picture.recognition, *found.photo), tell);
    }
    std::sort(stage.files.begin(), stage.files.end());
    found.photo.reset();
    stage.numbers = json_line(answer_json(found));
    if (!found.has_answer) stage.exit_code = kStageDoubted;
  });
  if (!run.result.stars) {
    stage.found = "No camera follows from the stars: " + stage.found;
  } else if (const auto& calibration = run.result.stars->calibration) {
    run.result.camera_file = run.in_run("camera.toml");
    run.result.has_azimuth = true;
    stage.trust = Trust::good;
    stage.found = "The stars were recognised. " + rms_line(*calibration) + ". " + axis_line(*calibration) +
                  ". " + held_out_line(*calibration);
    if (const std::string points = explained_line(*calibration); !points.empty())
      stage.found += "; " + points;
    run.result.pictures.emplace_back("stars.png");
    return true;
  } else if (const BlindStars& blind = *run.result.stars->blind; blind.place) {
    stage.trust = Trust::doubtful;
    stage.found =
        "The stars were recognised, but not in azimuth and elevation: " + middle_words(*blind.place) + "; " +
        width_words(*blind.place, blind.picture.recognition.best) + ".";
    stage.lacking = run.result.time_utc.empty() ? "the time: --time"
                    : !run.result.site          ? "the place: --site"
                                                : "the right time and place: " + elsewhere_line(*blind.local);
    if (!run.skyline().empty()) lens_by_stars(run);
    return false;
  } else {
    stage.found = "No stars were recognised. " + words_of(blind.picture.recognition);
  }
  stage.lacking =
      "a picture with more stars in it, or sharper ones; or a camera file of the same camera: --camera";
  return false;
}

/// With an azimuth, as `vegard horizon --azimuth` takes it; empty: none is known.
bool camera_by_horizon(MeasureRun& run, MeasureStage& stage, const std::string& azimuth_deg = "") {
  HorizonRequest horizon;
  horizon.photo = run.request.photo;
  horizon.lens = run.lens_file;  // stars measure the lens, a picture's file only says what it is called
  MeasureRun::Words words = {"horizon", run.request.photo, "-o", run.in_run("camera.toml"), "--points"};
  for (const PixelPoint& point : horizon_points(run.skyline())) {
    const std::string x = fmt::format("{:.1f}", point.x_px), y = fmt::format("{:.1f}", point.y_px);
    horizon.points.push_back({as_written(x), as_written(y)});
    words.push_back(x + "," + y);
  }
  if (horizon.points.empty()) return false;
  if (!run.lens_file.empty()) words.insert(words.end(), {"--lens", run.lens_file});
  horizon.relief_deg = kSkylineRelief_deg;
  words.insert(words.end(), {"--relief-deg", fmt::format("{:g}", kSkylineRelief_deg)});
  if (!azimuth_deg.empty()) {
    horizon.azimuth_deg = as_written(azimuth_deg);
    words.insert(words.end(), {"--azimuth", azimuth_deg});
  }
  words.emplace_back("--overwrite");
  return run.run_stage(stage, words, [&](const Tell& tell) {
    const HorizonCamera& found = run.result.horizon.emplace(fit::camera_by_horizon(horizon));
    tell_horizon(found, tell);
    run.write(stage, "camera.toml", horizon_toml(found), tell);
    stage.numbers = json_line(horizon_json(found));
  });
}

/// Stars that are recognised without time or place tell, above a horizon, in which azimuth they are.
void azimuth_by_stars(MeasureRun& run) {
  if (!run.result.stars || !run.result.stars->blind || !run.result.stars->blind->place) return;
  const HorizonCalibration& horizon = run.result.horizon->found;
  const std::optional<StarsOverHorizon> found = stars_over_horizon(
      run.result.stars->blind->picture.recognition.stars(), sim::read_scene(run.result.camera_file).camera,
      horizon.elevation_deg.sigma, horizon.roll_deg.sigma);
  constexpr double kUseless_deg = 45.0;  // a wind of eight is as wide
  if (!found || !(found->azimuth_error_deg < kUseless_deg)) return;
  MeasureStage& stage = run.begin("In which azimuth: the stars above that horizon");
  if (!camera_by_horizon(run, stage, fmt::format("{:.1f}", found->azimuth_deg))) return;
  run.result.over_horizon = found;
  std::optional<double> julian_date;
  if (!run.result.time_utc.empty()) julian_date = sim::julian_date(run.result.time_utc);
  stage.trust = Trust::doubtful;
  stage.found = "With up from the skyline and north from the stars, " + words_of(*found, julian_date) + ".";
  stage.lacking = std::string(run.result.time_utc.empty() ? "the time: --time; " : "") +
                  (run.result.site ? "" : "the place: --site");
  run.follower.tell(stage.found);
}

}  // namespace

void find_camera(MeasureRun& run) {
  if (!run.request.camera.empty()) {
    MeasureStage& stage = run.begin("Where the camera points");
    run.result.camera_file = run.request.camera;
    run.result.has_azimuth = true;
    stage.trust = Trust::good;
    stage.found = "As " + std::filesystem::path(run.request.camera).filename().string() + " says.";
    return;
  }
  if (camera_by_stars(run)) return;
  MeasureStage& stage = run.begin(kHorizonStage);
  const bool has_skyline = !run.skyline().empty();
  if (!has_skyline || (!run.result.has_field_of_view && run.lens_file.empty())) {
    stage.found = !has_skyline ? "There is no skyline that could serve as the horizon."
                               : "A skyline is there, but the picture's field of view is not known.";
    stage.lacking =
        "points on the horizon and the field of view: vegard horizon PHOTO --points X,Y X,Y --hfov DEGREES "
        "-o camera.toml, then vegard measure PHOTO --camera camera.toml";
    return;
  }
  if (!camera_by_horizon(run, stage)) {
    stage.found = "The skyline is no horizon: " + stage.found;
    return;
  }
  run.result.camera_file = run.in_run("camera.toml");
  run.result.pointing_error_deg = run.result.horizon->found.elevation_deg.sigma;
  stage.trust = Trust::doubtful;
  stage.found = "From the skyline and the field of view" +
                std::string(run.lens_file.empty() ? ": " : " found from the stars: ") +
                elevation_line(*run.result.horizon) +
                ". The skyline may be a degree or more above the horizon, and the azimuth is not known (0 "
                "is assumed).";
  const bool has_stars = run.result.stars && run.result.stars->blind && run.result.stars->blind->place;
  stage.lacking = has_stars ? "the right time and place for the stars: --time, --site"
                            : "stars in the picture, with time and place";
  azimuth_by_stars(run);
}

}  // namespace vegard::fit
