#include "fit/measurement/camera_calibration.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "fit/measurement/calibration_inputs.h"
#include "fit/photo/mask/circle.h"
#include "fit/photo/photo.h"
#include "fit/photo/photo_metadata.h"
#include "fit/photo/pointing/blind/deeper_stars.h"
#include "fit/photo/pointing/blind/map_flip.h"
#include "fit/photo/pointing/blind/star_doubts.h"
#include "fit/photo/pointing/blind/stars_by_hand.h"
#include "fit/photo/pointing/calibration_tables.h"
#include "fit/photo/pointing/catalogue_sky.h"
#include "fit/photo/pointing/exchange/star_files.h"
#include "fit/photo/pointing/held_out.h"
#include "fit/photo/pointing/map_calibration.h"
#include "fit/photo/pointing/star_check.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/constants.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/sky/bright_stars.h"
#include "sim/view/sky/planets.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {
namespace {

constexpr const char* kFittingWork = "choosing the lens";
constexpr const char* kDeeperWork = "choosing the lens with fainter stars";

void check_scene(const Calibration& calibration) {
  sim::Scene scene;
  scene.camera = scene_camera_of(calibration);
  sim::validate(scene);
}

/// Why no stars were recognised from an earlier camera, and what would help.
std::string chance_line(const Identification& found, const std::string& camera) {
  const ChanceAgreement& agreement = found.agreement;
  return "the stars were not recognised from " + camera + ": " +
         (agreement.matches.empty()
              ? "too few have a point of light, or the bright ones have none"
              : words_of(agreement) + "; " +
                    (agreement.log10_false > 0.0
                         ? "that many are to be expected of so long a search"
                         : "chance does as well once in 10^" +
                               sim::short_number(std::floor(-agreement.log10_false), 3) +
                               " searches, and 10^8 are asked for")) +
         ". No camera was written. What would help: a picture with stars; a narrower search (--twist, "
         "--shift), "
         "if the camera hardly moved; a --mask that leaves only sky; no --camera, if it is another one's or "
         "was "
         "moved";
}

/// What a field without enough stars of the table needs.
std::string narrow_line(std::size_t in_view) {
  return fmt::format(
      ". The field is too narrow for the star table: it should show {} of its stars to magnitude {:.0f}, and "
      "ten or so are needed. What would help: a shorter focal length, or Astrometry.net's solution, whose "
      "tables are deeper (--wcs FIELD.wcs)",
      in_view, sim::kFaintestDeep);
}

constexpr double kFirstRange = 1.5;  // magnitudes: stars are matched first to so much less than the faintest
constexpr std::size_t kFewInView = 10;  // six are the least that chance does not explain after a short search

/// What was found from one camera to start from.
struct FoundFromStart {
  SkyCamera start;
  std::vector<StarSighting> catalogue;  ///< of the start's field, to the faintest that is known
  double faintest = 0.0;                ///< the magnitude to which its stars were looked for
  Identification found;
};

/// The decisions of one calibration, in their order.
class CameraCalibrator {
 public:
  CameraCalibrator(const CalibrationRequest& request, const Tell& tell) : request_(request), tell_(tell) {}

  CameraCalibration run() {
    check_together(request_);
    read_inputs();
    read_stars();
    if (request_.maps && found_.photo && !request_.flip_given) settle_flip();
    if (start_ && !request_.centre_px.empty()) {
      start_->numbers[centre_x_number] = request_.centre_px[0];
      start_->numbers[centre_y_number] = request_.centre_px[1];
    }
    settings_ = lens_settings(request_, start_);
    if (request_.blind()) {
      recognise_blindly();
      if (!is_placed()) return std::move(found_);
    } else if (!maps_ && !by_table_ && !(marked_.empty() ? recognise_by_camera() : recognise_by_hand())) {
      return std::move(found_);
    }
    fit_camera();
    return std::move(found_);
  }

