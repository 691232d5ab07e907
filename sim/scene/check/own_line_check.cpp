#include <algorithm>
#include <iterator>

#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/lines/scene_lines.h"
#include "sim/scene/rows/parameter_rules.h"
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

constexpr double kLinesOfProtonsNm[] = {391.4, 427.8, 486.1, 656.3};

/// A sheet of one line or of protons shines in the picture, and does not ask for what it lacks.
void check_sheets_of_line(const Scene& scene) {
  for (const Sheet& sheet : scene.sheets) {
    if (!is_as_bright_as_given(sheet.profile)) continue;
    const std::string path = "sheet." + sheet.name + ".", nm = short_real_text(sheet.line_nm);
    const auto is_given = [&](double of_protons) { return line_index({of_protons}, sheet.line_nm) == 0; };
    if (sheet.profile == ProfileKind::proton &&
        std::none_of(std::begin(kLinesOfProtonsNm), std::end(kLinesOfProtonsNm), is_given))
      throw scene_error({"protons have no light of " + nm + " nm here", "391.4, 427.8, 486.1 or 656.3",
                         "486.1 nm is their own"},
                        {scene.file, 0, path + "line_nm"});
    if (sheet.profile == ProfileKind::line && line_index(scene.emission.lines, sheet.line_nm) < 0)
      throw scene_error({"the sheet's light is of " + nm + " nm, which is not among emission.lines",
                         nm + " in emission.lines", "or the line_nm of one that is"},
                        {scene.file, 0, path + "line_nm"});
    if (sheet.brightness_kilorayleigh > 0.0)
      throw scene_error(
          {"the profile \"" + std::string(sheet.profile == ProfileKind::line ? "line" : "proton") +
               "\" has a brightness of its own",
           "line_kilorayleigh", "brightness_kilorayleigh (and ibc) are for electrons"},
          {scene.file, 0, path + "brightness_kilorayleigh"});
  }
  const bool any = std::any_of(scene.sheets.begin(), scene.sheets.end(),
                               [](const Sheet& sheet) { return is_as_bright_as_given(sheet.profile); });
  for (const Footprint& footprint : scene.footprints)
    if (any && footprint.source == FootprintSource::sheets)
      throw scene_error(
          {"a footprint is of electrons, which a sheet of profile \"line\" or \"proton\" has none of",
           "sheets of electrons", "render that sheet without the footprint"},
          {scene.file, 0, "footprint." + footprint.name + ".source"});
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
    if (!own.spectrum_file.empty() && !is_table_file(own.spectrum_file))
      throw error_at({"'" + own.spectrum_file + "' is no CSV file by its name",
                      "spectrum_file = \"a name that ends in .csv\"", "the file is in the scene's folder"},
                     "spectrum_file");
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
  check_sheets_of_line(scene);
}

}  // namespace vegard::sim
