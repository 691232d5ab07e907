// From a photograph to an answer in one command.
//
// Every stage is a command of vegard's own, called with words that are shown and kept: what a stage writes is
// what the command writes, and whoever wants something else at one stage goes on by hand from there. A stage
// that fails ends nothing: the report says what it lacked, and what can be had without it.
#include "apps/commands/commands.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/photographs.h"
#include "apps/options/refusals.h"
#include "apps/options/site_words.h"
#include "apps/options/standard_streams.h"
#include "apps/output/measure_page.h"
#include "apps/output/photo_description.h"
#include "fit/answer/trust.h"
#include "fit/photo/mask/mask_picture.h"
#include "fit/photo/photo.h"
#include "fit/photo/photo_facts.h"
#include "fit/photo/picture_field_of_view.h"
#include "fit/photo/pointing/skyline_doubt.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/number/constants.h"
#include "sim/base/utc_time.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/rows/value_words.h"
#include "sim/view/camera/camera.h"
#include "sim/view/camera/direction_map.h"
#include "sim/view/sky/star_place.h"

namespace vegard::apps {
namespace {

namespace fs = std::filesystem;
using fit::Trust;

constexpr double kLowestMapped_deg = 8.0;  // light at the horizon becomes a ring in the farthest cells
constexpr double kBesideTraces_deg = 12.0, kBelowTraces_deg = 6.0;
constexpr double kMappedShare = 0.25;  // of the brightest trace's light: fainter ones are the map's clutter
constexpr double kBlur_px = 1.2;       // what lenses and demosaicing leave of a point
constexpr double kModelError = 0.03;

struct MeasureRequest {
  std::string photo, at, out, time, camera, mask, decoding;
  std::vector<std::string> site;
  double line_nm = 557.7;
  int threads = 0, replicates = 8;
  bool no_map = false, overwrite = false;
};

/// What a command has said and how it ended.
struct Ended {
  std::string command, words;
  int exit_code = good;
};

/// A command's words, run here as if they had been typed.
Ended run_words(const std::vector<std::string>& words) {
  std::vector<const char*> arguments = {"vegard"};
  for (const std::string& word : words) arguments.push_back(word.c_str());
  Program program("vegard", "", {}, static_cast<int>(arguments.size()), arguments.data());
  add_mask_command(program);
  add_calibrate_command(program);
  add_horizon_command(program);
  add_border_command(program);
  add_map_command(program);
  Ended ended;
  ended.command = program.command_line();
  say("$ %s\n", ended.command.c_str());
  show_output();
  const CapturedOutput heard;
  try {
    ended.exit_code = program.run();
  } catch (const sim::Error& error) {
    if (error.kind() == sim::ErrorKind::unwritable_output || error.kind() == sim::ErrorKind::existing_output)
      throw;  // no stage will do better
    ended.exit_code = apps::exit_code_of(error.kind());
    say("%s\n", error.what());
  }
  ended.words = heard.text();
  return ended;
}

/// The first line of what was said that has `word`; empty if none has.
std::string line_with(const std::string& text, const std::string& word) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.find(word) != std::string::npos) return line;
  return {};
}

std::string last_line(const std::string& text) {
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) last = line;
  return last;
}

nlohmann::json json_of(const std::string& file) {
  std::ifstream stream(file);
  nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
  return json.is_object() ? json : nlohmann::json::object();
}

/// What is known of a picture before anything is looked for in it.
struct Known {
  std::string time;               ///< UTC, for --time; empty: not known
  std::optional<SitePlace> site;  ///< none: not known
  bool has_focal = false;         ///< the file gives the field of view
};

/// "78.148,16.043,520", as --site takes it.
std::string site_text(const SitePlace& site) {
  return fmt::format("{:.10g},{:.10g},{:.10g}", site.latitude_deg, site.longitude_deg, site.height_m);
}

