#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/structs/line_of.h"
#include "sim/scene/table/value_check.h"

namespace vegard::sim {
namespace {

/// What of the Earth alone a scene on another body asks for.
class EarthOnly {
 public:
  explicit EarthOnly(const Scene& scene) : scene_(scene) {}

  void refuse(bool is_set, const std::string& key, const std::string& what,
              const std::string& expected = {}) const {
    if (!is_set) return;
    throw scene_error({what + " of the Earth alone, and the scene's body is \"" + scene_.body.name + "\"",
                       (expected.empty() ? "" : expected + ", or ") + "body.name = \"earth\"", ""},
                      {scene_.file, 0, key});
  }

 private:
  const Scene& scene_;
};

void check_numbers_of_earth(const Scene& scene) {
  const Body earth;
  const auto check = [&](double Body::*number, const char* key) {
    if (scene.body.*number == earth.*number) return;
    throw scene_error({"the Earth's " + std::string(key) + " is " + short_real_text(earth.*number),
                       "that, or body.name = \"own\"", ""},
                      {scene.file, 0, std::string("body.") + key});
  };
  check(&Body::radius_km, "radius_km");
  check(&Body::gravity_m_s2, "gravity_m_s2");
  check(&Body::dipole_moment_t_m3, "dipole_moment_t_m3");
  check(&Body::air_temperature_k, "air_temperature_k");
  check(&Body::air_mass_dalton, "air_mass_dalton");
}

}  // namespace

void check_body(const Scene& scene) {
  if (is_earth(scene.body)) return check_numbers_of_earth(scene);
  const EarthOnly only(scene);
  const std::string layer = "\"layer\"";
  only.refuse(scene.field.model == FieldModel::igrf, "field.model", "the reference field is", "\"dipole\"");
  for (const Sheet& sheet : scene.sheets)
    only.refuse(is_of_electrons(sheet.profile) || sheet.profile == ProfileKind::proton,
                "sheet." + sheet.name + ".profile", "the emission tables are",
                layer + ", \"line\", \"file\" or \"spline\"");
  for (const Footprint& footprint : scene.footprints)
    only.refuse(is_of_electrons(footprint.profile), "footprint." + footprint.name + ".profile",
                "the emission tables are", layer);
  for (const OwnLine& own : scene.own_lines)
    only.refuse(own.follows_nm > 0.0, "line." + own.name + ".follows_nm", "the emission tables are",
                "rayleigh_per_mw_m2");
  if (!scene.sheets.empty() || !scene.footprints.empty())
    for (const double nm : scene.emission.lines) {
      const EmissionLine* listed = find_emission_line(nm);
      only.refuse(find_own_line(scene, nm) == nullptr && listed != nullptr && is_auroral(*listed),
                  "emission.lines", "the program's line of " + short_real_text(nm) + " nm is", "a [[line]]");
    }
  only.refuse(scene.blur.model == BlurModel::physical, "blur.model",
              "the air in which excited atoms wander is", "\"angle\"");
  only.refuse(scene.air.model != AirModel::none, "air.model", "the lower air is", "\"none\"");
  const auto refuse_above_zero = [&](double value, const std::string& key, const std::string& what) {
    only.refuse(value > 0.0, key, what, "0");
  };
  refuse_above_zero(scene.airglow.green_rayleigh, "airglow.green_rayleigh", "the airglow is");
  refuse_above_zero(scene.airglow.red_rayleigh, "airglow.red_rayleigh", "the airglow is");
  refuse_above_zero(scene.airglow.sodium_rayleigh, "airglow.sodium_rayleigh", "the airglow is");
  refuse_above_zero(scene.light_pollution.luminance_mcd_m2, "light_pollution.luminance_mcd_m2",
                    "the glow of towns is");
  only.refuse(scene.twilight.shown, "twilight.shown", "the twilight is", "false");
  only.refuse(scene.stars.shown && scene.stars.source == StarSource::catalogue, "stars.source",
              "the places of the stars by time are", "\"random\"");
  only.refuse(scene.stars.planets, "stars.planets", "the sky of the planets is", "false");
  only.refuse(scene.stars.milky_way, "stars.milky_way", "the place of the Milky Way by time is", "false");
  only.refuse(scene.moon.shown, "moon.shown", "the Moon is", "false");
  only.refuse(scene.moon.skylight, "moon.skylight", "the Moon is", "false");
  only.refuse(scene.ground.shown, "ground.shown", "the ground with its snow is", "false");
}

void require_earth(const Scene& scene, const std::string& what) {
  EarthOnly(scene).refuse(!is_earth(scene.body), "body.name", what + " is");
}

}  // namespace vegard::sim