 private:
  void read_inputs();
  void read_stars();
  void settle_flip();
  bool recognise_by_camera();
  bool recognise_by_hand();
  std::vector<SkyCamera> starts_by_hand() const;
  FoundFromStart identified(const SkyCamera& start, const std::vector<FoundStar>& points,
                            IdentificationSettings settings);
  bool take(const FoundFromStart& by, std::size_t points, const std::string& from);
  void tell_marked(const FoundFromStart& by) const;
  void recognise_blindly();
  bool is_placed();
  bool depends_on_time() const;
  bool is_shown(const SeenPlanet& planet, const std::optional<Circle>& circle);
  void tell_times() const;
  void tell_planets(const std::optional<Circle>& circle);
  Calibration fitted(const std::vector<StarSighting>& stars) const;
  void refuse_hours() const;
  void fit_camera();
  void deepen(const std::string& from);
  StarEvidence evidence();

  StarFinderSettings finder() const {
    StarFinderSettings settings;
    settings.min_signal = request_.min_signal;
    return settings;
  }
  /// Per pixel of the picture, whether the mask leaves it; empty without one.
  const std::vector<char>& usable() {
    if (usable_.empty() && !request_.mask.empty()) usable_ = pixels_left_by(request_.mask, *found_.photo);
    return usable_;
  }
  std::vector<FoundStar> points_of_picture() { return find_stars(found_.photo->linear, finder(), usable()); }

