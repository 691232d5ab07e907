#include "fit/measurement/calibration_request.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "fit/measurement/words.h"
#include "fit/photo/photo_defaults.h"
#include "fit/photo/taken_time.h"
#include "sim/base/utc_time.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {
namespace {

/// "k1,k2,p,aspect" or "none".
void read_terms(const std::string& words, LensForm& form) {
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

bool is_lens_form(const LensForm& form) {
  const std::vector<LensForm> forms = lens_forms();
  return std::any_of(forms.begin(), forms.end(),
                     [&](const LensForm& one) { return words_of(one) == words_of(form); });
}

void add_free(const std::string& word, const LensForm& form, std::vector<LensNumber>& free) {
  const auto add = [&](LensNumber number) {
    if (std::find(free.begin(), free.end(), number) == free.end()) free.push_back(number);
  };
  if (word == "rotation") {
    for (const auto number : {turn_about_right, turn_about_down, turn_about_forward}) add(number);
  } else if (word == "centre") {
    add(centre_x_number);
    add(centre_y_number);
  } else if (word == "focal") {
    add(focal_px_number);
  } else if (word == "aspect") {
    add(aspect_ratio_number);
  } else if (word == "radial") {
    if (form.radial == 0)
      throw usage_error("--free", "the lens of --camera has no radial terms", "terms that it has");
    for (int i = 0; i < form.radial; ++i) add(static_cast<LensNumber>(radial_1_number + i));
  } else if (word == "decentring") {
    add(decentring_1_number);
    add(decentring_2_number);
  } else {
    throw usage_error("--free", "nothing is called '" + word + "'",
                      "some of rotation, centre, focal, aspect, radial, decentring");
  }
}

/// The beginning of the exposure by the request.
std::optional<StarInstant> asked_instant(const CalibrationRequest& request) {
  if (request.time.empty()) return std::nullopt;
  if (!sim::utc_seconds(request.time))
    throw usage_error("--time", "'" + request.time + "' is no time",
                      "ISO 8601 such as 2014-02-21T19:30:40Z, or with a zone, 2014-02-21T20:30:40+01:00");
  StarInstant instant;
  instant.begin_utc = sim::in_utc(request.time);
  instant.source = "--time";
  instant.error_s = sim::resolution_s(request.time) / std::sqrt(12.0);
  return instant;
}

/// The site of the request, or of its camera.
SkyOfPicture sky_of(const CalibrationRequest& request, const std::optional<sim::Scene>& camera_scene) {
  SkyOfPicture sky;
  if (request.site) {
    sky.observer = request.site;
    sky.observer->refracting_air = !request.vacuum;
  } else if (camera_scene && camera_scene->lines.count("site.latitude_deg") != 0 &&
             camera_scene->lines.count("site.longitude_deg") != 0) {
    sky.observer = sim::Observer{camera_scene->site.latitude_deg, camera_scene->site.longitude_deg,
                                 camera_scene->site.altitude_m, !request.vacuum};
  }
  return sky;
}

/// Takes from the metadata what the request does not give.
void add_metadata(const CalibrationRequest& request, const std::optional<sim::Scene>& camera_scene,
                  const sim::PictureMetadata& metadata, PictureSays& says) {
  sim::Scene scene;
  if (camera_scene) scene = *camera_scene;
  scene.lines.erase("site.time_utc");
  // What is no matter of a calibration is as good as given: exposure, and a magnetic field to warn of.
  std::set<std::string> given = {"sensor.f_number", "sensor.iso", "time.exposure_s", "field.inclination_deg"};
  if (says.instant) given.insert("site.time_utc");
  if (says.sky.observer || !metadata.latitude_deg)
    for (const char* key : {"site.latitude_deg", "site.longitude_deg", "site.altitude_m"}) given.insert(key);
  // An angle across the picture's width means nothing across another.
  if (!camera_scene || scene.lines.count("camera.width") + scene.lines.count("camera.height") > 0 ||
      scene.lines.count("camera.hfov_deg") + scene.lines.count("camera.focal_px") > 0 ||
      scene.camera.model != sim::LensModel::pinhole)
    for (const char* key : {"camera.hfov_deg", "camera.width", "camera.height"}) given.insert(key);

  PhotoDefaults defaults = with_photo_defaults(scene, metadata, given);
  says.taken = defaults.taken;
  says.notes = defaults.notes;
  const sim::Site& site = defaults.scene.site;
  bool place = false;
  for (const PhotoFact& fact : says.taken) {
    if (fact.path == "site.time_utc")
      says.instant = StarInstant{site.time_utc, fact.source, {}, taken_time(metadata).error_s};
    place = place || fact.path == "site.latitude_deg";
  }
  if (place)
    says.sky.observer =
        sim::Observer{site.latitude_deg, site.longitude_deg, site.altitude_m, !request.vacuum};
  if (camera_scene) says.camera = defaults.scene;
}

}  // namespace

const std::string& CalibrationRequest::source() const {
  if (maps) return maps->file;
  return !wcs.empty() ? wcs : !acc.empty() ? acc : !stars.empty() ? stars : image;
}

void check_together(const CalibrationRequest& request) {
  const bool by_maps = request.by_directions(), blind = request.blind();
  if (by_maps && !request.stars.empty())
    throw usage_error("STARS", "stars and maps",
                      "one of a table of stars and --azimuth-map, --skymap, --wcs or --acc");
  if (!by_maps && request.stars.empty() && request.image.empty())
    throw usage_error("STARS", "no stars",
                      "a table of stars, or --image; or --azimuth-map, --skymap, --wcs, --acc");
  if (!request.by_hand.empty() && (by_maps || !request.stars.empty()))
    throw usage_error("--star", "stars by hand and a table or maps",
                      "--star with --image alone, or --camera");
  if (!request.by_hand.empty() && request.image.empty())
    throw usage_error("--star", "no picture has these stars", "--image with it");
  if (request.finds_points && request.image.empty())
    throw usage_error("--axy-out", "no picture has points of light", "--image with it");
  if (!request.corr_out.empty() && by_maps)
    throw usage_error("--corr-out", "directions are no stars", "a table of stars, or --image");
  if (request.output.empty() && !blind)
    throw usage_error("--output", "nothing to write the camera to", "-o CAMERA.toml");
  if (!blind && (!request.date.empty() || request.level || request.keeps_recognised))
    throw usage_error("--stars-out, --date, --level", "for stars that are recognised blindly",
                      "--image alone: no table, maps or --camera");
}

LensSettings lens_settings(const CalibrationRequest& request, const std::optional<SkyCamera>& start) {
  LensSettings settings;
  settings.centre_free = !request.centre_held;
  settings.keeps_all = request.keeps_all;
  settings.start = start;
  if (!request.free.empty()) {
    if (!start) throw usage_error("--free", "nothing to hold", "--camera with it");
    if (!request.lens.empty() || !request.terms.empty())
      throw usage_error("--free", "the lens of --camera is held", "neither --lens nor --terms");
    const LensForm form = form_of(*start);
    for (const std::string& word : request.free) add_free(word, form, settings.only);
  }
  if (request.lens.empty()) {
    if (!request.terms.empty()) throw usage_error("--terms", "terms of which lens?", "--lens with it");
    return settings;
  }
  LensForm form;
  const std::optional<sim::LensModel> known = lens_model(request.lens);
  if (!known)
    throw usage_error("--lens", "no lens '" + request.lens + "'",
                      "pinhole, equidistant, equisolid, stereographic, orthographic or polynomial");
  settings.model = form.model = *known;
  if (!request.terms.empty()) {
    read_terms(request.terms, form);
    if (!is_lens_form(form))
      throw usage_error("--terms", "a lens " + words_of(form) + " is not known",
                        "radial terms with pinhole and polynomial alone, at least k1 with polynomial");
    settings.form = form;
  }
  return settings;
}

PictureSays with_metadata(const CalibrationRequest& request, const std::optional<sim::Scene>& camera_scene,
                          const sim::PictureMetadata& metadata) {
  PictureSays says;
  says.sky = sky_of(request, camera_scene);
  says.instant = asked_instant(request);
  says.camera = camera_scene;
  if (!request.no_metadata) add_metadata(request, camera_scene, metadata, says);
  if (!says.instant) return says;
  if (request.exposure_s)
    says.instant->middle_after_s = 0.5 * *request.exposure_s;
  else if (!request.no_metadata)
    says.instant->middle_after_s = middle_after_s(metadata);
  says.sky.julian_date = sim::julian_date(says.instant->utc());
  return says;
}

}  // namespace vegard::fit