/// What the command line says of time and place, refused here before any stage if nobody can read it.
Known known_of(const MeasureRequest& options) {
  Known known;
  if (!options.time.empty()) {
    const std::optional<double> seconds = sim::utc_seconds(options.time);
    if (!seconds)
      throw usage_error("--time", "'" + options.time + "' is no time",
                        "ISO 8601 such as 2014-02-21T19:30:40Z, or with a zone, 2014-02-21T20:30:40+01:00");
    known.time = sim::utc_text(*seconds);
  }
  if (!options.site.empty()) known.site = site_place(options.site);
  return known;
}

class Measuring {
 public:
  Measuring(const MeasureRequest& options, const std::string& command)
      : options_(options), known_(known_of(options)) {
    result_.command = command;
    result_.photo = file_name_of(options.photo);
  }

  int run() {
    fit::metadata_with_size(options_.photo);  // throws before anything is made if there is no picture
    take_given_camera();
    claim_folder();
    picture();
    sky();
    camera();
    doubt_skyline();
    border();
    map();
    return conclude();
  }

 private:
  std::string in_run(const std::string& name) const { return options_.out + "/" + name; }

  MeasureStage& begin(const std::string& title) {
    say("\n%s\n", title.c_str());
    result_.stages.emplace_back();
    result_.stages.back().title = title;
    return result_.stages.back();
  }

  void take(MeasureStage& stage, const Ended& ended) const {
    stage.command = ended.command;
    stage.words = ended.words;
    stage.exit_code = ended.exit_code;
  }

  void wrote(MeasureStage& stage, const std::string& name) const {
    if (fs::exists(in_run(name))) stage.files.push_back(name);
  }

  /// Words that every stage with a picture takes.
  std::vector<std::string> with_common(std::vector<std::string> words) const {
    if (!options_.decoding.empty()) words.insert(words.end(), {"--decoding", options_.decoding});
    words.push_back("--overwrite");
    return words;
  }

  void claim_folder() {
    std::error_code failed;
    const bool is_there = fs::exists(options_.out, failed);
    if (is_there && !fs::is_directory(options_.out, failed))
      sim::refuse_file(sim::ErrorKind::existing_output, options_.out, "is no folder");
    if (is_there && !fs::is_empty(options_.out, failed) && !options_.overwrite)
      sim::refuse_file(sim::ErrorKind::existing_output, options_.out,
                       "exists already (--overwrite replaces what vegard wrote there)");
    if (is_there && !fs::is_empty(options_.out, failed) && !fs::exists(in_run("measure.json")) &&
        !fs::exists(in_run("mask.png")))
      sim::refuse_file(sim::ErrorKind::existing_output, options_.out,
                       "holds something that is no measurement");
    fs::create_directories(options_.out, failed);
    if (failed)
      sim::refuse_file(sim::ErrorKind::unwritable_output, options_.out,
                       "cannot be made: " + failed.message());
  }

  void write(const std::string& name, const std::string& bytes) const {
    sim::WholeFile file(in_run(name), true);
    file.write(bytes);
    file.commit();
  }

  void picture();
  void sky();
  void camera();
  std::vector<fit::PixelPoint> skyline() const;
  void doubt_skyline();
  bool camera_by_stars();
  void lens_by_stars();
  bool camera_by_horizon(MeasureStage& stage);
  void border();
  void map();
  std::string region_mask() const;
  std::vector<std::string> changes_of_site() const;
  void take_given_camera();
  int conclude();

  const MeasureRequest& options_;
  Measurement result_;
  Known known_;
  std::string sky_mask_;          ///< file; empty if all of the picture may be sky
  std::string lens_file_;         ///< a camera whose lens alone is known; empty: it is not
  std::string camera_file_;       ///< empty: not known
  bool has_azimuth_ = false;      ///< the camera's directions are in the sky, not only above the horizon
  bool has_horizon_ = false;      ///< a skyline was found
  bool is_skyline_open_ = false;  ///< whether it is ground or the light's own border is not decided
  bool has_border_ = false, has_map_ = false;
  nlohmann::json border_ = nlohmann::json::object(), map_ = nlohmann::json::object();
  std::vector<std::string> border_words_;  ///< of the answer
};