  const CalibrationRequest& request_;
  const Tell& tell_;
  CameraCalibration found_;
  std::optional<sim::Scene> camera_file_;  ///< as it was read
  PictureSays says_;
  std::optional<KnownMaps> maps_;
  std::optional<StarPoints> listed_;
  bool by_table_ = false;
  std::vector<StarSighting> stars_;
  std::vector<StarSighting> marked_;  ///< by hand
  std::vector<char> usable_;
  std::optional<SkyCamera> start_;
  LensSettings settings_;
};

void CameraCalibrator::read_inputs() {
  if (!request_.camera.empty()) camera_file_ = sim::read_scene(request_.camera);
  sim::PictureMetadata metadata;
  if (!request_.image.empty()) {
    found_.photo =
        read_photo(request_.image, decoding_of_word(request_.decoding.empty() ? "auto" : request_.decoding));
    metadata = photo_metadata(request_.image);
    metadata.width_px = found_.photo->linear.width;
    metadata.height_px = found_.photo->linear.height;
  }
  says_ = with_metadata(request_, camera_file_, metadata);
  found_.sky = says_.sky;
  maps_ = request_.maps;
  if (!found_.sky.observer && maps_ && maps_->place)
    found_.sky.observer = {maps_->place->latitude_deg, maps_->place->longitude_deg, maps_->place->altitude_m};
  if (request_.by_directions() && !maps_) maps_ = told_directions(request_, found_.photo, found_.sky);
  for (const PhotoFact& fact : says_.taken) tell_("from the photograph: " + fact_text(fact));
  for (const std::string& note : says_.notes) tell_("note: " + note);
}

void CameraCalibrator::read_stars() {
  listed_ = listed_points(request_);
  by_table_ = !request_.stars.empty() && !listed_;
  if (by_table_) stars_ = table_of(request_, found_.sky);
  const bool has_list_size = listed_ && listed_->frame.known && !found_.photo && request_.size_px.empty();
  found_.frame = maps_           ? frame_of_maps(request_, found_.photo, maps_->map)
                 : has_list_size ? listed_->frame
                                 : frame_of_stars(request_, found_.photo, stars_);
  if (listed_ && !found_.frame.known)
    throw usage_error("--size", "the list does not say how large its picture is", "--size or --image");
  if (request_.finds_points) found_.points = points_of_picture();
  if (!request_.corr_out.empty()) require_sky(found_.sky, request_.corr_out);
  if (by_table_ && found_.frame.known) check_star_places(stars_, found_.frame, request_.stars);
  if (!request_.by_hand.empty()) marked_ = stars_by_hand(request_.by_hand, found_.sky, "--star");
  if (says_.camera) start_ = sky_camera_of(says_.camera->camera, found_.frame);
  if (says_.instant && depends_on_time()) {
    found_.origin.instant = says_.instant;
    tell_(words_of(*says_.instant));
  }
}

/// Whether directions are computed from the time.
bool CameraCalibrator::depends_on_time() const {
  if (maps_) return !request_.wcs.empty();
  return !by_table_ || std::any_of(stars_.begin(), stars_.end(),
                                   [](const StarSighting& star) { return !star.is_direction_given; });
}

/// Turns the maps the way round by which the picture's stars stand in them, if it shows some.
void CameraCalibrator::settle_flip() {
  constexpr double kFaintest = 4.0;
  const SkyOfPicture& sky = found_.sky;
  if (!sky.julian_date || !sky.observer) return;
  const std::optional<MapFlip> found =
      flip_by_stars(maps_->map, points_of_picture(),
                    catalogue_sky(*sky.observer, *sky.julian_date, kFaintest,
                                  sim::horizon_elevation_deg(*sky.observer) + request_.min_elevation_deg));
  if (!found) {
    tell_("the picture's stars do not tell which way round the maps belong to it: as stored");
    return;
  }
  flip_map(found->flip, maps_->map);
  tell_(fmt::format(
      "which way round the maps belong to the picture, by its stars: {} ({} stars have a point of "
      "light there, at most {} by another way)",
      words_of(found->flip), found->stars, found->others));
}

/// Names points of light by the catalogue, from a camera to start from.
FoundFromStart CameraCalibrator::identified(const SkyCamera& start, const std::vector<FoundStar>& points,
                                            IdentificationSettings settings) {
  const SkyOfPicture& sky = found_.sky;
  if (!sky.julian_date) throw usage_error("--time", "stars are found by when and where", "--time and --site");
  if (!sky.observer) throw usage_error("--site", "stars are found by when and where", "--time and --site");
  FoundFromStart by;
  by.start = start;
  by.catalogue = field_sky(start, found_.frame, *sky.observer, *sky.julian_date,
                           sim::horizon_elevation_deg(*sky.observer) + request_.min_elevation_deg);
  by.faintest = request_.faintest.value_or(
      faintest_for_field(start, found_.frame, by.catalogue, request_.first_faintest()));
  settings.faintest = by.faintest;
  std::vector<StarSighting> bright = by.catalogue;
  bright.erase(std::find_if(bright.begin(), bright.end(),
                            [&](const StarSighting& one) { return one.magnitude > settings.faintest; }),
               bright.end());
  settings.first_magnitude =
      std::max(std::min(settings.first_magnitude, settings.faintest), settings.faintest - kFirstRange);
  settings.free = settings_.only.empty() ? free_numbers({start.model, 0, false, false}, settings_.centre_free)
                                         : settings_.only;
  if (found_.photo) settings.pixels = SkyPixels(usable());
  by.found = identify(start, found_.frame, bright, points, settings);
  return by;
}

/// Takes the stars that were found; false if chance explains them as well.
bool CameraCalibrator::take(const FoundFromStart& by, std::size_t points, const std::string& from) {
  const Identification& found = by.found;
  tell_(fmt::format(
      "{} points of light; {} of the {} stars to magnitude {:.1f} that should be seen have one within {:.1f} "
      "px ({:.1f} would by chance)",
      points, found.stars.size(), found.in_frame, by.faintest, found.last_radius_px, found.by_chance));
  if (!is_trustworthy(found)) {
    found_.has_answer = false;
    found_.chance = chance_line(found, from);
    const std::size_t in_view =
        expected_stars(by.start, found_.frame, by.catalogue,
                       found_.photo ? SkyPixels(usable()) : IdentificationSettings().pixels)
            .size();
    if (in_view < kFewInView) found_.chance += narrow_line(in_view);
    tell_(found_.chance);
    return false;
  }
  settings_.start = found.camera;
  stars_ = found.stars;
  return true;
}

/// Stars found among points of light and named by the catalogue; false if chance explains them as well.
bool CameraCalibrator::recognise_by_camera() {
  const std::vector<FoundStar> points = listed_ ? listed_->points : points_of_picture();
  IdentificationSettings settings;
  settings.twist_deg = request_.twist_deg;
  settings.shift_px = request_.shift_px;
  settings.scale_share = 0.01 * request_.scale_percent;
  settings.first_radius_px = request_.radius_px;
  return take(identified(*start_, points, settings), points.size(), request_.camera);
}

/// Where no lens has all named stars at their marks, one may be mistaken: then by all but one of them.
std::vector<SkyCamera> CameraCalibrator::starts_by_hand() const {
  std::vector<SkyCamera> starts = cameras_by_hand(marked_, found_.frame, start_);
  if (!starts.empty() || marked_.size() < 3) return starts;
  for (std::size_t left = 0; left < marked_.size(); ++left) {
    std::vector<StarSighting> others = marked_;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left));
    for (const SkyCamera& camera : cameras_by_hand(others, found_.frame, start_)) starts.push_back(camera);
  }
  return starts;
}

