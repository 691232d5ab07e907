#include "sim/scene/freedom/idle_sun_parameter.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/scene/lines/solar_lines.h"

namespace vegard::sim {
namespace {

bool is_one_of(const std::string& word, std::initializer_list<const char*> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool all_zero(const std::vector<double>& list) {
  return std::all_of(list.begin(), list.end(), [](double x) { return x == 0.0; });
}

Complaint idle(const std::string& what, const std::string& key, const std::string& hint) {
  return {what + ", so " + key + " counts for nothing", "a parameter that the light depends on",
          "leave it out of fit.free, or " + hint};
}

/// Whether the scene frees a number.
bool frees(const Scene& scene, const std::string& path) {
  return std::any_of(scene.fit.free.begin(), scene.fit.free.end(), [&](const FreeParameter& free) {
    return free.path == path || free.path.rfind(path + ".", 0) == 0;
  });
}

/// Whether any line of the scene shines by its temperature.
std::optional<Complaint> of_temperature(const Scene& scene, double temperature_mk) {
  if (temperature_mk == 0.0)
    return idle("the light is that of any temperature", "temperature_mk", "set it above 0");
  const std::vector<double>& lines = scene.emission.lines;
  if (std::any_of(lines.begin(), lines.end(), [](double nm) { return temperature_response(nm).has_value(); }))
    return std::nullopt;
  return idle("no emission line has a response to the temperature", "temperature_mk",
              "name a line of the corona in emission.lines");
}

std::optional<Complaint> of_sun(const Scene& scene, const std::string& key) {
  if (!scene.sun.shown) return idle("the Sun is not in the scene", key, "set sun.shown = true");
  const bool scatters = std::any_of(scene.coronae.begin(), scene.coronae.end(),
                                    [](const Corona& c) { return c.light == CoronaLight::scattered; });
  if (is_one_of(key, {"limb_darkening", "limb_darkening_square"}) && !scatters &&
      all_zero(scene.sun.photosphere_rayleigh) && !frees(scene, "sun.photosphere_rayleigh"))
    return idle("the photosphere is dark", key, "give it sun.photosphere_rayleigh");
  // What is alike all round looks the same from all sides.
  const bool has_places = !scene.loops.empty() || !scene.chromospheres.empty() || !scene.bundles.empty() ||
                          !scene.ejections.empty() ||
                          std::any_of(scene.volumes.begin(), scene.volumes.end(),
                                      [](const Volume& v) { return v.frame == VolumeFrame::sun; });
  const bool has_poles =
      has_places || std::any_of(scene.coronae.begin(), scene.coronae.end(), [&](const Corona& c) {
        return c.polar != 1.0 || frees(scene, "corona." + c.name + ".polar");
      });
  if ((key == "longitude_deg" && !has_places) ||
      (is_one_of(key, {"position_angle_deg", "latitude_deg"}) && !has_poles))
    return idle("what shines on the Sun is alike all round", key, "set something on it");
  return std::nullopt;
}

std::optional<Complaint> of_chromosphere(const Scene& scene, const Chromosphere& c, const std::string& key) {
  if (key == "peak" && c.biasmap.empty()) return idle("the chromosphere has no map", key, "name a biasmap");
  if (!c.cutoff && is_one_of(key, {"coverage", "sharpness", "amplitude"}))
    return idle("the chromosphere has no cutoff", key, "set cutoff = true");
  if (key == "roughness" && c.octaves == 1)
    return idle("the turbulence has one octave", key, "give it more octaves");
  const std::string path = "chromosphere." + c.name + ".";
  const bool is_dark = all_zero(c.rayleigh) && !frees(scene, path + "rayleigh"),
             is_clear = c.extinction == 0.0 && !frees(scene, path + "extinction");
  if (is_dark && is_clear && !is_one_of(key, {"rayleigh", "extinction"}))
    return idle("the chromosphere neither shines nor absorbs", key, "give it rayleigh or extinction");
  return std::nullopt;
}

std::optional<Complaint> of_loop(const Scene& scene, const Loop& l, const std::string& key) {
  if (is_one_of(key, {"brightening_at", "brightening_width"}) && l.brightening == 0.0 &&
      !frees(scene, "loop." + l.name + ".brightening"))
    return idle("the loop is nowhere brightened", key, "give it a brightening");
  if (key == "filament_pull" && l.filaments == 0)
    return idle("the loop has no filaments", key, "give it filaments");
  if (key == "filament_pull" && l.filaments >= l.strands)
    return idle("every strand is a filament of its own", key, "give it fewer filaments");
  if (key == "falloff_least" && l.height_falloff == HeightFalloff::none)
    return idle("the loop's light does not fall off along it", key, "name a height_falloff");
  if (is_one_of(key, {"spread", "tilt_per_distance_deg"}) && l.strands == 1)
    return idle("the loop is a single strand", key, "give it more strands");
  if (key == "temperature_mk") return of_temperature(scene, l.temperature_mk);
  return std::nullopt;
}

std::optional<Complaint> of_corona(const Scene& scene, const Corona& c, const ParameterPath& path) {
  const std::string& key = path.row->key;
  const auto term = static_cast<std::size_t>(std::max(0, path.component));
  if (key == "power" && term < c.share.size() && c.share[term] == 0.0 &&
      !frees(scene, "corona." + c.name + ".share"))
    return idle("its share is 0", key, "give it a share");
  if (key == "temperature_mk") return of_temperature(scene, c.temperature_mk);
  return std::nullopt;
}

}  // namespace

std::optional<Complaint> why_sun_number_counts_for_nothing(const Scene& scene, const ParameterPath& path) {
  const std::string &table = path.row->table, &key = path.row->key;
  const auto e = static_cast<std::size_t>(path.element);
  if (table == "sun") return of_sun(scene, key);
  if (table == "chromosphere") return of_chromosphere(scene, scene.chromospheres[e], key);
  if (table == "loop") return of_loop(scene, scene.loops[e], key);
  if (table == "corona") return of_corona(scene, scene.coronae[e], path);
  if (table == "bundle") {
    const Bundle& b = scene.bundles[e];
    if (key == "filament_pull" && b.filaments == 0)
      return idle("the bundle has no filaments", key, "give it filaments");
    if (key == "temperature_mk") return of_temperature(scene, b.temperature_mk);
  }
  if (table == "ejection") {
    const Ejection& j = scene.ejections[e];
    if (j.kind == EjectionKind::shell && is_one_of(key, {"turns", "strand_radius", "bearing_deg"}))
      return idle("the ejection is a shell", key, "set kind = \"rope\"");
    if (key == "speed_km_s" && j.age_s + scene.time.start_s <= 0.0 &&
        !frees(scene, "ejection." + j.name + ".age_s"))
      return idle("the ejection is of age 0", key, "give it an age_s");
    if (key == "temperature_mk") return of_temperature(scene, j.temperature_mk);
  }
  return std::nullopt;
}

}  // namespace vegard::sim
