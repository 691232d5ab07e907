#include <algorithm>

#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/value_check.h"

namespace vegard::sim {
namespace {

std::string auroral_lines_text() {
  std::string text;
  for (const EmissionLine& line : emission_lines())
    if (is_auroral(line)) text += (text.empty() ? "" : ", ") + real_text(line.wavelength_nm);
  return text;
}

/// A profile of nothing but layers has some, and does not promise a brightness that is of a line without one.
void check_layers(const Scene& scene) {
  const auto has_layer = [&](double nm) {
    const OwnLine* own = find_own_line(scene, nm);
    return own != nullptr && own->rayleigh_per_mw_m2 > 0.0;
  };
  const std::vector<double>& lines = scene.emission.lines;
  const bool any = std::any_of(lines.begin(), lines.end(), has_layer);
  const auto check = [&](ProfileKind profile, const std::string& path) {
    if (profile == ProfileKind::layer && !any)
      throw scene_error({"no line of emission.lines has a layer, so that nothing shines",
                         "a [[line]] with rayleigh_per_mw_m2, and its wavelength in emission.lines", ""},
                        {scene.file, 0, path + ".profile"});
  };
  for (const Sheet& sheet : scene.sheets) {
    check(sheet.profile, "sheet." + sheet.name);
    if (sheet.profile == ProfileKind::layer && sheet.brightness_kilorayleigh > 0.0 && !has_layer(kGreenNm))
      throw scene_error({"the brightness is that of 557.7 nm, of which the profile \"layer\" has no light",
                         "energy_flux_mw_m2", ""},
                        {scene.file, 0, "sheet." + sheet.name + ".brightness_kilorayleigh"});
  }
  for (const Footprint& footprint : scene.footprints) check(footprint.profile, "footprint." + footprint.name);
}

}  // namespace

void check_own_lines(const Scene& scene) {
  for (const OwnLine& own : scene.own_lines) {
    const auto error_at = [&](const Complaint& complaint, const char* key) {
      return scene_error(complaint, {scene.file, 0, "line." + own.name + "." + key});
    };
    const OwnLine* first = find_own_line(scene, own.wavelength_nm);
    if (first != &own)
      throw error_at({"the lines '" + first->name + "' and '" + own.name + "' are both at " +
                          short_real_text(own.wavelength_nm) + " nm",
                      "lines 0.05 nm apart or more", ""},
                     "wavelength_nm");
    const EmissionLine* listed = find_emission_line(own.wavelength_nm);
    if (listed != nullptr && listed->components.size() > 1)
      throw error_at({short_real_text(own.wavelength_nm) + " nm is the name of a set: " + listed->transition,
                      "a wavelength that is not a set's", "vegard lines has them"},
                     "wavelength_nm");
    if (own.rayleigh_per_mw_m2 > 0.0 && own.scale_height_km == 0.0 &&
        scale_height_km(scene.body, own.peak_km) < kThinnestLayer_km)
      throw error_at(
          {"the air of [body] gives a layer of " + short_real_text(scale_height_km(scene.body, own.peak_km)) +
               " km, which is too thin",
           "at least " + short_real_text(kThinnestLayer_km) + " km",
           "another air_temperature_k, air_mass_dalton or gravity_m_s2, or a scale_height_km of the line"},
          "scale_height_km");
    if (own.follows_nm == 0.0) continue;
    const EmissionLine* followed = find_emission_line(own.follows_nm);
    if (followed == nullptr || !is_auroral(*followed))
      throw error_at({"the emission tables have no light of " + short_real_text(own.follows_nm) + " nm",
                      "0, or one of " + auroral_lines_text(), ""},
                     "follows_nm");
    if (own.rayleigh_per_mw_m2 > 0.0)
      throw error_at({"the line follows another one and has a layer of its own", "one of the two",
                      "leave out follows_nm or rayleigh_per_mw_m2"},
                     "rayleigh_per_mw_m2");
  }
  check_layers(scene);
}

}  // namespace vegard::sim
