#include "fit/measurement/measure.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "fit/answer/input_files.h"
#include "fit/photo/frames/frame_name.h"
#include "fit/photo/mask/mask_picture.h"
#include "fit/photo/picture_field_of_view.h"
#include "fit/photo/pointing/catalogue_sky.h"
#include "fit/photo/scene_photos.h"
#include "fit/ready_scene.h"
#include "fit/report/border/border_run.h"
#include "fit/report/calibration_plots.h"
#include "fit/report/map_run.h"
#include "sim/base/file/sha256.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/shown_text.h"
#include "sim/base/utc_time.h"
#include "sim/scene/file/camera_file.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/camera/camera.h"
#include "sim/view/camera/direction_map.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {
namespace {

namespace fs = std::filesystem;

constexpr double kLowestMapped_deg = 8.0;  // light at the horizon becomes a ring in the farthest cells
constexpr double kBesideTraces_deg = 12.0, kBelowTraces_deg = 6.0;
constexpr double kMappedShare = 0.25;  // of the brightest trace's light: fainter ones are the map's clutter
constexpr double kBlur_px = 1.2;       // what lenses and demosaicing leave of a point
constexpr double kMapModelError = 0.03;
/// Exit codes of the stages' commands.
constexpr int kGood = 0, kDoubted = 5, kInterrupted = 130;

int exit_code_of(sim::ErrorKind kind) {
  switch (kind) {
    case sim::ErrorKind::unreadable_input:
      return 3;
    case sim::ErrorKind::unwritable_output:
      return 6;
    default:
      return 2;
  }
}

/// Returns a number as a command has it that was shown it as text.
double as_written(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::string json_text(const nlohmann::ordered_json& json) {
  // A file's name may hold bytes that are no UTF-8.
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// "78.148,16.043,520", as --site takes it.
std::string site_text(const sim::Observer& site) {
  return fmt::format("{:.10g},{:.10g},{:.10g}", site.latitude_deg, site.longitude_deg, site.height_m);
}

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

/// Where one border was traced.
struct TracedRange {
  double middle_deg, half_width_deg, lowest_deg;
};

/// The ranges of azimuth of all traces but the faint ones.
std::vector<TracedRange> traced_ranges(const Border& border, const sim::Scene& scene) {
  double brightest = 0.0;
  for (const BorderTrace& trace : border.traces)
    if (trace.measured > 0) brightest = std::max(brightest, trace.mean_brightness());
  std::vector<TracedRange> ranges;
  for (const BorderTrace& trace : border.traces) {
    const BorderSummary summary = border_summary(trace, scene);
    if (trace.measured == 0 || !std::isfinite(summary.from_azimuth_deg) ||
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

class Measuring {
 public:
  Measuring(const MeasureRequest& request, const MeasureFollower& follower)
      : request_(request), follower_(follower) {
    result_.command = request.command;
    result_.photo = fs::path(request.photo).filename().string();
    result_.out = request.out.empty() ? stem_of_picture(request.photo) + "_measured" : request.out;
  }

  Measurement run() {
    read_given();
    claim_folder();
    picture();
    sky();
    camera();
    if (!result_.camera_file.empty()) result_.camera = sim::read_scene(result_.camera_file).camera;
    doubt_skyline();
    border();
    map();
    conclude();
    return std::move(result_);
  }

 private:
  using Words = std::vector<std::string>;

  std::string in_run(const std::string& name) const { return result_.out + "/" + name; }

  MeasureStage& begin(const std::string& title) {
    follower_.tell("");
    follower_.tell(title);
    result_.stages.emplace_back();
    result_.stages.back().title = title;
    return result_.stages.back();
  }

  /// The work of a command: it is shown, what it tells is kept, and an error ends it alone.
  template <class Work>
  bool run_stage(MeasureStage& stage, const Words& words, const Work& work) {
    stage.command = "vegard";
    for (const std::string& word : words) stage.command += " " + sim::quoted_for_shell(word);
    stage.words.clear();
    stage.exit_code = kGood;
    follower_.tell("$ " + stage.command);
    const Tell tell([&](const std::string& line, Tell::Tone tone) {
      stage.words += sim::shown_text(line) + "\n";
      follower_.tell(line, tone);
    });
    try {
      work(tell);
    } catch (const sim::Error& error) {
      if (error.kind() == sim::ErrorKind::unwritable_output ||
          error.kind() == sim::ErrorKind::existing_output)
        throw;  // no stage will do better
      stage.exit_code = exit_code_of(error.kind());
      stage.found = error.what();
      tell(error.what());
    }
    return stage.exit_code == kGood;
  }

  /// Words that the command of every stage with a picture takes.
  Words with_common(Words words) const {
    if (!request_.decoding.empty()) words.insert(words.end(), {"--decoding", request_.decoding});
    words.push_back("--overwrite");
    return words;
  }
  Words with_site(Words words) const {
    for (const auto& [path, value] : changes_of_site())
      words.insert(words.end(), {"--set", path + "=" + value});
    return words;
  }
  /// The place, as changes of a scene.
  std::vector<std::pair<std::string, std::string>> changes_of_site() const {
    if (!result_.site) return {};
    return {{"site.latitude_deg", sim::real_text(result_.site->latitude_deg)},
            {"site.longitude_deg", sim::real_text(result_.site->longitude_deg)},
            {"site.altitude_m", sim::real_text(result_.site->height_m)}};
  }
  /// A scene as a command makes it ready that gets the place as changes.
  std::vector<PhotoFact> make_scene_ready(sim::Scene& scene, const Tell& tell) const {
    std::set<std::string> changed;
    for (const auto& [path, value] : changes_of_site()) {
      sim::set_from_text(scene, path, value);
      changed.insert(path);
    }
    make_ready(scene);
    scene.fit.photos.clear();  // the photograph is the command line's, the camera and the site the scene's
    return take_from_photograph(scene, request_.photo, changed, tell);
  }

  Decoding decoding() const {
    return decoding_of_word(request_.decoding.empty() ? "auto" : request_.decoding);
  }

  /// Writes a file of the run, but not over what the user gave.
  void write(const std::string& name, const std::string& bytes) const {
    std::error_code ignored;
    for (const std::string& input : {file_of_frame(request_.photo), request_.camera, request_.mask})
      if (!input.empty() && fs::equivalent(in_run(name), input, ignored))
        throw sim::Error(sim::ErrorKind::usage, "'" + in_run(name) + "' is an input as well")
            .key("--output")
            .hint("choose another name");
    sim::write_whole(in_run(name), bytes, true);
  }
  void write(MeasureStage& stage, const std::string& name, const std::string& bytes, const Tell& tell) const {
    write(name, bytes);
    stage.files.push_back(name);
    tell(in_run(name));
  }

  std::vector<PixelPoint> skyline() const;
  void read_given();
  void claim_folder() const;
  void picture();
  std::string picture_numbers(const PhotoFacts& facts) const;
  void sky();
  bool mask_sky(MeasureStage& stage, const Words& finder, const MaskRequest& mask);
  void camera();
  bool camera_by_stars();
  void lens_by_stars();
  bool camera_by_horizon(MeasureStage& stage);
  void doubt_skyline();
  void border();
  void map();
  bool mask_for_map(MeasureStage& stage);
  std::string scene_for_map() const;
  void map_light(MeasureStage& stage);
  std::vector<std::string> answer_sentences() const;
  void conclude();

  const MeasureRequest& request_;
  const MeasureFollower& follower_;
  Measurement result_;
  std::string sky_mask_;          ///< file; empty if all of the picture may be sky
  std::string lens_file_;         ///< a camera whose lens alone is known; empty: it is not
  bool has_focal_ = false;        ///< the picture gives the field of view
  bool is_skyline_open_ = false;  ///< whether it is ground or the light's own border is not decided
};

/// Reads what is given of time, place and camera, and refuses before any stage what nobody can read.
void Measuring::read_given() {
  if (!request_.time.empty()) {
    const std::optional<double> seconds = sim::utc_seconds(request_.time);
    if (!seconds)
      throw usage_error("--time", "'" + request_.time + "' is no time",
                        "ISO 8601 such as 2014-02-21T19:30:40Z, or with a zone, 2014-02-21T20:30:40+01:00");
    result_.time_utc = sim::utc_text(*seconds);
  }
  result_.site = request_.site;
  metadata_with_size(request_.photo);  // throws if there is no picture
  if (request_.camera.empty()) return;
  const sim::Scene scene = sim::read_scene(request_.camera);
  if (!result_.site && scene.lines.count("site.latitude_deg") + scene.lines.count("site.longitude_deg") == 2)
    result_.site = sim::Observer{scene.site.latitude_deg, scene.site.longitude_deg, scene.site.altitude_m};
}

void Measuring::claim_folder() const {
  std::error_code failed;
  const std::string& out = result_.out;
  const bool is_there = fs::exists(out, failed);
  if (is_there && !fs::is_directory(out, failed))
    throw sim::Error(sim::ErrorKind::existing_output, "is no folder").file(out);
  if (is_there && !fs::is_empty(out, failed) && !request_.overwrite)
    throw sim::Error(sim::ErrorKind::existing_output,
                     "exists already (--overwrite replaces what vegard wrote there)")
        .file(out);
  if (is_there && !fs::is_empty(out, failed) && !fs::exists(in_run("measure.json")) &&
      !fs::exists(in_run("mask.png")))
    throw sim::Error(sim::ErrorKind::existing_output, "holds something that is no measurement").file(out);
  fs::create_directories(out, failed);
  if (failed)
    throw sim::Error(sim::ErrorKind::unwritable_output, "cannot be made: " + failed.message()).file(out);
}

void Measuring::picture() {
  MeasureStage& stage = begin("What the picture says of itself");
  const sim::PictureMetadata metadata = metadata_with_size(request_.photo);
  const PhotoFacts facts = photo_facts(metadata);
  has_focal_ = picture_field_of_view(metadata).hfov_deg.has_value();
  std::vector<double> place;
  for (const PhotoFact& fact : facts.facts) {
    follower_.tell(fact_text(fact));
    // Latitude, longitude, altitude: in the order of a scene file.
    if (fact.path.rfind("site.l", 0) == 0 || (fact.path == "site.altitude_m" && place.size() == 2))
      place.push_back(as_written(fact.value));
    if (fact.path == "site.time_utc" && result_.time_utc.empty())
      result_.time_utc = fact.value.substr(1, fact.value.size() - 2);
  }
  for (const std::string& note : facts.notes) follower_.tell(note);
  if (!result_.site && place.size() >= 2 && std::abs(place[0]) <= 90.0)
    result_.site = sim::Observer{place[0], place[1], place.size() > 2 ? place[2] : 0.0};
  const bool has_time = !result_.time_utc.empty(), has_site = result_.site.has_value();
  stage.trust = has_time && has_site   ? Trust::good
                : has_time || has_site ? Trust::doubtful
                                       : Trust::unconstrained;
  stage.found = (has_time ? "Taken at " + result_.time_utc : "The time is not known") +
                (has_site ? "; from " + site_text(*result_.site) + "." : "; the place is not known.");
  if (!has_time) stage.lacking = "the time: --time 2014-02-21T19:30:40Z";
  if (!has_site) stage.lacking += std::string(has_time ? "" : "; ") + "the place: --site LATITUDE,LONGITUDE";
  follower_.tell(stage.found);
  stage.numbers = picture_numbers(facts);
}

/// What the picture says, and what is known then of time and place, as JSON.
std::string Measuring::picture_numbers(const PhotoFacts& facts) const {
  nlohmann::ordered_json numbers = {{"facts", nlohmann::ordered_json::array()}, {"notes", facts.notes}};
  for (const PhotoFact& fact : facts.facts)
    numbers["facts"].push_back({{"path", fact.path}, {"value", fact.value}, {"source", fact.source}});
  if (!result_.time_utc.empty()) numbers["time_utc"] = result_.time_utc;
  if (result_.site)
    numbers["site"] = {{"latitude_deg", result_.site->latitude_deg},
                       {"longitude_deg", result_.site->longitude_deg},
                       {"altitude_m", result_.site->height_m}};
  return json_text(numbers);
}

/// Masks the sky in one way; `finder` are the words that ask for it.
bool Measuring::mask_sky(MeasureStage& stage, const Words& finder, const MaskRequest& mask) {
  Words words = {"mask", request_.photo, "-o", sky_mask_};
  words.insert(words.end(), finder.begin(), finder.end());
  if (mask.text) words.push_back("--text");
  return run_stage(stage, with_common(words), [&](const Tell& tell) {
    const Photo photo = read_photo(request_.photo, decoding());
    const Mask made = make_mask(photo, mask);
    write("sky.png", mask_png(made.left_out));
    if (made.skyline) write("horizon.csv", horizon_csv(made.skyline->horizon, photo.file_name));
    tell_mask(made, false, tell);
    stage.numbers = json_text(mask_json(made));
    result_.sky = made;
  });
}

void Measuring::sky() {
  MeasureStage& stage = begin("Which part of it is sky");
  sky_mask_ = in_run("sky.png");
  MaskRequest mask;
  bool is_masked = false;
  if (!request_.mask.empty()) {
    mask.drawn = {request_.mask};
    is_masked = mask_sky(stage, {"--draw", request_.mask}, mask);
  } else {
    mask.text = mask.finds_circle = true;
    is_masked = mask_sky(stage, {"--circle", "auto"}, mask);
    if (!is_masked) {
      mask.finds_circle = false;
      mask.finds_skyline = true;
      is_masked = mask_sky(stage, {"--horizon", "auto", "--horizon-csv", in_run("horizon.csv")}, mask);
    }
    if (!is_masked) {
      mask.finds_skyline = false;
      is_masked = mask_sky(stage, {}, mask);
    }
  }
  if (!is_masked) {
    sky_mask_.clear();
    return;
  }
  stage.files = {"sky.png"};
  const bool is_whole = request_.mask.empty() && !mask.finds_circle && !mask.finds_skyline;
  stage.trust = is_whole ? Trust::doubtful : Trust::good;
  stage.found = "What the given mask leaves.";
  if (mask.finds_circle) stage.found = "A fisheye's circle: " + words_of(*result_.sky->circle);
  if (mask.finds_skyline) {
    stage.files.emplace_back("horizon.csv");
    stage.found = "Above a skyline: " + words_of(*result_.sky->skyline);
  }
  if (!is_whole) return;
  stage.found = "Neither a fisheye's circle nor a skyline was found: all of it counts as sky.";
  stage.lacking = "a mask that leaves out the ground: --mask MASK.png (vegard mask)";
}

/// Returns a point for each column; none if no skyline was found.
std::vector<PixelPoint> Measuring::skyline() const {
  std::vector<PixelPoint> points;
  if (!result_.sky || !result_.sky->skyline) return points;
  for (const double y_px : result_.sky->skyline->horizon.y_px)
    points.push_back({static_cast<double>(points.size()) + 0.5, y_px});
  return points;
}

void Measuring::camera() {
  if (!request_.camera.empty()) {
    MeasureStage& stage = begin("Where the camera points");
    result_.camera_file = request_.camera;
    result_.has_azimuth = true;
    stage.trust = Trust::good;
    stage.found = "As " + fs::path(request_.camera).filename().string() + " says.";
    return;
  }
  if (camera_by_stars()) return;
  MeasureStage& stage = begin("Where the camera points: the horizon");
  const bool has_skyline = !skyline().empty();
  if (!has_skyline || (!has_focal_ && lens_file_.empty())) {
    stage.found = !has_skyline ? "There is no skyline that could serve as the horizon."
                               : "A skyline is there, but the picture's field of view is not known.";
    stage.lacking =
        "points on the horizon and the field of view: vegard horizon PHOTO --points X,Y X,Y --hfov DEGREES "
        "-o camera.toml, then vegard measure PHOTO --camera camera.toml";
    return;
  }
  if (!camera_by_horizon(stage)) {
    stage.found = "The skyline is no horizon: " + stage.found;
    return;
  }
  result_.camera_file = in_run("camera.toml");
  stage.trust = Trust::doubtful;
  stage.found = "From the skyline and the field of view" +
                std::string(lens_file_.empty() ? ": " : " found from the stars: ") +
                elevation_line(*result_.horizon) +
                ". The skyline may be a degree or more above the horizon, and the azimuth is not known (0 "
                "is assumed).";
  stage.lacking = "stars in the picture, with time and place";
}

/// Tries the stars first: they alone determine the azimuth.
bool Measuring::camera_by_stars() {
  MeasureStage& stage = begin("Where the camera points: stars");
  Words words = {"calibrate",           "--image",     request_.photo,      "-o",
                 in_run("camera.toml"), "--stars-out", in_run("stars.csv"), "--overlay",
                 in_run("stars.png")};
  if (!sky_mask_.empty()) words.insert(words.end(), {"--mask", sky_mask_});
  if (!result_.time_utc.empty()) words.insert(words.end(), {"--time", result_.time_utc});
  if (result_.site) words.push_back("--site=" + site_text(*result_.site));
  run_stage(stage, with_common(words), [&](const Tell& tell) {
    CalibrationRequest calibration;
    calibration.image = request_.photo;
    calibration.output = in_run("camera.toml");
    calibration.keeps_recognised = true;
    calibration.mask = sky_mask_;
    calibration.decoding = request_.decoding;
    calibration.time = result_.time_utc;
    if (result_.site) calibration.site = site_as_written(*result_.site);
    CameraCalibration& found = result_.stars.emplace(calibrate_camera(calibration, tell));
    if (found.calibration) tell_calibration(found, tell);
    if (const std::string table = recognised_table(found); !table.empty())
      write(stage, "stars.csv", table, tell);
    if (found.calibration) {
      write(stage, "camera.toml", camera_toml(*found.calibration, found.origin), tell);
      write(stage, "stars.png", star_overlay(*found.calibration, *found.photo), tell);
    }
    std::sort(stage.files.begin(), stage.files.end());
    found.photo.reset();
    stage.numbers = json_text(answer_json(found));
    if (!found.has_answer) stage.exit_code = kDoubted;
  });
  if (!result_.stars) {
    stage.found = "No camera follows from the stars: " + stage.found;
  } else if (const auto& calibration = result_.stars->calibration) {
    result_.camera_file = in_run("camera.toml");
    result_.has_azimuth = true;
    stage.trust = Trust::good;
    stage.found = "The stars were recognised. " + rms_line(*calibration) + ". " + axis_line(*calibration);
    result_.pictures.emplace_back("stars.png");
    return true;
  } else if (const BlindStars& blind = *result_.stars->blind; blind.place) {
    stage.trust = Trust::doubtful;
    stage.found =
        "The stars were recognised, but not in azimuth and elevation: " + middle_words(*blind.place) + "; " +
        width_words(*blind.place, blind.picture.recognition.best) + ".";
    stage.lacking = result_.time_utc.empty() ? "the time: --time"
                    : !result_.site          ? "the place: --site"
                                             : "the right time and place: " + elsewhere_line(*blind.local);
    if (!skyline().empty()) lens_by_stars();
    return false;
  } else {
    stage.found = "No stars were recognised. " + words_of(blind.picture.recognition);
  }
  stage.lacking =
      "a picture with more stars in it, or sharper ones; or a camera file of the same camera: --camera";
  return false;
}

/// Finds the lens by recognised stars whose time or place is not known, as if they stood about the zenith.
void Measuring::lens_by_stars() {
  const std::string time = "2000-01-01T12:00:00Z";
  const std::optional<sim::Observer> place =
      place_below(result_.stars->blind->picture.recognition.stars(), time);
  if (!place) return;
  const std::string latitude = fmt::format("{:.4f}", place->latitude_deg),
                    longitude = fmt::format("{:.4f}", place->longitude_deg);
  MeasureStage& stage = begin("Its lens: the same stars, as if they stood about the zenith");
  const Words words = {"calibrate",
                       in_run("stars.csv"),
                       "--image",
                       request_.photo,
                       "--no-metadata",
                       "--no-refraction",
                       "--time",
                       time,
                       "--site=" + latitude + "," + longitude,
                       "-o",
                       in_run("lens.toml"),
                       "--overwrite"};
  const bool is_found = run_stage(stage, words, [&](const Tell& tell) {
    CalibrationRequest calibration;
    calibration.stars = in_run("stars.csv");
    calibration.image = request_.photo;
    calibration.output = in_run("lens.toml");
    calibration.no_metadata = calibration.vacuum = true;
    calibration.time = time;
    calibration.site = sim::Observer{as_written(latitude), as_written(longitude)};
    CameraCalibration& found = result_.lens.emplace(calibrate_camera(calibration, tell));
    found.photo.reset();
    tell_calibration(found, tell);
    write(stage, "lens.toml", camera_toml(*found.calibration, found.origin), tell);
    stage.numbers = json_text(answer_json(found));
  });
  if (!is_found) return;
  lens_file_ = in_run("lens.toml");
  stage.trust = Trust::good;
  stage.found = lens_line(*result_.lens->calibration) + "; " + rms_line(*result_.lens->calibration) +
                ". Where that file points to means nothing.";
}

bool Measuring::camera_by_horizon(MeasureStage& stage) {
  HorizonRequest horizon;
  horizon.photo = request_.photo;
  horizon.lens = lens_file_;  // stars measure the lens, a picture's file only says what it is called
  Words words = {"horizon", request_.photo, "-o", in_run("camera.toml"), "--points"};
  for (const PixelPoint& point : horizon_points(skyline())) {
    const std::string x = fmt::format("{:.1f}", point.x_px), y = fmt::format("{:.1f}", point.y_px);
    horizon.points.push_back({as_written(x), as_written(y)});
    words.push_back(x + "," + y);
  }
  if (horizon.points.empty()) return false;
  if (!lens_file_.empty()) words.insert(words.end(), {"--lens", lens_file_});
  words.emplace_back("--overwrite");
  return run_stage(stage, words, [&](const Tell& tell) {
    const HorizonCamera& found = result_.horizon.emplace(fit::camera_by_horizon(horizon));
    tell_horizon(found, tell);
    write(stage, "camera.toml", horizon_toml(found), tell);
    stage.numbers = json_text(horizon_json(found));
  });
}

/// A light's sharp lower border over a dark sky may have passed for a skyline: what is below it is sky then.
void Measuring::doubt_skyline() {
  const std::vector<PixelPoint> skyline = this->skyline();
  if (!result_.has_azimuth || skyline.empty()) return;
  const sim::Scene scene = sim::read_scene(result_.camera_file);
  const Photo photo = read_photo(request_.photo, decoding_for(scene, request_.decoding));
  SkyOfPicture sky;
  if (!result_.time_utc.empty()) sky.julian_date = sim::julian_date(result_.time_utc);
  sky.observer = result_.site;
  result_.skyline_doubt = skyline_doubt(skyline, scene.camera, photo, sky);
  if (!result_.skyline_doubt) return;
  const SkylineDoubt& doubt = *result_.skyline_doubt;
  MeasureStage& stage = begin("Whether the skyline is the ground's");
  MaskRequest mask;
  mask.text = true;
  mask_sky(stage, {}, mask);
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
  is_skyline_open_ = true;
  stage.trust = Trust::doubtful;
  stage.found +=
      "and is as smooth as a border of light, which it may be: nothing is masked by it. If it is a ridge or "
      "a roof, a border measured there is that of the ground.";
  stage.lacking = "a mask of what is ground: --mask MASK.png (vegard mask)";
}

void Measuring::border() {
  MeasureStage& stage = begin("The lower border of the light");
  if (result_.camera_file.empty()) {
    stage.found = "Without the camera's pointing there is no elevation, and so no distance.";
    return;
  }
  Words words =
      with_site({"border", result_.camera_file, "--photo", request_.photo, "--out", in_run("border")});
  if (!sky_mask_.empty()) words.insert(words.end(), {"--mask", sky_mask_});
  run_stage(stage, with_common(words), [&](const Tell& tell) {
    sim::Scene scene = sim::read_scene(result_.camera_file);
    const std::string scene_sha256 = sim::sha256_of_file(result_.camera_file);
    check_border_directory(in_run("border"), true);
    make_scene_ready(scene, tell);
    const Photo photo = photograph_for(scene, request_.photo, sky_mask_, request_.decoding);
    const BorderRunFacts facts{stage.command, inputs_of(result_.camera_file, scene_sha256, {photo}),
                               photo.decoding};
    const Border& traced =
        result_.border.emplace(traced_border(scene, photo, {}, in_run("border"), true, facts, tell));
    stage.files = {"border/report.html", "border/border.csv"};
    stage.numbers = border_json(traced, scene, facts);
    result_.border_scene = std::move(scene);
    if (traced.measured == 0) stage.exit_code = kDoubted;
  });
  if (!result_.border) return;
  if (result_.border->measured == 0) {
    stage.found = "No lower border was measured.";
    for (const std::string& note : result_.border->notes) stage.found += " " + note;
    return;
  }
  stage.trust = result_.has_azimuth && !is_skyline_open_ ? Trust::good : Trust::doubtful;
  for (std::size_t t = 0; t < result_.border->traces.size(); ++t)
    if (result_.border->traces[t].measured > 0)
      stage.found +=
          (stage.found.empty() ? "" : " ") + border_sentence(*result_.border, t, *result_.border_scene);
  result_.pictures.insert(result_.pictures.begin(), "border/border.svg");
}

/// Masks all but pixels of light near the borders, without stars.
bool Measuring::mask_for_map(MeasureStage& stage) {
  write("region.png", mask_png(away_from_traces(*result_.border, *result_.border_scene)));
  MaskRequest mask;
  mask.drawn = {in_run("region.png")};
  mask.stars = true;
  Words words = {"mask", request_.photo, "-o", in_run("mask.png"), "--draw", in_run("region.png"), "--stars"};
  if (!sky_mask_.empty()) {
    words.insert(words.end(), {"--draw", sky_mask_});
    mask.drawn.push_back(sky_mask_);
  }
  return run_stage(stage, with_common(words), [&](const Tell& tell) {
    const Mask made = make_mask(read_photo(request_.photo, decoding()), mask);
    write("mask.png", mask_png(made.left_out));
    tell_mask(made, false, tell);
  });
}

void Measuring::map_light(MeasureStage& stage) {
  const Words words = with_common(
      with_site({"map", in_run("scene.toml"), "--camera", result_.camera_file, "--photo", request_.photo,
                 "--mask", in_run("mask.png"), "--out", in_run("map"), "--replicates",
                 std::to_string(request_.replicates), "--threads", std::to_string(request_.threads)}));
  run_stage(stage, words, [&](const Tell& tell) {
    sim::Scene scene = sim::read_scene(in_run("scene.toml"));
    sim::take_camera(scene, result_.camera_file);
    MapRunFacts facts;
    facts.command = stage.command;
    const std::string scene_sha256 = sim::sha256_of_file(in_run("scene.toml"));
    check_map_directory(in_run("map"), true);
    facts.from_photograph = make_scene_ready(scene, tell);
    const std::vector<Photo> photos = {
        photograph_for(scene, request_.photo, in_run("mask.png"), request_.decoding)};
    facts.inputs = inputs_of(in_run("scene.toml"), scene_sha256, photos);
    MapOptions options;
    options.threads = request_.threads;
    options.replicates = request_.replicates;
    FileJournal journal(journal_file(in_run("map")), subject_of_map(options, scene, photos),
                        JournalMode::overwrite);
    if (follower_.map_begins) follower_.map_begins(options);
    const PhotoMap& made = result_.map.emplace(mapped_photos(scene, photos, std::move(options), journal));
    write_map(made, photos, in_run("map"), true, facts, journal, tell);
    for (const char* file :
         {"scene.toml", "mask.png", "map/report.html", "map/precipitation.fits", "map/curtains.csv"})
      stage.files.emplace_back(file);
    stage.numbers = map_json(made.result, made.curtains, made.verdicts, facts);
    stage.exit_code = made.result.interrupted ? kInterrupted : made.is_good() ? kGood : kDoubted;
  });
}

/// Returns the scene that the map and later fits are made with, beside the camera.
std::string Measuring::scene_for_map() const {
  const double focal_px = sim::camera_view(*result_.camera).lens.focal_px;
  return fmt::format(
      "# For vegard map and vegard fit, with --camera {}, by vegard measure of {}\n"
      "seed = 1\n"
      "[field]\n"
      "model = \"dipole\"     # follows from the site\n"
      "[sensor]\n"
      "response = \"grey\"    # the green channel alone: the camera's colours are not known\n"
      "[emission]\n"
      "lines = [{}]\n"
      "[blur]\n"
      "width_deg = [{:.3g}]  # assumed: {} px\n"
      "[fit]\n"
      "model_error = {}\n",
      fs::path(result_.camera_file).filename().string(), sim::comment_words(result_.photo),
      sim::real_text(request_.line_nm), kBlur_px / focal_px / sim::kRadiansPerDegree, kBlur_px,
      kMapModelError);
}

void Measuring::map() {
  if (request_.no_map) return;
  MeasureStage& stage = begin("Where electrons of which energy fall");
  const bool has_border = result_.border && result_.border->measured > 0;
  if (!result_.has_azimuth || !has_border || !result_.site) {
    stage.found = std::string("There is no map: it needs ") + (!result_.has_azimuth
                                                                   ? "the camera's directions in the sky."
                                                               : !has_border ? "a lower border."
                                                                             : "the place.");
    return;
  }
  if (!mask_for_map(stage)) {
    stage.found = "There is no map: " + stage.found;
    return;
  }
  write("scene.toml", scene_for_map());
  map_light(stage);
  if (!result_.map || result_.map->result.interrupted) {
    stage.found = "There is no map: " + (result_.map ? "it was interrupted." : stage.found);
    result_.map.reset();
    return;
  }
  stage.trust = result_.map->is_good() ? Trust::good : Trust::doubtful;
  for (const QuantityVerdict& v : result_.map->verdicts)
    stage.found += (stage.found.empty() ? "" : " ") + v.quantity + ": " + trust_name(v.trust) +
                   (v.value.empty() ? "" : ", " + v.value) + ".";
}

/// Returns the answer: what the border says for certain, then what the map says of it.
std::vector<std::string> Measuring::answer_sentences() const {
  const bool has_border = result_.border && result_.border->measured > 0;
  std::vector<std::string> answer;
  constexpr std::size_t kToldFirst = 2;
  for (std::size_t t = 0; has_border && t < result_.border->traces.size() && answer.size() < kToldFirst; ++t)
    if (result_.border->traces[t].measured > 0)
      answer.push_back(border_sentence(*result_.border, t, *result_.border_scene));
  if (!result_.has_azimuth && has_border)
    answer.push_back("Azimuths count from where the camera looked, and elevations are by the skyline" +
                     std::string(lens_file_.empty()
                                     ? "."
                                     : ": the stars would determine both, with the right time and place."));
  if (is_skyline_open_ && has_border)
    answer.emplace_back("Whether these are borders of light or of high ground is not decided: see below.");
  if (result_.map)
    for (const QuantityVerdict& v : result_.map->verdicts)
      if (v.quantity.find("along the curtains") != std::string::npos ||
          v.quantity.find("of the curtains") != std::string::npos)
        answer.push_back("The map has for " + v.quantity + ": " + v.value + " (" + trust_name(v.trust) +
                         ": " + v.reason + ").");
  if (answer.empty())
    for (const MeasureStage& stage : result_.stages)
      if (!stage.lacking.empty())
        answer.push_back(stage.title + ": " + stage.found + " What would help: " + stage.lacking);
  return answer;
}

void Measuring::conclude() {
  const bool has_border = result_.border && result_.border->measured > 0;
  const bool is_certain = result_.has_azimuth && !is_skyline_open_;
  result_.answer = answer_sentences();
  result_.trust = !has_border ? Trust::unconstrained : is_certain ? Trust::good : Trust::doubtful;
  write("report.html", measure_page(result_));
  write("measure.json", measure_json(result_));
  follower_.tell("");
  for (const std::string& sentence : result_.answer) follower_.tell(sentence);
  follower_.tell(in_run("report.html"));
}

}  // namespace

Measurement measure(const MeasureRequest& request, const MeasureFollower& follower) {
  return Measuring(request, follower).run();
}

}  // namespace vegard::fit
