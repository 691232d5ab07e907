#include "apps/commands/commands.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/commands/calibrate_blind.h"
#include "apps/commands/calibrate_options.h"
#include "apps/options/exit_code.h"
#include "apps/options/file_names.h"
#include "apps/options/json_answer.h"
#include "apps/options/photo_options.h"
#include "apps/options/refusals.h"
#include "apps/options/standard_streams.h"
#include "apps/output/plot_file.h"
#include "apps/output/terminal.h"
#include "fit/photo/photo.h"
#include "fit/photo/photo_metadata.h"
#include "fit/photo/pointing/blind/star_doubts.h"
#include "fit/photo/pointing/calibration_tables.h"
#include "fit/photo/pointing/catalogue_sky.h"
#include "fit/photo/pointing/exchange/aida_camera.h"
#include "fit/photo/pointing/exchange/sip_wcs.h"
#include "fit/photo/pointing/exchange/star_files.h"
#include "fit/photo/pointing/identification.h"
#include "fit/photo/pointing/map_calibration.h"
#include "fit/photo/pointing/scene_camera.h"
#include "fit/photo/pointing/star_check.h"
#include "fit/photo/pointing/star_finder.h"
#include "fit/report/calibration_plots.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"
#include "sim/base/file/number_text.h"
#include "sim/base/file/whole_file.h"
#include "sim/base/picture/picture_metadata.h"
#include "sim/base/picture/pixel_limit.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/sky/star_place.h"

namespace vegard::apps {
namespace {

constexpr int kLensesShown = 8;

std::string plain_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// The file that gives directions in the place of stars; empty if none does.
const std::string& directions_file(const CalibrateOptions& options) {
  return !options.wcs.empty() ? options.wcs : !options.acc.empty() ? options.acc : options.maps.first();
}

bool is_by_directions(const CalibrateOptions& options) {
  return options.maps.any() || !options.wcs.empty() || !options.acc.empty();
}

std::string names_of(const CalibrateOptions& options) {
  if (!options.wcs.empty() || !options.acc.empty()) return plain_name(directions_file(options));
  const MapOptions& maps = options.maps;
  std::string names = plain_name(maps.first());
  if (!maps.elevation_map.empty() && maps.elevation_map != maps.azimuth_map)
    names += ", " + plain_name(maps.elevation_map);
  return names;
}

void check_outputs(const CalibrateOptions& options) {
  const std::pair<const char*, const std::string*> outputs[] = {
      {"--output", &options.output},   {"--residuals", &options.residuals},
      {"--json", &options.json},       {"--plot", &options.plot},
      {"--overlay", &options.overlay}, {"--stars-out", &options.stars_out},
      {"--axy-out", &options.axy_out}, {"--corr-out", &options.corr_out}};
  for (const auto& [key, file] : outputs) {
    for (const std::string& input :
         {options.stars, options.image, options.mask, options.camera, options.maps.azimuth_map,
          options.maps.elevation_map, options.maps.skymap, options.wcs, options.acc})
      if (same_file(*file, input)) refuse_same_file(key, *file, "an input");
    for (const auto& [other_key, other] : outputs)
      if (std::string(key) > other_key && same_file(*file, *other)) refuse_same_file(key, *file, other_key);
  }
}

/// Claimed before the work: one that may not be written is refused before any other is, and none is written
/// by halves.
class CalibrateOutputs {
 public:
  explicit CalibrateOutputs(const CalibrateOptions& options) {
    for (const std::string& name : {options.output, options.residuals, options.json, options.plot,
                                    options.overlay, options.stars_out, options.axy_out, options.corr_out})
      if (!name.empty()) claimed_[name] = std::make_unique<sim::WholeFile>(name, options.overwrite);
  }
  void put(const std::string& name, const std::string& bytes) {
    if (name.empty()) return;
    claimed_.at(name)->write(bytes);
    written_.push_back(name);
  }
  /// Those that were put; what was claimed for nothing leaves no trace.
  void commit() {
    for (const std::string& name : written_) claimed_.at(name)->commit();
  }
  const std::vector<std::string>& written() const { return written_; }
  void tell() const {
    for (const std::string& name : written_) say("%s\n", name.c_str());
  }

