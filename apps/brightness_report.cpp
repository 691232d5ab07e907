#include "apps/brightness_report.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim/base/version.h"
#include "sim/view/night_luminances.h"
#include "sim/view/radiometry.h"

namespace vegard::apps {
namespace {

using nlohmann::ordered_json;

constexpr double kEyeLimitKilorayleigh = 1.0;  // of green light: docs/physics.md, row B21

/// Three digits and a unit whose prefix keeps them short: "22.6 MW".
std::string in_units(double value, const std::string& unit) {
  constexpr std::array<const char*, 8> kPrefixes = {"\u00b5", "m", "", "k", "M", "G", "T", "P"};
  int prefix = 2;
  while (value != 0.0 && std::abs(value) >= 999.5 && prefix + 1 < static_cast<int>(kPrefixes.size())) {
    value *= 1e-3;
    ++prefix;
  }
  while (value != 0.0 && std::abs(value) < 0.9995 && prefix > 0) {
    value *= 1e3;
    --prefix;
  }
  return fmt::format("{:.3g} {}{}", value, kPrefixes[prefix], unit);
}

/// Rayleighs keep to R and kR: nobody speaks of milli- and megarayleighs.
std::string rayleighs(double value) {
  return value < 999.5 ? fmt::format("{:.3g} R", value)
                       : fmt::format("{:.{}f} kR", value * 1e-3,
                                     value < 9995.0    ? 2
                                     : value < 99950.0 ? 1
                                                       : 0);
}

std::string row(const std::string& name, const std::string& text) {
  return fmt::format("  {:<23}{}\n", name, text);
}

std::string sheet_text(const sim::SheetBrightness& sheet, int layers, const BrightnessReport& report) {
  std::string text = "sheet " + sheet.name + "\n";
  if (sheet.level != 1.0) text += row("substorm", fmt::format("{:.3g} of what the sheet says", sheet.level));
  std::string green = sim::brightness_class(sheet.layer_green_kilorayleigh) + " (" +
                      rayleighs(1e3 * sheet.layer_green_kilorayleigh) + " of 557.7 nm), one layer";
  if (layers > 1)
    green += fmt::format("; up to {} where all {} meet",
                         rayleighs(1e3 * layers * sheet.layer_green_kilorayleigh), layers);
  text += row("along the field", green);
  for (std::size_t l = 0; l < report.lines_nm.size(); ++l)
    text += row(l == 0 ? "one layer, by line" : "",
                fmt::format("{:.1f} nm {:>10}", report.lines_nm[l], rayleighs(sheet.layer_rayleigh[l])));
  if (!sheet.power) return text + row("power", "unknown: its light is not given by electrons");
  const sim::SheetPower& power = *sheet.power;
  text += row("energy flux",
              fmt::format("{:.3g} mW m\u207b\u00b2 at the peak across a layer", power.energy_flux_mw_m2));
  text += row("electrons", fmt::format("mean energy {:.3g} keV, {:.2e} cm\u207b\u00b2 s\u207b\u00b9",
                                       power.mean_energy_kev, power.electrons_cm2_s));
  std::string watts = fmt::format("{} per km of arc, {} in all", in_units(power.watts_per_km, "W"),
                                  in_units(power.watts, "W"));
  if (power.joules > 0.0)
    watts += fmt::format("; {} in the exposure of {:g} s", in_units(power.joules, "J"), report.exposure_s);
  return text + row("power", watts);
}

std::string place_text(const sim::BrightSpot& spot) {
  return fmt::format("pixel ({}, {}), azimuth {:.1f}\u00b0, elevation {:.1f}\u00b0", spot.x, spot.y,
                     spot.azimuth_deg, spot.elevation_deg);
}

const char* vision(double luminance_cd_m2) {
  if (luminance_cd_m2 < sim::kMesopicFrom_cd_m2) return "scotopic";
  return luminance_cd_m2 <= sim::kMesopicTo_cd_m2 ? "mesopic" : "photopic";
}

double green_kilorayleigh_like(double luminance_cd_m2) {
  return 1e-3 * luminance_cd_m2 / sim::luminance_cd_m2_per_rayleigh(557.7);
}

std::string vision_text(double luminance_cd_m2) {
  const double cones = 1.0 - sim::rod_share(luminance_cd_m2);
  if (green_kilorayleigh_like(luminance_cd_m2) < kEyeLimitKilorayleigh)
    return "nothing, or a grey glow: about 1 kR of green light is the limit";
  const std::string name = vision(luminance_cd_m2);
  const std::string share = fmt::format("{:.2g} % of colour", 100.0 * cones);
  if (name == "scotopic") return "grey: rods see, without colour (below 5 mcd m\u207b\u00b2); " + share;
  if (name == "mesopic") return "pale colour: rods and cones see (5 mcd to 5 cd m\u207b\u00b2); " + share;
  return "full colour: cones see; " + share;
}

ordered_json place_json(const sim::BrightSpot& spot) {
  return {
      {"pixel", {spot.x, spot.y}}, {"azimuth_deg", spot.azimuth_deg}, {"elevation_deg", spot.elevation_deg}};
}

ordered_json sheet_json(const sim::SheetBrightness& sheet, int layers, const BrightnessReport& report) {
  ordered_json lines = ordered_json::array();
  for (std::size_t l = 0; l < report.lines_nm.size(); ++l)
    lines.push_back({{"wavelength_nm", report.lines_nm[l]}, {"rayleigh", sheet.layer_rayleigh[l]}});
  ordered_json power = nullptr;
  if (sheet.power) {
    power = {{"energy_flux_mw_m2", sheet.power->energy_flux_mw_m2},
             {"mean_energy_kev", sheet.power->mean_energy_kev},
             {"electrons_cm2_s", sheet.power->electrons_cm2_s},
             {"watts_per_km", sheet.power->watts_per_km},
             {"watts", sheet.power->watts},
             {"joules", sheet.power->joules}};
  }
  const double green = sheet.layer_green_kilorayleigh;
  return {{"name", sheet.name},
          {"layers", layers},
          {"substorm_level", sheet.level},
          {"along_the_field",
           {{"class", sim::brightness_class(green)},
            {"ibc", green > 0.0 ? ordered_json(sim::brightness_coefficient(green)) : ordered_json(nullptr)},
            {"kilorayleigh_5577", green},
            {"lines", lines}}},
          {"power", power}};
}

}  // namespace

BrightnessReport brightness_report(const sim::Scene& scene, const sim::Rendering& rendering) {
  BrightnessReport report;
  report.lines_nm = scene.emission.lines;
  report.exposure_s = scene.time.exposure_s;
  for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
    report.sheets.push_back(sim::sheet_brightness(scene, static_cast<int>(s)));
    report.layers.push_back(scene.sheets[s].layers);
  }
  const std::size_t lines = scene.emission.lines.size();
  std::vector<double> luminance;
  for (std::size_t l = 0; l < lines; ++l) {
    std::vector<double> this_one(lines, 0.0);
    this_one[l] = 1.0;
    report.brightest.push_back(sim::brightest_spot(rendering.rayleigh, this_one, scene.camera));
    luminance.push_back(sim::luminance_cd_m2_per_rayleigh(scene.emission.lines[l]));
  }
  report.most_luminous = sim::brightest_spot(rendering.rayleigh, luminance, scene.camera);
  return report;
}