void Measuring::picture() {
  MeasureStage& stage = begin("What the picture says of itself");
  const sim::PictureMetadata metadata = fit::metadata_with_size(options_.photo);
  const fit::PhotoFacts facts = fit::photo_facts(metadata);
  known_.has_focal = fit::picture_field_of_view(metadata).hfov_deg.has_value();
  std::vector<std::string> place;
  for (const fit::PhotoFact& fact : facts.facts) {
    say("%s\n", fit::fact_text(fact).c_str());
    // Latitude, longitude, altitude: in the order of a scene file.
    if (fact.path.rfind("site.l", 0) == 0 || (fact.path == "site.altitude_m" && place.size() == 2))
      place.push_back(fact.value);
    if (fact.path == "site.time_utc" && known_.time.empty())
      known_.time = fact.value.substr(1, fact.value.size() - 2);
  }
  for (const std::string& note : facts.notes) say("%s\n", note.c_str());
  if (!known_.site && place.size() >= 2) known_.site = site_place(place);
  stage.trust = known_.time.empty() || !known_.site ? Trust::doubtful : Trust::good;
  if (known_.time.empty() && !known_.site) stage.trust = Trust::unconstrained;
  stage.found =
      (known_.time.empty() ? "The time is not known" : "Taken at " + known_.time) +
      std::string(!known_.site ? "; the place is not known." : "; from " + site_text(*known_.site) + ".");
  if (known_.time.empty()) stage.lacking = "the time: --time 2014-02-21T19:30:40Z";
  if (!known_.site)
    stage.lacking += std::string(stage.lacking.empty() ? "" : "; ") + "the place: --site LATITUDE,LONGITUDE";
  say("%s\n", stage.found.c_str());
}

void Measuring::sky() {
  MeasureStage& stage = begin("Which part of it is sky");
  sky_mask_ = in_run("sky.png");
  std::vector<std::vector<std::string>> tries = {{"--circle", "auto"}, {"--horizon", "auto"}, {}};
  if (!options_.mask.empty()) tries = {{"--draw", options_.mask}};
  for (const std::vector<std::string>& finder : tries) {
    std::vector<std::string> words = {"mask", options_.photo, "-o", sky_mask_};
    words.insert(words.end(), finder.begin(), finder.end());
    const bool is_horizon = !finder.empty() && finder.front() == "--horizon";
    if (is_horizon) words.insert(words.end(), {"--horizon-csv", in_run("horizon.csv")});
    if (options_.mask.empty()) words.push_back("--text");
    const Ended ended = run_words(with_common(words));
    take(stage, ended);
    if (ended.exit_code != good) continue;
    has_horizon_ = is_horizon;
    stage.trust = finder.empty() ? Trust::doubtful : Trust::good;
    stage.found = finder.empty()
                      ? "Neither a fisheye's circle nor a skyline was found: all of it counts as sky."
                  : finder.front() == "--circle" ? "A fisheye's circle: " + line_with(ended.words, "circle: ")
                  : is_horizon                   ? "Above a skyline: " + line_with(ended.words, "horizon: ")
                                                 : "What the given mask leaves.";
    if (finder.empty()) stage.lacking = "a mask that leaves out the ground: --mask MASK.png (vegard mask)";
    break;
  }
  wrote(stage, "sky.png");
  wrote(stage, "horizon.csv");
  if (stage.exit_code != good) {
    sky_mask_.clear();
    stage.found = last_line(stage.words);
  }
}

