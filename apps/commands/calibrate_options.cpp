#include "apps/commands/calibrate_options.h"

#include <algorithm>
#include <set>

#include "apps/options/photo_options.h"
#include "apps/options/refusals.h"
#include "apps/options/site_words.h"
#include "fit/photo/photo_defaults.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/sky/star_place.h"

namespace vegard::apps {
namespace {

/// "k1,k2,p,aspect" or "none".
void read_terms(const std::string& words, fit::LensForm& form) {
  form.radial = 0;
  form.decentring = form.aspect = false;
  for (std::size_t begin = 0; begin <= words.size();) {
    const std::size_t end = std::min(words.find(',', begin), words.size());
    const std::string word = words.substr(begin, end - begin);
    begin = end + 1;
    if (word == "k1" || word == "k2" || word == "k3")
      form.radial = std::max(form.radial, word[1] - '0');
    else if (word == "p")
      form.decentring = true;
    else if (word == "aspect")
      form.aspect = true;
    else if (word != "none")
      throw usage_error("--terms", "no term '" + word + "'", "some of k1, k2, k3, p, aspect; or none");
  }
}

bool is_lens_form(const fit::LensForm& form) {
  const std::vector<fit::LensForm> forms = fit::lens_forms();
  return std::any_of(forms.begin(), forms.end(),
                     [&](const fit::LensForm& one) { return fit::words_of(one) == fit::words_of(form); });
}

void add_free(const std::string& word, const fit::LensForm& form, std::vector<fit::LensNumber>& free) {
  const auto add = [&](fit::LensNumber number) {
    if (std::find(free.begin(), free.end(), number) == free.end()) free.push_back(number);
  };
  if (word == "rotation") {
    for (const auto number : {fit::turn_about_right, fit::turn_about_down, fit::turn_about_forward})
      add(number);
  } else if (word == "centre") {
    add(fit::centre_x_number);
    add(fit::centre_y_number);
  } else if (word == "focal") {
    add(fit::focal_px_number);
  } else if (word == "aspect") {
    add(fit::aspect_ratio_number);
  } else if (word == "radial") {
    if (form.radial == 0)
      throw usage_error("--free", "the lens of --camera has no radial terms", "terms that it has");
    for (int i = 0; i < form.radial; ++i) add(static_cast<fit::LensNumber>(fit::radial_1_number + i));
  } else if (word == "decentring") {
    add(fit::decentring_1_number);
    add(fit::decentring_2_number);
  } else {
    throw usage_error("--free", "nothing is called '" + word + "'",
                      "some of rotation, centre, focal, aspect, radial, decentring");
  }
}

}  // namespace

void add_calibrate_options(const Command& command, CalibrateOptions& options) {
  command.option(
      "STARS", options.stars,
      "A table of recognised stars (x_px, y_px, and azimuth_deg with elevation_deg or zenith_deg, ra_deg "
      "with dec_deg, or star), a .corr file of solve-field, or its .axy list of points of light (with "
      "--camera). Without it stars are found in --image, blindly if there is no --camera");
  command.option("-o,--output", options.output, "The camera to write: a scene file with [camera] and [site]")
      .type_name("CAMERA.toml");
  command.option("--image", options.image,
                 "The picture of the stars: gives its size, and time, site and focal length from its "
                 "metadata if no option does");
  add_at_option(command, options.at);
  command
      .option("--time", options.time,
              "Time of the picture, ISO 8601 in UTC or with a zone (2014-02-21T20:30:40+01:00)")
      .type_name("TIME");
  add_site_option(command, options.site);
  command.option("--camera", options.camera, "A rough camera, or an earlier one, to start from")
      .type_name("CAMERA.toml");
  command
      .option("--free", options.free,
              "Fit only these of --camera, and hold the rest: rotation, centre, focal, aspect, radial, "
              "decentring")
      .delimiter(',')
      .one_an_occurrence();
  command.option("--lens", options.lens,
                 "Fit only this lens: pinhole, equidistant, equisolid, stereographic, orthographic or "
                 "polynomial (default: the simplest that the stars support)");
  command.option("--terms", options.terms, "With --lens: fit only these of k1, k2, k3, p, aspect; or none");
  command.flag("--hold-centre", options.centre_held, "Hold the lens's centre in the middle of the picture");
  command.option("--size", options.size_px, "The picture's size in pixels, where --image is not given")
      .delimiter(',')
      .expected(2)
      .type_name("W,H");
  command.option("--first-pixel", options.first_pixel,
                 "Coordinate of the first pixel's centre in the table (default: 0.5, and 1 for .corr files)");
  command
      .option("--offset", options.offset_px,
              "Place of the table's upper left corner in the picture, if the table is of a crop")
      .delimiter(',')
      .expected(2)
      .type_name("X,Y");
  command.flag("--no-refraction", options.vacuum,
               "Compute places of stars, given by name or right ascension, without refraction by the air");
  command.option("--centre", options.centre_px, "The lens's centre in the picture, in place of --camera's")
      .delimiter(',')
      .expected(2)
      .type_name("X,Y");
  command
      .option("--twist", options.twist_deg,
              "Finding stars: how far --camera may be rotated about its axis, in degrees (default: 5; 180: "
              "any angle)")
      .range(0.0, 180.0);
  command
      .option("--shift", options.shift_px,
              "Finding stars: largest error of the centre, in pixels (default: 12)")
      .range(0.0, 200.0);
  command
      .option("--scale", options.scale_percent,
              "Finding stars: largest error of focal_px, in per cent (default: 0)")
      .range(0.0, 50.0);
  command
      .option("--radius", options.radius_px,
              "Finding stars: largest distance of a point of light from its star at first, in pixels "
              "(default: 12)")
      .range(2.5, 500.0);
  command
      .option("--catalogue-magnitude", options.faintest,
              "Finding stars: magnitude of the faintest (default: 4)")
      .range(-2.0, 4.5);
  command
      .option("--min-elevation", options.min_elevation_deg,
              "Finding stars: elevation of the lowest, in degrees (default: 5)")
      .range(-1.0, 90.0);
  command
      .option("--signal", options.min_signal,
              "Finding stars: signal-to-noise ratio of the faintest point of light (default: 4)")
      .range(1.0, 1e6);
  command.option("--mask", options.mask, "An image of the picture's size: white = look for stars there");
  add_decoding_option(command, options.decoding, SceneOfDecoding::none);
  add_map_options(command, options.maps);
  command
      .option("--wcs", options.wcs,
              "Use Astrometry.net's solution of the picture in place of stars (needs --time and --site)")
      .type_name("FIELD.wcs");
  command
      .option("--acc", options.acc, "Use a camera of AIDA_tools in place of stars (needs --size or --image)")
      .type_name("FILE.acc");
  command.option("--acc-line", options.acc_line, "Line of that file, from 1, if it has several cameras");
  command
      .option("--axy-out", options.axy_out,
              "Write the points of light of --image for solve-field (X, Y, FLUX)")
      .type_name("OUT.axy");
  command
      .option("--corr-out", options.corr_out,
              "Write the stars used as solve-field does: observed and catalogue positions")
      .type_name("OUT.corr");
  command.flag("--no-metadata", options.no_metadata,
               "Do not take time, site and focal length from the picture's metadata");
  command
      .option("--stars-out", options.stars_out,
              "Write the stars recognised in --image, with right ascension and declination, as a table that "
              "this command reads")
      .type_name("STARS.csv");
  command
      .option(
          "--date", options.date,
          "With --image and --site, the time unknown: date of the evening; lists the night's possible times")
      .type_name("YYYY-MM-DD");
  command.flag("--level", options.level, "With --date: assume that the camera was level");
  command.option("--residuals", options.residuals, "Write the stars' residuals").type_name("OUT.csv");
  command
      .option(
          "--json", options.json,
          "Write lenses, numbers, correlations and stars; without a file name, print them in place of words")
      .expected(0, 1)
      .type_name("OUT.json");
  command.option("--plot", options.plot, "Draw the residuals").type_name("OUT.svg|OUT.png");
  command.option("--overlay", options.overlay, "Draw the stars on the picture").type_name("OUT.png");
  command.flag("--overwrite", options.overwrite, "Replace outputs that exist");
}

fit::SkyOfPicture sky_of(const CalibrateOptions& options, const std::optional<sim::Scene>& camera_scene) {
  fit::SkyOfPicture sky;
  if (!options.time.empty()) {
    sky.julian_date = sim::julian_date(options.time);
    if (!sky.julian_date)
      throw usage_error("--time", "'" + options.time + "' is no time",
                        "ISO 8601 such as 2014-02-21T19:30:40Z, or with a zone, 2014-02-21T20:30:40+01:00");
  }
  if (!options.site.empty()) {
    const SitePlace place = site_place(options.site);
    sky.observer = sim::Observer{place.latitude_deg, place.longitude_deg, place.height_m, !options.vacuum};
  } else if (camera_scene && camera_scene->lines.count("site.latitude_deg") != 0 &&
             camera_scene->lines.count("site.longitude_deg") != 0) {
    sky.observer = sim::Observer{camera_scene->site.latitude_deg, camera_scene->site.longitude_deg,
                                 camera_scene->site.altitude_m, !options.vacuum};
  }
  return sky;
}

fit::LensSettings lens_settings(const CalibrateOptions& options, const std::optional<fit::SkyCamera>& start) {
  fit::LensSettings settings;
  settings.centre_free = !options.centre_held;
  settings.start = start;
  if (!options.free.empty()) {
    if (!start) throw usage_error("--free", "nothing to hold", "--camera with it");
    if (!options.lens.empty() || !options.terms.empty())
      throw usage_error("--free", "the lens of --camera is held", "neither --lens nor --terms");
    const fit::LensForm form = fit::form_of(*start);
    for (const std::string& word : options.free) add_free(word, form, settings.only);
  }
  if (options.lens.empty()) {
    if (!options.terms.empty()) throw usage_error("--terms", "terms of which lens?", "--lens with it");
    return settings;
  }
  fit::LensForm form;
  const std::optional<sim::LensModel> known = fit::lens_model(options.lens);
  if (!known)
    throw usage_error("--lens", "no lens '" + options.lens + "'",
                      "pinhole, equidistant, equisolid, stereographic, orthographic or polynomial");
  settings.model = form.model = *known;
  if (!options.terms.empty()) {
    read_terms(options.terms, form);
    if (!is_lens_form(form))
      throw usage_error("--terms", "a lens " + fit::words_of(form) + " is not known",
                        "radial terms with pinhole and polynomial alone, at least k1 with polynomial");
    settings.form = form;
  }
  return settings;
}

PictureSays with_metadata(const CalibrateOptions& options, const std::optional<sim::Scene>& camera_scene,
                          const sim::PictureMetadata& metadata) {
  PictureSays says;
  says.sky = sky_of(options, camera_scene);
  says.camera = camera_scene;
  if (options.no_metadata) return says;

  sim::Scene scene;
  if (camera_scene) scene = *camera_scene;
  scene.lines.erase("site.time_utc");
  // What is no matter of a calibration is as good as given: exposure, and a magnetic field to warn of.
  std::set<std::string> given = {"sensor.f_number", "sensor.iso", "time.exposure_s", "field.inclination_deg"};
  if (says.sky.julian_date) given.insert("site.time_utc");
  if (says.sky.observer || !metadata.latitude_deg)
    for (const char* key : {"site.latitude_deg", "site.longitude_deg", "site.altitude_m"}) given.insert(key);
  // An angle across the picture's width means nothing across another.
  if (!camera_scene || scene.lines.count("camera.width") + scene.lines.count("camera.height") > 0 ||
      scene.lines.count("camera.hfov_deg") + scene.lines.count("camera.focal_px") > 0 ||
      scene.camera.model != sim::LensModel::pinhole)
    for (const char* key : {"camera.hfov_deg", "camera.width", "camera.height"}) given.insert(key);

  fit::PhotoDefaults defaults = fit::with_photo_defaults(scene, metadata, given);
  says.taken = defaults.taken;
  says.notes = defaults.notes;
  const sim::Site& site = defaults.scene.site;
  bool place = false;
  for (const fit::PhotoFact& fact : says.taken) {
    if (fact.path == "site.time_utc") says.sky.julian_date = sim::julian_date(site.time_utc);
    place = place || fact.path == "site.latitude_deg";
  }
  if (place)
    says.sky.observer =
        sim::Observer{site.latitude_deg, site.longitude_deg, site.altitude_m, !options.vacuum};
  if (camera_scene) says.camera = defaults.scene;
  return says;
}

}  // namespace vegard::apps