/// The same from a few stars that a person has named, by the lens that most agree with.
bool CameraCalibrator::recognise_by_hand() {
  constexpr double kReach = 0.01;  // of the picture's larger side: what a wrong lens may be off by
  constexpr double kScale = 0.03, kTwist_deg = 3.0;
  const std::vector<SkyCamera> starts = starts_by_hand();
  if (starts.empty()) {
    found_.has_answer = false;
    found_.chance =
        "no lens has these stars where they were marked: is each named as it is, and are time and site those "
        "of the picture? No camera was written";
    tell_(found_.chance);
    return false;
  }
  const std::vector<FoundStar> points = points_of_picture();
  IdentificationSettings settings;
  const double reach_px = kReach * std::max(found_.frame.width_px, found_.frame.height_px);
  settings.twist_deg = std::min(request_.twist_deg, kTwist_deg);
  settings.shift_px = std::max(request_.shift_px, reach_px);
  settings.scale_share = std::max(0.01 * request_.scale_percent, start_ ? 0.0 : kScale);
  settings.first_radius_px = std::max(request_.radius_px, reach_px);
  std::optional<FoundFromStart> best;
  for (const SkyCamera& start : starts) {
    FoundFromStart by = identified(start, points, settings);
    if (!best || by.found.agreement.log10_false < best->found.agreement.log10_false) best = std::move(by);
  }
  const bool is_found = take(*best, points.size(), "the stars that were named");
  if (is_found) tell_marked(*best);
  return is_found;
}

/// What is not where it was marked, and what is there.
void CameraCalibrator::tell_marked(const FoundFromStart& by) const {
  const SkyCamera& camera = by.found.camera;
  constexpr double kOff = 0.01;  // of the picture's larger side
  const double reach_px = kOff * std::max(found_.frame.width_px, found_.frame.height_px);
  for (const StarSighting& star : marked_) {
    double x = 0.0, y = 0.0;
    const bool has_image = place_of_star(camera, star.enu, x, y);
    if (has_image && std::hypot(x - star.x_px, y - star.y_px) < reach_px) continue;
    const StarSighting* nearest = nullptr;
    double least = reach_px;
    for (const StarSighting& one : by.catalogue) {
      double u = 0.0, v = 0.0;
      if (one.magnitude > request_.first_faintest() || !place_of_star(camera, one.enu, u, v)) continue;
      const double off = std::hypot(u - star.x_px, v - star.y_px);
      if (off >= least) continue;
      least = off;
      nearest = &one;
    }
    tell_(fmt::format(
        "note: {} was marked at ({:.0f}, {:.0f}) and is {}; {}", star.name, star.x_px, star.y_px,
        has_image ? fmt::format("at ({:.0f}, {:.0f})", x, y) : "not in the picture",
        nearest == nullptr ? "no bright star is at the mark" : "the star at the mark is " + nearest->name));
  }
}

