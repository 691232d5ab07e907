#include "fit/photo/photo_defaults.h"

#include <algorithm>
#include <cmath>

#include "fit/photo/taken_time.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/utc_time.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::fit {
namespace {

class Given {
 public:
  Given(const sim::Scene& scene, const std::set<std::string>& also) : scene_(scene), also_(also) {}

  bool operator()(const std::string& path) const {
    return scene_.lines.count(path) > 0 || also_.count(path) > 0;
  }

 private:
  const sim::Scene& scene_;
  const std::set<std::string>& also_;
};

/// Keys that go together: where one of them is given, the others are not taken from elsewhere.
const std::vector<std::vector<std::string>>& groups() {
  static const std::vector<std::vector<std::string>> all = {
      {"site.latitude_deg", "site.longitude_deg"},
      {"camera.width", "camera.height"},
      {"camera.hfov_deg", "camera.focal_px"},
  };
  return all;
}

bool is_settled(const Given& given, const std::string& path) {
  if (given(path)) return true;
  return std::any_of(groups().begin(), groups().end(), [&](const std::vector<std::string>& group) {
    return std::find(group.begin(), group.end(), path) != group.end() &&
           std::any_of(group.begin(), group.end(), given);
  });
}

bool was_taken(const PhotoDefaults& defaults, const std::string& path) {
  return std::any_of(defaults.taken.begin(), defaults.taken.end(),
                     [&](const PhotoFact& fact) { return fact.path == path; });
}

void note_the_field(const Given& given, PhotoDefaults& defaults) {
  if (!was_taken(defaults, "site.latitude_deg")) return;
  const sim::Field& field = defaults.scene.field;
  if (field.model != sim::FieldModel::uniform) {
    defaults.notes.push_back(
        std::string(field.model == sim::FieldModel::dipole ? "the dipole's field" : "the reference field") +
        " is that of the photograph's place");
    return;
  }
  if (given("field.inclination_deg") || given("field.declination_deg")) return;
  defaults.notes.push_back("the magnetic field is still the default's (inclination " +
                           sim::short_number(field.inclination_deg) + " deg, declination " +
                           sim::short_number(field.declination_deg) +
                           " deg), not that of the photograph's place: set field.inclination_deg and "
                           "field.declination_deg, or field.model = \"dipole\"");
}

/// A camera's clock may be wrong, and is set right in the scene; an imager's is kept by a time server.
void note_the_time(const Given& given, const sim::PictureMetadata& metadata, PhotoDefaults& defaults) {
  const auto add = [&](const std::vector<std::string>& notes) {
    defaults.notes.insert(defaults.notes.end(), notes.begin(), notes.end());
  };
  add(metadata.contradictions);
  if (!given("site.time_utc")) add(taken_time(metadata).notes);
  if (!given("site.time_utc") || !metadata.header_time_utc) return;
  const std::string& of_scene = defaults.scene.site.time_utc;
  const auto scene_s = sim::utc_seconds(of_scene), header_s = sim::utc_seconds(*metadata.header_time_utc);
  constexpr double kSame_s = 1.0;
  if (!scene_s || !header_s || std::abs(*scene_s - *header_s) <= kSame_s + metadata.exposure_s.value_or(0.0))
    return;
  defaults.notes.push_back("the scene's site.time_utc is " + of_scene + ", the photograph's own time " +
                           *metadata.header_time_utc + " (" + metadata.sources.header_time +
                           "); the scene's is taken");
}

}  // namespace

PhotoDefaults with_photo_defaults(const sim::Scene& scene, const sim::PictureMetadata& metadata,
                                  const std::set<std::string>& also_given) {
  const Given given(scene, also_given);
  const PhotoFacts known = photo_facts(metadata);
  const bool has_size = metadata.width_px == scene.camera.width && metadata.height_px == scene.camera.height;
  PhotoDefaults defaults;
  defaults.scene = scene;
  for (const PhotoFact& fact : known.facts) {
    if (is_settled(given, fact.path)) continue;
    if (fact.path == "camera.hfov_deg" && scene.camera.model != sim::LensModel::pinhole) continue;
    if (has_size && (fact.path == "camera.width" || fact.path == "camera.height")) continue;
    try {
      sim::set_from_text(defaults.scene, fact.path, fact.value);
    } catch (const sim::Error& error) {
      defaults.notes.push_back("not taken: " + fact_text(fact) + ": " + error.details().problem);
      continue;
    }
    defaults.taken.push_back(fact);
  }
  note_the_field(given, defaults);
  note_the_time(given, metadata, defaults);
  return defaults;
}

}  // namespace vegard::fit