/// Stars first: they alone determine the azimuth.
bool Measuring::camera_by_stars() {
  MeasureStage& stage = begin("Where the camera points: stars");
  std::vector<std::string> words = {"calibrate",           "--image",     options_.photo,      "-o",
                                    in_run("camera.toml"), "--stars-out", in_run("stars.csv"), "--overlay",
                                    in_run("stars.png")};
  if (!sky_mask_.empty()) words.insert(words.end(), {"--mask", sky_mask_});
  if (!known_.time.empty()) words.insert(words.end(), {"--time", known_.time});
  if (known_.site) words.push_back("--site=" + site_text(*known_.site));
  const Ended ended = run_words(with_common(words));
  take(stage, ended);
  for (const char* file : {"camera.toml", "stars.csv", "stars.png"}) wrote(stage, file);
  if (ended.exit_code == good && fs::exists(in_run("camera.toml"))) {
    camera_file_ = in_run("camera.toml");
    has_azimuth_ = true;
    stage.trust = Trust::good;
    stage.found = "The stars were recognised. " + line_with(ended.words, "rms: ") + ". " +
                  line_with(ended.words, "the axis is known");
    result_.pictures.push_back("stars.png");
    return true;
  }
  if (fs::exists(in_run("stars.csv"))) {
    stage.trust = Trust::doubtful;
    stage.found = "The stars were recognised, but not in azimuth and elevation: " +
                  line_with(ended.words, "the picture's middle") + "; " +
                  line_with(ended.words, "field of view") + ".";
    stage.lacking = known_.time.empty() ? "the time: --time"
                    : !known_.site
                        ? "the place: --site"
                        : "the right time and place: " + line_with(ended.words, "below the horizon");
    if (has_horizon_) lens_by_stars();
    return false;
  }
  stage.trust = Trust::unconstrained;
  stage.found = "No stars were recognised. " + line_with(ended.words, "points");
  stage.lacking =
      "a picture with more stars in it, or sharper ones; or a camera file of the same camera: --camera";
  return false;
}

/// A point a column; none if no skyline was found.
std::vector<fit::PixelPoint> Measuring::skyline() const {
  std::vector<fit::PixelPoint> points;
  if (!has_horizon_) return points;
  std::ifstream file(in_run("horizon.csv"));
  for (std::string line; std::getline(file, line);) {
    double x = 0.0, y = 0.0;
    if (std::sscanf(line.c_str(), "%lf,%lf", &x, &y) == 2) points.push_back({x, y});
  }
  return points;
}

/// A light's sharp lower border over a dark sky may have passed for a skyline: what is below it is sky then.
void Measuring::doubt_skyline() {
  if (!has_azimuth_ || !has_horizon_) return;
  const sim::Scene scene = sim::read_scene(camera_file_);
  const fit::Photo photo =
      fit::read_photo(options_.photo, decoding_of(options_.decoding, scene.fit.decoding, &scene));
  fit::SkyOfPicture sky;
  if (!known_.time.empty()) sky.julian_date = sim::julian_date(known_.time);
  if (known_.site)
    sky.observer =
        sim::Observer{known_.site->latitude_deg, known_.site->longitude_deg, known_.site->height_m, true};
  const std::optional<fit::SkylineDoubt> doubt = fit::skyline_doubt(skyline(), scene.camera, photo, sky);
  if (!doubt) return;
  MeasureStage& stage = begin("Whether the skyline is the ground's");
  const Ended ended = run_words(with_common({"mask", options_.photo, "-o", sky_mask_, "--text"}));
  take(stage, ended);
  wrote(stage, "sky.png");
  stage.found = fmt::format("The skyline is {:.0f} to {:.0f}° above the horizon over {:.0f}° of azimuth, ",
                            doubt->from_deg, doubt->to_deg, doubt->azimuths_deg);
  if (doubt->has_stars()) {
    stage.trust = Trust::good;
    stage.found += fmt::format(
        "and {} stars shine below it ({:.1f} would by chance): it is no ground, but perhaps the light's own "
        "border, and nothing is masked by it.",
        doubt->stars_below, doubt->by_chance);
    return;
  }
  is_skyline_open_ = true;
  stage.trust = Trust::doubtful;
  stage.found +=
      "and is as smooth as a border of light, which it may be: nothing is masked by it. If it is a ridge or "
      "a roof, a border measured there is that of the ground.";
  stage.lacking = "a mask of what is ground: --mask MASK.png (vegard mask)";
}