void CameraCalibrator::recognise_blindly() {
  BlindStars& blind = found_.blind.emplace();
  RecognitionSettings known;
  if (found_.sky.julian_date && found_.sky.observer)
    known.zenith = zenith_of(*found_.sky.observer, *found_.sky.julian_date);
  const std::string work = "recognising stars";
  known.progress = tell_.progress_of(work);
  blind.picture = recognise_picture(found_.photo->linear, finder(), usable(), known);
  tell_.progress(work, 1.0);
  tell_(words_of(blind.picture.recognition));
  if (!blind.picture.recognition.found) return;
  std::optional<Circle> circle;
  if (const std::optional<CircleFound> found = find_circle(*found_.photo)) circle = found->circle;
  const GrownCamera& best = blind.picture.recognition.best;
  blind.place = sky_place(best, found_.frame, circle);
  tell_.lines(words_of(*blind.place, best));
  const SkyOfPicture& sky = found_.sky;
  if (!sky.julian_date || !sky.observer) tell_times();
  if (sky.julian_date) tell_planets(circle);
  if (!sky.julian_date || !sky.observer) return;
  blind.local = local_stars(blind.picture, found_.frame, *sky.observer, *sky.julian_date,
                            request_.first_faintest(), request_.min_elevation_deg);
}

/// Whether stars that were recognised blindly are known in azimuth and elevation, and a camera is asked for.
bool CameraCalibrator::is_placed() {
  const BlindStars& blind = *found_.blind;
  found_.has_answer = false;
  if (!blind.place) return false;
  if (!blind.local) {
    found_.has_answer = request_.output.empty();
    if (!request_.output.empty())
      tell_("no " + request_.output +
            ": azimuth and elevation need --time and --site. --stars-out STARS.csv keeps the stars, which "
            "'vegard calibrate STARS.csv' takes with them later");
    return false;
  }
  if (blind.local->elsewhere) {
    tell_(elsewhere_line(*blind.local));
    return false;
  }
  found_.has_answer = true;
  if (request_.output.empty()) return false;
  stars_ = blind.local->stars;
  if (!settings_.model || *settings_.model == blind.local->camera.model)
    settings_.start = blind.local->camera;
  const Identification& again = blind.local->again;
  tell_(fmt::format(
      "with time and site: {} of the {} stars to magnitude {:.1f} that should be seen have a point within "
      "{:.1f} px ({:.1f} would by chance)",
      stars_.size(), again.in_frame, blind.local->faintest, again.last_radius_px, again.by_chance));
  return true;
}

/// When the site had that part of the sky above it.
void CameraCalibrator::tell_times() const {
  const SkyOfPicture& sky = found_.sky;
  if (!sky.observer) {
    tell_("when that was overhead depends on the place: --site LAT,LON");
    return;
  }
  if (request_.date.empty()) {
    tell_("at what times of a night the site had that above its horizon: --date YYYY-MM-DD");
    return;
  }
  const auto noon = sim::julian_date(request_.date + "T12:00:00Z");
  if (!noon) throw usage_error("--date", "'" + request_.date + "' is no day", "YYYY-MM-DD, of the evening");
  // The noon of the place, not of Greenwich, begins its night.
  const double local_noon = *noon - sky.observer->longitude_deg / 360.0;
  tell_(std::string("that stood above the horizon of the site in a dark sky") +
        (request_.level ? ", with the camera level," : "") + ": " +
        words_of(times_of_night(found_.blind->picture.recognition.best, found_.frame, *sky.observer,
                                local_noon, request_.level)));
}