std::string brightness_text(const BrightnessReport& report) {
  std::string text;
  for (std::size_t s = 0; s < report.sheets.size(); ++s)
    text += sheet_text(report.sheets[s], report.layers[s], report);
  text += "in the picture, the aurora alone\n";
  const double luminance = report.most_luminous.value;
  if (!(luminance > 0.0)) return text + row("brightest", "dark");
  for (std::size_t l = 0; l < report.lines_nm.size(); ++l)
    text += row(l == 0 ? "brightest, by line" : "",
                fmt::format("{:.1f} nm {:>10}  {}", report.lines_nm[l], rayleighs(report.brightest[l].value),
                            place_text(report.brightest[l])));
  text += row("most luminous",
              fmt::format("{}, {:.1f} mag arcsec\u207b\u00b2  {}", in_units(luminance, "cd m\u207b\u00b2"),
                          sim::magnitudes_per_square_arcsecond(luminance), place_text(report.most_luminous)));
  text +=
      row("", fmt::format("{:.2g} times the darkest natural sky, {:.2g} times white ground under a full moon",
                          luminance / sim::kNaturalSky_cd_m2, luminance / sim::kMoonlitWhite_cd_m2));
  return text + row("a dark-adapted eye sees", vision_text(luminance));
}

std::string brightness_json(const BrightnessReport& report) {
  ordered_json json = {{"version", sim::version()}, {"exposure_s", report.exposure_s}};
  json["sheets"] = ordered_json::array();
  for (std::size_t s = 0; s < report.sheets.size(); ++s)
    json["sheets"].push_back(sheet_json(report.sheets[s], report.layers[s], report));
  ordered_json& picture = json["picture"];
  picture["lines"] = ordered_json::array();
  for (std::size_t l = 0; l < report.lines_nm.size(); ++l) {
    ordered_json line = {{"wavelength_nm", report.lines_nm[l]}, {"rayleigh", report.brightest[l].value}};
    line.update(place_json(report.brightest[l]));
    picture["lines"].push_back(line);
  }
  const double luminance = report.most_luminous.value;
  ordered_json eye = {{"luminance_cd_m2", luminance},
                      {"magnitudes_per_square_arcsecond", nullptr},
                      {"times_natural_sky", luminance / sim::kNaturalSky_cd_m2},
                      {"times_moonlit_white", luminance / sim::kMoonlitWhite_cd_m2},
                      {"vision", vision(luminance)},
                      {"cone_share", 1.0 - sim::rod_share(luminance)},
                      {"above_eye_limit", green_kilorayleigh_like(luminance) >= kEyeLimitKilorayleigh}};
  if (luminance > 0.0)
    eye["magnitudes_per_square_arcsecond"] = sim::magnitudes_per_square_arcsecond(luminance);
  eye["rayleigh"] = report.most_luminous.rayleigh;
  eye.update(place_json(report.most_luminous));
  picture["most_luminous"] = eye;
  return json.dump(2) + "\n";
}

}  // namespace vegard::apps