/// The lens of recognised stars whose time or place is not known: taken as if they stood about the zenith.
void Measuring::lens_by_stars() {
  double up[3] = {0.0, 0.0, 0.0};
  std::ifstream table(in_run("stars.csv"));
  for (std::string line; std::getline(table, line);) {
    sim::Direction at;  // right ascension and declination
    const std::string numbers = line.substr(std::min(line.find(','), line.size()));
    if (std::sscanf(numbers.c_str(), ",%lf,%lf", &at.azimuth_deg, &at.elevation_deg) != 2) continue;
    double one[3];
    sim::enu_of_direction(at, one);
    for (int i = 0; i < 3; ++i) up[i] += one[i];
  }
  const double length = std::sqrt(up[0] * up[0] + up[1] * up[1] + up[2] * up[2]);
  if (!(length > 0.0)) return;
  for (double& v : up) v /= length;
  const sim::Direction middle = sim::direction_of_enu(up);
  const std::string time = "2000-01-01T12:00:00Z";
  const double longitude_deg =
      std::remainder(middle.azimuth_deg - sim::mean_sidereal_time_deg(*sim::julian_date(time)), 360.0);
  MeasureStage& stage = begin("Its lens: the same stars, as if they stood about the zenith");
  const Ended ended = run_words({"calibrate", in_run("stars.csv"), "--image", options_.photo, "--no-metadata",
                                 "--no-refraction", "--time", time,
                                 fmt::format("--site={:.4f},{:.4f}", middle.elevation_deg, longitude_deg),
                                 "-o", in_run("lens.toml"), "--overwrite"});
  take(stage, ended);
  wrote(stage, "lens.toml");
  if (ended.exit_code != good) {
    stage.found = last_line(ended.words);
    return;
  }
  lens_file_ = in_run("lens.toml");
  stage.trust = Trust::good;
  stage.found = line_with(ended.words, "lens: ") + "; " + line_with(ended.words, "rms: ") +
                ". Where that file points to means nothing.";
}

/// The lowest points of a skyline in ten parts of the picture's width: hills stand above the horizon, nothing
/// below it.
bool Measuring::camera_by_horizon(MeasureStage& stage) {
  const std::vector<fit::PixelPoint> skyline = this->skyline();
  constexpr std::size_t kParts = 10;
  if (skyline.size() < 10 * kParts) return false;
  std::vector<std::string> words = {"horizon", options_.photo, "-o", in_run("camera.toml"), "--points"};
  for (std::size_t part = 0; part < kParts; ++part) {
    const auto begin = skyline.begin() + static_cast<std::ptrdiff_t>(part * skyline.size() / kParts);
    const auto end = skyline.begin() + static_cast<std::ptrdiff_t>((part + 1) * skyline.size() / kParts);
    const auto lowest =
        std::max_element(begin, end, [](const auto& a, const auto& b) { return a.y_px < b.y_px; });
    words.push_back(fmt::format("{:.1f},{:.1f}", lowest->x_px, lowest->y_px));
  }
  // Stars measure the lens, a picture's file only says what it is called.
  if (!lens_file_.empty()) words.insert(words.end(), {"--lens", lens_file_});
  words.push_back("--overwrite");
  const Ended ended = run_words(words);
  take(stage, ended);
  wrote(stage, "camera.toml");
  return ended.exit_code == good && fs::exists(in_run("camera.toml"));
}