 private:
  std::map<std::string, std::unique_ptr<sim::WholeFile>> claimed_;
  std::vector<std::string> written_;  ///< in order
};

fit::Frame frame_of(const CalibrateOptions& options, const std::optional<fit::Photo>& photo,
                    const std::vector<fit::StarSighting>& stars) {
  if (photo) {
    const fit::Frame frame{photo->linear.width, photo->linear.height, true};
    if (!options.size_px.empty() &&
        (options.size_px[0] != frame.width_px || options.size_px[1] != frame.height_px))
      throw usage_error("--size", "the picture has another size", "no --size with --image");
    return frame;
  }
  if (!options.size_px.empty()) {
    if (options.size_px[0] < 1 || options.size_px[1] < 1 ||
        std::max(options.size_px[0], options.size_px[1]) > 65535)
      throw usage_error("--size", "no such size", "two numbers from 1 to 65535");
    return {options.size_px[0], options.size_px[1], true};
  }
  double right = 1.0, bottom = 1.0;
  for (const fit::StarSighting& star : stars) {
    right = std::max(right, std::min(star.x_px, 65000.0));
    bottom = std::max(bottom, std::min(star.y_px, 65000.0));
  }
  return {static_cast<int>(std::ceil(right)), static_cast<int>(std::ceil(bottom)), false};
}

fit::Frame frame_of(const CalibrateOptions& options, const std::optional<fit::Photo>& photo,
                    const KnownDirections& maps) {
  const fit::Frame frame{maps.map.width, maps.map.height, true};
  if (photo && (photo->linear.width != frame.width_px || photo->linear.height != frame.height_px))
    throw usage_error("--image", "the picture has another size than the maps", "the maps' own picture");
  if (!options.size_px.empty() &&
      (options.size_px[0] != frame.width_px || options.size_px[1] != frame.height_px))
    throw usage_error("--size", "the maps have another size", "no --size with maps");
  return frame;
}

/// The stars of the table, in the pixels of the picture.
std::vector<fit::StarSighting> table_of(const CalibrateOptions& options, const fit::SkyOfPicture& sky) {
  std::vector<fit::StarSighting> stars = fit::read_star_table(options.stars, sky, options.first_pixel);
  if (options.offset_px.empty()) return stars;
  for (fit::StarSighting& star : stars) {
    star.x_px += options.offset_px[0];
    star.y_px += options.offset_px[1];
  }
  return stars;
}

/// Per pixel, whether the mask leaves it; empty without one.
std::vector<char> where_to_look(const CalibrateOptions& options, const fit::Photo& photo) {
  return options.mask.empty() ? std::vector<char>() : fit::pixels_left_by(options.mask, photo);
}

/// What a calibration is checked against.
fit::StarEvidence evidence_of(const CalibrateOptions& options, const std::optional<sim::Scene>& camera_file,
                              const fit::SkyOfPicture& sky, const std::optional<fit::Photo>& photo) {
  constexpr double kZenithCamera_deg = 80.0;
  fit::StarEvidence evidence;
  evidence.sky = sky;
  evidence.photo = photo ? &*photo : nullptr;
  if (photo) evidence.usable = where_to_look(options, *photo);
  evidence.is_table = !options.stars.empty();
  if (camera_file && camera_file->lines.count("camera.elevation_deg") > 0 &&
      camera_file->camera.elevation_deg >= kZenithCamera_deg)
    evidence.why_level = "--camera looks to the zenith";
  evidence.faintest = options.faintest;
  evidence.min_elevation_deg = options.min_elevation_deg;
  evidence.min_signal = options.min_signal;
  return evidence;
}

std::vector<fit::FoundStar> points_in(const CalibrateOptions& options, const fit::Photo& photo) {
  fit::StarFinderSettings finder;
  finder.min_signal = options.min_signal;
  return fit::find_stars(photo.linear, finder, where_to_look(options, photo));
}

/// The points of light of solve-field's list, if the table of stars is one.
std::optional<fit::StarPoints> listed_points(const CalibrateOptions& options) {
  if (options.stars.empty()) return std::nullopt;
  const std::string bytes = sim::input_bytes(options.stars, "a table of stars");
  if (!fit::is_star_list(bytes, options.stars)) return std::nullopt;
  if (options.camera.empty())
    throw usage_error("--camera", "points of light alone are stars of a rough camera",
                      "--camera CAMERA.toml with the list, or --image alone");
  return fit::read_star_list(bytes, options.stars);
}

/// Where the pixels look by another program's file. Throws Error(usage, unreadable_input).
KnownDirections told_directions(const CalibrateOptions& options, const std::optional<fit::Photo>& photo,
                                const fit::SkyOfPicture& sky) {
  if (!options.maps.first().empty() || !options.maps.elevation_map.empty() ||
      (!options.wcs.empty() && !options.acc.empty()))
    throw usage_error(options.wcs.empty() ? "--acc" : "--wcs", "directions are given twice",
                      "one of --wcs, --acc, --skymap and --azimuth-map");
  const fit::SkyMapFlip flip = flip_of(options.maps);
  int width = 0, height = 0;
  if (photo) {
    width = photo->linear.width;
    height = photo->linear.height;
  } else if (!options.size_px.empty()) {
    width = options.size_px[0];
    height = options.size_px[1];
    sim::check_pixel_limit(width, height, "--size");
  }
  KnownDirections known;
  if (!options.wcs.empty()) {
    fit::SipWcs wcs =
        fit::read_sip_wcs(sim::input_bytes(options.wcs, "the .wcs file of solve-field"), options.wcs);
    fit::require_sky(sky, options.wcs);
    if (wcs.width_px == 0 || wcs.height_px == 0) {
      wcs.width_px = width;
      wcs.height_px = height;
    }
    if (wcs.width_px == 0)
      throw usage_error("--size", "the solution does not say how large its picture is", "--size or --image");
    sim::check_pixel_limit(wcs.width_px, wcs.height_px, options.wcs);
    known = {fit::directions_of_wcs(wcs, *sky.observer, *sky.julian_date),
             "solution " + plain_name(options.wcs),
             {}};
  } else {
    const std::vector<fit::AidaCamera> cameras =
        fit::read_aida_cameras(sim::input_bytes(options.acc, "a camera of AIDA_tools"), options.acc);
    const auto chosen = std::find_if(cameras.begin(), cameras.end(), [&](const fit::AidaCamera& one) {
      return !options.acc_line || one.line == *options.acc_line;
    });
    if (cameras.size() > 1 && !options.acc_line)
      throw usage_error("--acc-line", "the file has " + std::to_string(cameras.size()) + " cameras",
                        "the line of one of them");
    if (chosen == cameras.end())
      throw usage_error("--acc-line", "there is no camera in line " + std::to_string(*options.acc_line),
                        "a line of the file");
    if (width == 0) throw usage_error("--size", "a camera of AIDA's has no size", "--size W,H or --image");
    known = {fit::directions_of_aida(*chosen, width, height), "camera " + plain_name(options.acc), {}};
  }
  fit::flip_map(flip, known.map);
  return known;
}

/// Stars found among points of light and named by the catalogue.
std::vector<fit::StarSighting> recognised(const CalibrateOptions& options,
                                          const std::vector<fit::FoundStar>& points, const fit::Frame& frame,
                                          const fit::SkyOfPicture& sky, const fit::LensSettings& lens,
                                          fit::SkyCamera& start) {
  if (!sky.julian_date) throw usage_error("--time", "stars are found by when and where", "--time and --site");
  if (!sky.observer) throw usage_error("--site", "stars are found by when and where", "--time and --site");
  const std::vector<fit::StarSighting> catalogue =
      fit::catalogue_sky(*sky.observer, *sky.julian_date, options.faintest, options.min_elevation_deg);
  fit::IdentificationSettings settings;
  settings.faintest = options.faintest;
  settings.first_magnitude = std::min(settings.first_magnitude, options.faintest);
  settings.twist_deg = options.twist_deg;
  settings.shift_px = options.shift_px;
  settings.scale_share = 0.01 * options.scale_percent;
  settings.first_radius_px = options.radius_px;
  settings.free =
      lens.only.empty() ? fit::free_numbers({start.model, 0, false, false}, lens.centre_free) : lens.only;
  const fit::Identification found = fit::identify(start, frame, catalogue, points, settings);
  say("%zu points of light; %zu of the %d stars to magnitude %.1f that should be seen have one within %.1f "
      "px (%.1f would by chance)\n",
      points.size(), found.stars.size(), found.in_frame, options.faintest, found.last_radius_px,
      found.by_chance);
  if (!fit::is_trustworthy(found))
    say("note: so few may be an accident of the search: look at --overlay, try a brighter "
        "--catalogue-magnitude, another --lens, --scale or mirrored in --camera\n");
  start = found.camera;
  return found.stars;
}

void print(const fit::Calibration& calibration) {
  if (calibration.candidates.size() > 1) say_text(fit::candidates_text(calibration, kLensesShown));
  say("lens: %s%s\n", fit::words_of(calibration.form).c_str(),
      calibration.camera.mirrored ? ", mirrored" : "");
  if (calibration.maps)
    say("rms: %s px over %d of %zu points of the maps\n%s\n",
        sim::short_number(calibration.rms_px, 3).c_str(), calibration.used(), calibration.stars.size(),
        fit::words_of(*calibration.maps).c_str());
  else
    say("rms: %.3f px over %d of %zu stars; each star by a fit without it: %.3f px\n", calibration.rms_px,
        calibration.used(), calibration.stars.size(), calibration.without_rms_px);
  for (const fit::CameraEstimate& estimate : calibration.estimates)
    if (estimate.free)
      say("camera.%s: %s %s\n", estimate.key().c_str(),
          sim::number_with_error(estimate.value, estimate.sigma).c_str(), estimate.unit().c_str());
  say("the axis is known to %s deg, the turn about it to %s deg\n",
      sim::short_number(calibration.line_of_sight_sigma_deg, 2).c_str(),
      sim::short_number(calibration.twist_sigma_deg, 2).c_str());
  if (calibration.maps && calibration.used() < static_cast<int>(calibration.stars.size()))
    say("left out: %d points, farther off than the others' scatter explains\n",
        static_cast<int>(calibration.stars.size()) - calibration.used());
  for (std::size_t i = 0; !calibration.maps && i < calibration.stars.size(); ++i) {
    const fit::StarResidual& one = calibration.residuals[i];
    if (one.used) continue;
    const fit::StarSighting& star = calibration.stars[i];
    say("left out: %s%s at (%.1f, %.1f), %.2f px off\n", star.name.empty() ? "the star" : star.name.c_str(),
        star.line > 0 ? (" of line " + std::to_string(star.line)).c_str() : "", star.x_px, star.y_px,
        std::hypot(one.dx_px, one.dy_px));
  }
  for (const std::string& warning : calibration.warnings) say("note: %s\n", warning.c_str());
}

int run_calibrate(const CalibrateOptions& options) {
  end_at_once_when_interrupted();
  const PlotFormat format = plot_format(options.plot, "--plot");
  check_outputs(options);
  const bool by_maps = is_by_directions(options);
  if (by_maps && !options.stars.empty())
    throw usage_error("STARS", "stars and maps",
                      "one of a table of stars and --azimuth-map, --skymap, --wcs or --acc");
  if (!by_maps && options.stars.empty() && options.image.empty())
    throw usage_error("STARS", "no stars",
                      "a table of stars, or --image; or --azimuth-map, --skymap, --wcs, --acc");
  if (!options.axy_out.empty() && options.image.empty())
    throw usage_error("--axy-out", "no picture has points of light", "--image with it");
  if (!options.corr_out.empty() && by_maps)
    throw usage_error("--corr-out", "directions are no stars", "a table of stars, or --image");
  const bool blind = !by_maps && options.stars.empty() && options.camera.empty();
  if (options.output.empty() && !blind)
    throw usage_error("--output", "nothing to write the camera to", "-o CAMERA.toml");
  if (!blind && (!options.stars_out.empty() || !options.date.empty() || options.level))
    throw usage_error("--stars-out, --date, --level", "for stars that are recognised blindly",
                      "--image alone: no table, maps or --camera");
  if (blind && options.output.empty() &&
      !(options.residuals.empty() && options.json.empty() && options.plot.empty() && options.overlay.empty()))
    throw usage_error("--output", "residuals, plots and overlays are of a camera",
                      "-o CAMERA.toml with them");
  if (!options.offset_px.empty() && options.stars.empty())
    throw usage_error("--offset", "no table of a crop", "STARS as well");
  if (!options.overlay.empty() && options.image.empty())
    throw usage_error("--overlay", "no picture to draw on", "--image with it");

  CalibrateOutputs outputs(options);
  std::optional<sim::Scene> camera_file;
  if (!options.camera.empty()) camera_file = sim::read_scene(options.camera);
  sim::PictureMetadata metadata;
  std::optional<fit::Photo> photo;
  std::optional<KnownDirections> maps;
  if (options.maps.any() && options.wcs.empty() && options.acc.empty()) maps = maps_of(options.maps);
  if (!options.image.empty()) {
    photo = fit::read_photo(options.image, decoding_of(options.decoding, "auto"));
    metadata = fit::photo_metadata(options.image);
    metadata.width_px = photo->linear.width;
    metadata.height_px = photo->linear.height;
  }
  const PictureSays says = with_metadata(options, camera_file, metadata);
  const std::optional<sim::Scene>& camera_scene = says.camera;
  fit::SkyOfPicture sky = says.sky;
  if (!sky.observer && maps && maps->place)
    sky.observer = {maps->place->latitude_deg, maps->place->longitude_deg, maps->place->altitude_m};
  if (by_maps && !maps) maps = told_directions(options, photo, sky);
  for (const fit::PhotoFact& fact : says.taken)
    say("from the photograph: %s\n", fit::fact_text(fact).c_str());
  for (const std::string& note : says.notes) say("note: %s\n", note.c_str());
  std::vector<fit::StarSighting> stars;
  const std::optional<fit::StarPoints> listed = listed_points(options);
  const bool by_table = !options.stars.empty() && !listed;
  if (by_table) stars = table_of(options, sky);
  const fit::Frame frame = maps ? frame_of(options, photo, *maps)
                           : listed && listed->frame.known && !photo && options.size_px.empty()
                               ? listed->frame
                               : frame_of(options, photo, stars);
  if (listed && !frame.known)
    throw usage_error("--size", "the list does not say how large its picture is", "--size or --image");
  if (!options.axy_out.empty())
    outputs.put(options.axy_out, fit::encode_star_list(points_in(options, *photo), frame, options.axy_out));
  if (!options.corr_out.empty()) fit::require_sky(sky, options.corr_out);
  if (by_table && frame.known) fit::check_star_places(stars, frame, options.stars);
  std::optional<fit::SkyCamera> start;
  if (camera_scene) start = fit::sky_camera_of(camera_scene->camera, frame);
  if (start && !options.centre_px.empty()) {
    start->numbers[fit::centre_x_number] = options.centre_px[0];
    start->numbers[fit::centre_y_number] = options.centre_px[1];
  }
  fit::LensSettings settings = lens_settings(options, start);
  if (blind) {
    const BlindStars seen = recognise_blindly(options, *photo, where_to_look(options, *photo), sky);
    if (!seen.table.empty()) outputs.put(options.stars_out, seen.table);
    if (!seen.local) {
      outputs.commit();
      json_answer()["outputs"] = json_names(outputs.written());
      outputs.tell();
      return seen.exit_code;
    }
    stars = seen.stars;
    if (!settings.model || *settings.model == seen.camera.model) settings.start = seen.camera;
  } else if (!maps && !by_table) {
    stars = recognised(options, listed ? listed->points : points_in(options, *photo), frame, sky, settings,
                       *start);
    settings.start = start;
  }
  const std::string from = maps                    ? directions_file(options)
                           : options.stars.empty() ? options.image
                                                   : options.stars;
  fit::Calibration calibration =
      maps ? fit::calibrate_maps(settings, maps->map, from) : fit::calibrate(settings, stars, frame, from);
  if (!maps) fit::add_star_doubts(calibration, evidence_of(options, camera_file, sky, photo));
  sim::Scene scene;
  scene.camera = fit::scene_camera_of(calibration);
  sim::validate(scene);

  fit::CalibrationOrigin origin;
  origin.stars = maps ? names_of(options) : plain_name(from);
  if ((maps || !options.stars.empty()) && photo) origin.image = photo->file_name;
  for (const fit::PhotoFact& fact : says.taken) origin.from_photograph.push_back(fit::fact_text(fact));
  origin.site_known = sky.observer.has_value();
  if (sky.observer) {
    origin.site.latitude_deg = sky.observer->latitude_deg;
    origin.site.longitude_deg = sky.observer->longitude_deg;
    origin.site.altitude_m = sky.observer->height_m;
  }
  if (sky.julian_date) origin.site.time_utc = sim::text_of_julian_date(*sky.julian_date);

  // All is made before anything gets its name.
  outputs.put(options.output, fit::camera_toml(calibration, origin));
  if (!options.residuals.empty()) outputs.put(options.residuals, fit::residuals_csv(calibration));
  if (!options.corr_out.empty())
    outputs.put(options.corr_out, fit::encode_star_pairs(calibration, sky, options.corr_out));
  if (!options.json.empty()) outputs.put(options.json, fit::calibration_json(calibration, origin));
  if (format != PlotFormat::none)
    outputs.put(options.plot, plot_bytes(fit::residual_plot(calibration), format));
  if (!options.overlay.empty()) outputs.put(options.overlay, fit::star_overlay(calibration, *photo));
  outputs.commit();

  answer_with(fit::calibration_json(calibration, origin));
  json_answer()["outputs"] = json_names(outputs.written());
  print(calibration);
  if (!frame.known) say("note: the picture's size was guessed from its stars: set --size or --image\n");
  outputs.tell();
  return good;
}

}  // namespace

void add_calibrate_command(Program& program) {
  const auto options = std::make_shared<CalibrateOptions>();
  const Command command = program.add(
      "calibrate",
      "Find a camera's pointing, lens and distortion from the stars in its picture, or from maps of "
      "its directions");
  add_calibrate_options(command, *options);
  command.runs([options, json = command.option_of_name("--json")] {
    if (json.given() && options->json.empty()) voice().is_json = true;
    options->image = picture_at(options->image, options->at);
    return run_calibrate(*options);
  });
}

}  // namespace vegard::apps