/// Whether the picture shows sky there.
bool CameraCalibrator::is_shown(const SeenPlanet& planet, const std::optional<Circle>& circle) {
  if (circle && std::hypot(planet.x_px - circle->x_px, planet.y_px - circle->y_px) > circle->radius_px)
    return false;
  const Frame& frame = found_.frame;
  const auto column = std::clamp(static_cast<int>(planet.x_px), 0, frame.width_px - 1);
  const auto row = std::clamp(static_cast<int>(planet.y_px), 0, frame.height_px - 1);
  return usable().empty() || usable()[static_cast<std::size_t>(row) * frame.width_px + column] != 0;
}

/// Those where the picture shows sky, and that the site had above its horizon, if the site is known.
void CameraCalibrator::tell_planets(const std::optional<Circle>& circle) {
  const double julian_date = *found_.sky.julian_date;
  const std::optional<sim::Observer>& observer = found_.sky.observer;
  const double min_up =
      observer ? std::sin(sim::horizon_elevation_deg(*observer) * sim::kRadiansPerDegree) : -1.0;
  for (const SeenPlanet& planet : planets_in(found_.blind->picture, found_.frame, julian_date)) {
    if (!is_shown(planet, circle)) continue;
    bool up = true;
    for (const sim::Planet one : sim::kPlanets) {
      if (planet.name != sim::name_of(one) || !observer) continue;
      sim::CataloguePlace place;
      place.j2000 = sim::place_of_planet(one, julian_date);
      up = sim::direction_of_star(place, *observer, julian_date)[2] > min_up;
    }
    if (!up) continue;
    const std::string at = fmt::format("({:.1f}, {:.1f})", planet.x_px, planet.y_px);
    if (planet.has_point)
      tell_(fmt::format("{}: the bright point at {}, {:.2f} deg from its computed place", planet.name, at,
                        planet.off_deg));
    else
      tell_(planet.name + " should be at " + at + ", where no bright point is");
  }
}

/// What the calibration is checked against.
StarEvidence CameraCalibrator::evidence() {
  constexpr double kZenithCamera_deg = 80.0;
  StarEvidence evidence;
  evidence.sky = found_.sky;
  evidence.photo = found_.photo ? &*found_.photo : nullptr;
  if (found_.photo) evidence.usable = usable();
  if (found_.blind) evidence.points = found_.blind->picture.found;
  evidence.is_table = !request_.stars.empty();
  if (camera_file_ && camera_file_->lines.count("camera.elevation_deg") > 0 &&
      camera_file_->camera.elevation_deg >= kZenithCamera_deg)
    evidence.why_level = "--camera looks to the zenith";
  evidence.faintest = request_.first_faintest();
  evidence.min_elevation_deg = request_.min_elevation_deg;
  evidence.min_signal = request_.min_signal;
  return evidence;
}

/// The camera by these stars, which is within a scene's limits.
Calibration CameraCalibrator::fitted(const std::vector<StarSighting>& stars) const {
  Calibration calibration = calibrate(settings_, stars, found_.frame, request_.source());
  check_scene(calibration);
  return calibration;
}

/// Refuses a table whose right ascensions are hours under the name of degrees: taken for hours the stars fit.
void CameraCalibrator::refuse_hours() const {
  std::optional<std::vector<StarSighting>> stars =
      stars_with_hours(request_.stars, found_.sky, request_.first_pixel);
  if (!stars) return;
  for (StarSighting& star : *stars) move_by_offset(request_, star);
  std::optional<Calibration> by_hours;
  try {
    by_hours = fitted(*stars);
  } catch (const sim::Error&) {
    return;
  }
  constexpr double kClearly = 3.0;
  const bool is_better = !found_.calibration || (by_hours->used() >= found_.calibration->used() &&
                                                 kClearly * by_hours->rms_px < found_.calibration->rms_px);
  if (!is_better) return;
  throw sim::unreadable(request_.stars,
                        fmt::format("its right ascensions are hours, not degrees: no number in 'ra_deg' is "
                                    "above 24, and as hours {} of {} stars fit to {:.2f} px",
                                    by_hours->used(), stars->size(), by_hours->rms_px))
      .key("ra_deg")
      .expected("'ra_hours' as the name of the column, or degrees in it");
}