void Measuring::camera() {
  if (!options_.camera.empty()) {
    MeasureStage& stage = begin("Where the camera points");
    camera_file_ = options_.camera;
    has_azimuth_ = true;
    stage.trust = Trust::good;
    stage.found = "As " + file_name_of(options_.camera) + " says.";
    return;
  }
  if (camera_by_stars()) return;
  MeasureStage& stage = begin("Where the camera points: the horizon");
  if (!has_horizon_ || (!known_.has_focal && lens_file_.empty())) {
    stage.trust = Trust::unconstrained;
    stage.found = !has_horizon_ ? "There is no skyline that could serve as the horizon."
                                : "A skyline is there, but the picture's field of view is not known.";
    stage.lacking =
        "points on the horizon and the field of view: vegard horizon PHOTO --points X,Y X,Y --hfov DEGREES "
        "-o camera.toml, then vegard measure PHOTO --camera camera.toml";
    return;
  }
  if (!camera_by_horizon(stage)) {
    stage.trust = Trust::unconstrained;
    stage.found = "The skyline is no horizon: " + last_line(stage.words);
    return;
  }
  camera_file_ = in_run("camera.toml");
  stage.trust = Trust::doubtful;
  stage.found = "From the skyline and the field of view" +
                std::string(lens_file_.empty() ? ": " : " found from the stars: ") +
                line_with(stage.words, "elevation") +
                ". The skyline may be a degree or more above the horizon, and the azimuth is not known (0 "
                "is assumed).";
  stage.lacking = "stars in the picture, with time and place";
}

void Measuring::border() {
  MeasureStage& stage = begin("The lower border of the light");
  if (camera_file_.empty()) {
    stage.found = "Without the camera's pointing there is no elevation, and so no distance.";
    return;
  }
  std::vector<std::string> words = {"border",       camera_file_, "--photo",
                                    options_.photo, "--out",      in_run("border")};
  const std::vector<std::string> site = changes_of_site();
  words.insert(words.end(), site.begin(), site.end());
  if (!sky_mask_.empty()) words.insert(words.end(), {"--mask", sky_mask_});
  const Ended ended = run_words(with_common(words));
  take(stage, ended);
  border_ = json_of(in_run("border/border.json"));
  for (const char* file : {"border/report.html", "border/border.csv"}) wrote(stage, file);
  has_border_ = ended.exit_code == good;
  if (!has_border_) {
    stage.found = last_line(ended.words);
    return;
  }
  stage.trust = has_azimuth_ && !is_skyline_open_ ? Trust::good : Trust::doubtful;
  constexpr std::size_t kToldFirst = 2;
  std::istringstream lines(ended.words);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("Trace ", 0) != 0) continue;
    stage.found += (stage.found.empty() ? "" : " ") + line;
    if (border_words_.size() < kToldFirst) border_words_.push_back(line);
  }
  if (!has_azimuth_ && !border_words_.empty())
    border_words_.push_back(
        "Azimuths count from where the camera looked, and elevations are by the skyline" +
        std::string(lens_file_.empty() ? "."
                                       : ": the stars would determine both, with the right time and place."));
  if (is_skyline_open_ && !border_words_.empty())
    border_words_.push_back(
        "Whether these are borders of light or of high ground is not decided: see below.");
  if (fs::exists(in_run("border/border.svg")))
    result_.pictures.insert(result_.pictures.begin(), "border/border.svg");
}

/// The place, for commands that take it as changes of a scene.
std::vector<std::string> Measuring::changes_of_site() const {
  if (!known_.site) return {};
  return {"--set", "site.latitude_deg=" + sim::real_text(known_.site->latitude_deg),
          "--set", "site.longitude_deg=" + sim::real_text(known_.site->longitude_deg),
          "--set", "site.altitude_m=" + sim::real_text(known_.site->height_m)};
}

/// --camera, which may know the place as well; refused before any stage if it is none.
void Measuring::take_given_camera() {
  if (options_.camera.empty()) return;
  const sim::Scene scene = sim::read_scene(options_.camera);
  if (!known_.site && scene.lines.count("site.latitude_deg") + scene.lines.count("site.longitude_deg") == 2)
    known_.site = SitePlace{scene.site.latitude_deg, scene.site.longitude_deg, scene.site.altitude_m};
}

/// Pixels whose light the map is to explain: near the azimuths of the traces, from below their border up.
std::string Measuring::region_mask() const {
  const sim::Scene scene = sim::read_scene(camera_file_);
  const sim::DirectionMap directions = sim::direction_map(scene.camera);
  struct TracedRange {
    double middle_deg, half_width_deg, lowest_deg;
  };
  double brightest = 0.0;
  for (const nlohmann::json& trace : border_.value("traces", nlohmann::json::array()))
    if (trace.at("measured").get<int>() > 0)
      brightest = std::max(brightest, trace.at("brightness").get<double>());
  std::vector<TracedRange> ranges;
  for (const nlohmann::json& trace : border_.value("traces", nlohmann::json::array())) {
    if (trace.at("measured").get<int>() == 0 || !trace.at("from_azimuth_deg").is_number() ||
        trace.at("brightness").get<double>() < kMappedShare * brightest)
      continue;
    const double from = trace.at("from_azimuth_deg").get<double>();
    double range = std::fmod(trace.at("to_azimuth_deg").get<double>() - from, 360.0);
    if (range < 0.0) range += 360.0;
    ranges.push_back({from + 0.5 * range, 0.5 * range, trace.at("lowest_elevation_deg").get<double>()});
  }
  fit::PixelSet out(directions.width, directions.height);
  for (std::size_t i = 0; i < out.in.size(); ++i) {
    const double azimuth = directions.azimuth_deg[i], elevation = directions.elevation_deg[i];
    bool is_used = false;
    for (const TracedRange& range : ranges)
      is_used = is_used || (std::abs(std::remainder(azimuth - range.middle_deg, 360.0)) <=
                                range.half_width_deg + kBesideTraces_deg &&
                            elevation >= std::max(kLowestMapped_deg, range.lowest_deg - kBelowTraces_deg));
    out.in[i] = is_used ? 0 : 1;
  }
  return fit::mask_png(out);
}

void Measuring::map() {
  if (options_.no_map) return;
  MeasureStage& stage = begin("Where electrons of which energy fall");
  if (!has_azimuth_ || !has_border_ || !known_.site) {
    stage.found =
        std::string("There is no map: it needs ") + (!has_azimuth_  ? "the camera's directions in the sky."
                                                     : !has_border_ ? "a lower border."
                                                                    : "the place.");
    return;
  }
  const sim::Scene camera = sim::read_scene(camera_file_);
  const double focal_px = sim::camera_view(camera.camera).lens.focal_px;
  write("region.png", region_mask());
  std::vector<std::string> words = {"mask",   options_.photo,       "-o",     in_run("mask.png"),
                                    "--draw", in_run("region.png"), "--stars"};
  if (!sky_mask_.empty()) words.insert(words.end(), {"--draw", sky_mask_});
  const Ended masked = run_words(with_common(words));
  if (masked.exit_code != good) {
    take(stage, masked);
    stage.found = "There is no map: " + last_line(masked.words);
    return;
  }
  write(
      "scene.toml",
      fmt::format("# For vegard map and vegard fit, with --camera {}, by vegard measure of {}\n"
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
                  file_name_of(camera_file_), comment_words(result_.photo), sim::real_text(options_.line_nm),
                  kBlur_px / focal_px / sim::kRadiansPerDegree, kBlur_px, kModelError));
  words = {"map",          in_run("scene.toml"),
           "--camera",     camera_file_,
           "--photo",      options_.photo,
           "--mask",       in_run("mask.png"),
           "--out",        in_run("map"),
           "--replicates", std::to_string(options_.replicates),
           "--threads",    std::to_string(options_.threads)};
  const std::vector<std::string> site = changes_of_site();
  words.insert(words.end(), site.begin(), site.end());
  const Ended ended = run_words(with_common(words));
  take(stage, ended);
  for (const char* file :
       {"scene.toml", "mask.png", "map/report.html", "map/precipitation.fits", "map/curtains.csv"})
    wrote(stage, file);
  if (ended.exit_code != good && ended.exit_code != doubted) {
    stage.found = "There is no map: " + last_line(ended.words);
    return;
  }
  map_ = json_of(in_run("map/map.json"));
  has_map_ = true;
  stage.trust = ended.exit_code == good ? Trust::good : Trust::doubtful;
  for (const nlohmann::json& v : map_.value("verdicts", nlohmann::json::array()))
    stage.found += (stage.found.empty() ? "" : " ") + v.value("quantity", "") + ": " +
                   v.value("verdict", "") +
                   (v.value("value", "").empty() ? "" : ", " + v.value("value", "")) + ".";
}