void CameraCalibrator::fit_camera() {
  const std::string& from = request_.source();
  settings_.progress = tell_.progress_of(kFittingWork);
  try {
    found_.calibration = maps_ ? calibrate_maps(settings_, maps_->map, from) : fitted(stars_);
  } catch (const sim::Error&) {
    if (by_table_) refuse_hours();
    throw;
  }
  if (by_table_) refuse_hours();
  tell_.progress(kFittingWork, 1.0);
  if (found_.photo && !by_table_ && !maps_ && !listed_ && !request_.faintest) deepen(from);
  if (found_.sky.observer)
    found_.calibration->horizon_elevation_deg = sim::horizon_elevation_deg(*found_.sky.observer);
  if (!maps_) add_star_doubts(*found_.calibration, evidence());
  check_scene(*found_.calibration);

  CalibrationOrigin& origin = found_.origin;
  origin.stars = maps_ ? maps_->names : std::filesystem::path(from).filename().string();
  if ((maps_ || !request_.stars.empty()) && found_.photo) origin.image = found_.photo->file_name;
  for (const PhotoFact& fact : says_.taken) origin.from_photograph.push_back(fact_text(fact));
  origin.site_known = found_.sky.observer.has_value();
  if (found_.sky.observer) {
    origin.site.latitude_deg = found_.sky.observer->latitude_deg;
    origin.site.longitude_deg = found_.sky.observer->longitude_deg;
    origin.site.altitude_m = found_.sky.observer->height_m;
  }
  if (says_.instant) origin.site.time_utc = says_.instant->utc();
  if (origin.instant && found_.sky.observer)
    add_time_error(*found_.calibration, found_.sky.observer->latitude_deg, origin.instant->turn_error_deg());
}

/// Calibrates again with fainter stars, if the picture shows some.
void CameraCalibrator::deepen(const std::string& from) {
  constexpr int kManyPoints = 2000;
  const SkyOfPicture& sky = found_.sky;
  const int smaller = found_.blind ? found_.blind->picture.smaller : 1;
  StarFinderSettings many = finder();
  many.most = kManyPoints;
  const Calibration& before = *found_.calibration;
  std::vector<StarSighting> deeper = with_deeper_stars(
      before,
      field_sky(before.camera, found_.frame, *sky.observer, *sky.julian_date,
                sim::horizon_elevation_deg(*sky.observer) + request_.min_elevation_deg, 0.0),
      points_of_smaller(found_.photo->linear, many, usable(), smaller), SkyPixels(usable()), smaller);
  const std::size_t added = deeper.size() - before.stars.size();
  if (added == 0) return;
  LensSettings settings = settings_;
  if (!settings.start) settings.start = before.camera;
  settings.progress = tell_.progress_of(kDeeperWork);
  Calibration again = calibrate(settings, deeper, found_.frame, from);
  tell_.progress(kDeeperWork, 1.0);
  tell_(fmt::format("{} fainter stars, to magnitude {:.1f}, are where they should be", added,
                    deeper.back().magnitude));
  stars_ = std::move(deeper);
  found_.calibration = std::move(again);
}

}  // namespace

CameraCalibration calibrate_camera(const CalibrationRequest& request, const Tell& tell) {
  return CameraCalibrator(request, tell).run();
}

std::string elsewhere_line(const LocalStars& local) {
  return fmt::format(
      "the time or the site is not this picture's: {} of its {} recognised stars were below the horizon "
      "there then. Nothing was written but what the stars say alone",
      local.below_horizon, local.recognised);
}

}  // namespace vegard::fit