/// The answer: what the border says for certain, then what the map says of it.
int Measuring::conclude() {
  result_.answer.insert(result_.answer.end(), border_words_.begin(), border_words_.end());
  for (const nlohmann::json& v : map_.value("verdicts", nlohmann::json::array())) {
    const std::string quantity = v.value("quantity", "");
    if (quantity.find("along the curtains") == std::string::npos &&
        quantity.find("of the curtains") == std::string::npos)
      continue;
    result_.answer.push_back("The map has for " + quantity + ": " + v.value("value", "nothing") + " (" +
                             v.value("verdict", "") + ": " + v.value("reason", "") + ").");
  }
  result_.trust = !has_border_                        ? Trust::unconstrained
                  : has_azimuth_ && !is_skyline_open_ ? Trust::good
                                                      : Trust::doubtful;
  if (result_.answer.empty())
    for (const MeasureStage& stage : result_.stages)
      if (!stage.lacking.empty())
        result_.answer.push_back(stage.title + ": " + stage.found + " What would help: " + stage.lacking);
  write("report.html", measure_page(result_));
  write("measure.json", measure_json(result_));
  answer_with(measure_json(result_));
  json_answer()["report"] = in_run("report.html");
  say("\n");
  for (const std::string& sentence : result_.answer) say("%s\n", sentence.c_str());
  say("%s\n", in_run("report.html").c_str());
  return result_.trust == Trust::good ? good : doubted;
}

int run_measure(MeasureRequest options, const std::string& command) {
  options.photo = picture_at(options.photo, options.at);
  if (options.out.empty()) options.out = fit::stem_of_picture(options.photo) + "_measured";
  return Measuring(options, command).run();
}

}  // namespace

void add_measure_command(Program& program) {
  const auto options = std::make_shared<MeasureRequest>();
  const Command command = program.add(
      "measure", "Find camera, distance and, where possible, energy of the aurora in one photograph");
  command.option("PHOTO", options->photo, "A photograph of any format that is read").required();
  add_at_option(command, options->at);
  command
      .option("--time", options->time,
              "Time of the picture, ISO 8601 in UTC or with a zone (default: from its metadata)")
      .type_name("TIME");
  add_site_option(command, options->site);
  command.option("--out", options->out, "The folder to write (default: PHOTO's name with _measured)")
      .type_name("RUN");
  command.option("--camera", options->camera, "A camera file, if the pointing is known")
      .type_name("CAMERA.toml");
  command.option("--mask", options->mask, "A mask of the sky, if there is one: white = use")
      .type_name("IMAGE");
  command
      .option("--line", options->line_nm, "Wavelength of the emission line, of a picture through one filter")
      .type_name("NM")
      .range(100.0, 2000.0)
      .shows_default();
  add_decoding_option(command, options->decoding, SceneOfDecoding::none);
  command.option("--replicates", options->replicates, "Perturbed solutions for the map's error bars")
      .range(0, 1000)
      .shows_default();
  command.option("--threads", options->threads, "Threads to use (0: all cores); the result is the same")
      .range(0, 1024);
  command.flag("--no-map", options->no_map, "Leave out the map of precipitation");
  command.flag("--overwrite", options->overwrite, "Replace a measurement that exists");
  command.runs([options, words = program.command_line()] { return run_measure(*options, words); });
}

}  // namespace vegard::apps
