#include "apps/output/brightness_texts.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim/base/shown_text.h"
#include "sim/base/version.h"
#include "sim/view/colour/radiometry.h"

namespace vegard::apps {
namespace {

/// Three digits and a unit whose prefix keeps them short: "22.6 MW".
std::string in_units(double value, const std::string& unit) {
  constexpr std::array<const char*, 8> kPrefixes = {"\u00b5", "m", "", "k", "M", "G", "T", "P"};
  std::size_t prefix = 2;
  for (; value >= 999.5 && prefix + 1 < kPrefixes.size(); ++prefix) value *= 1e-3;
  for (; value > 0.0 && value < 0.9995 && prefix > 0; --prefix) value *= 1e3;
  return fmt::format("{:.3g} {}{}", value, kPrefixes[prefix], unit);
}

/// Three digits without an exponent.
std::string plain(double value) {
  return value < 9.995 ? fmt::format("{:.2f}", value) : fmt::format("{:.{}f}", value, value < 99.95 ? 1 : 0);
}

/// In R and kR: milli- and megarayleighs are not in use.
std::string rayleighs(double value) {
  return value < 999.5 ? plain(value) + "  R" : plain(1e-3 * value) + " kR";
}

std::string row(const std::string& name, const std::string& text) {
  return fmt::format("  {:<20}{}\n", name, text);
}

std::string sheet_text(const sim::SheetBrightness& sheet, int layers, const sim::BrightnessReport& report) {
  std::string text = "sheet " + sheet.name + "\n";
  if (sheet.level != 1.0) text += row("substorm", fmt::format("{:.3g} of what the sheet says", sheet.level));
  const double green = sheet.layer_green_kilorayleigh;
  std::string words =
      fmt::format("{}, {} kR of 557.7 nm, one layer", sim::brightness_class(green), plain(green));
  if (layers > 1) words += fmt::format("; up to {} kR where all {} meet", plain(layers * green), layers);
  if (green > 0.0) text += row("along the field", words);  // the class is that of the green line
  for (std::size_t l = 0; l < report.lines_nm.size(); ++l)
    text += row(l == 0 ? "one layer, by line" : "",
                fmt::format("{:.1f} nm {:>9}", report.lines_nm[l], rayleighs(sheet.layer_rayleigh[l])));
  if (!sheet.power)
    return text + row("power", "unknown: the scene does not say which electrons make its light");
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

std::string eye_text(const sim::EyeReport& eye) {
  if (!eye.above_eye_limit)
    return "nothing, or a grey glow: fainter than 1 kR of 557.7 nm, about the eye's limit";
  const std::string share = fmt::format(", {:.2g} % of full colour", 100.0 * eye.cone_share);
  if (eye.vision == "scotopic") return "grey: rods see, cones hardly (below 5 mcd m\u207b\u00b2)" + share;
  if (eye.vision == "mesopic") return "pale colour: rods and cones see (5 mcd to 5 cd m\u207b\u00b2)" + share;
  return "colour: cones see (above 5 cd m\u207b\u00b2)" + share;
}

std::string picture_text(const sim::BrightnessReport& report) {
  std::string text = "in the picture, the aurora alone\n";
  const double luminance = report.most_luminous.value;
  if (!(luminance > 0.0)) return text + row("brightest", "dark");
  for (std::size_t l = 0; l < report.lines_nm.size(); ++l)
    text += row(l == 0 ? "brightest, by line" : "",
                fmt::format("{:.1f} nm {:>9}  {}", report.lines_nm[l], rayleighs(report.brightest[l].value),
                            place_text(report.brightest[l])));
  text += row("most luminous",
              fmt::format("{}, {:.1f} mag arcsec\u207b\u00b2", in_units(luminance, "cd m\u207b\u00b2"),
                          sim::magnitudes_per_square_arcsecond(luminance)));
  text += row("", place_text(report.most_luminous));
  text += row("", fmt::format("{} times the darkest natural sky, {} times white ground under a full moon",
                              plain(luminance / sim::kNaturalSky_cd_m2),
                              plain(luminance / sim::kMoonlitWhite_cd_m2)));
  return text + row("to the eye", eye_text(report.eye));
}

std::string ground_text(const sim::GroundIllumination& ground) {
  std::string text = "on level ground, where the observer stands\n";
  text += row("aurora", in_units(ground.aurora_lx, "lx"));
  if (ground.night_sky_lx > 0.0) text += row("night sky", in_units(ground.night_sky_lx, "lx"));
  if (ground.stars_lx > 0.0) text += row("stars and Moon", in_units(ground.stars_lx, "lx"));
  return text + row("", fmt::format("{:.2g} times a full moon's light", ground.lux() / sim::kFullMoon_lx));
}

std::string three(const sim::Vector3& rgb) {
  std::string text;
  for (double value : rgb)
    text += fmt::format("{:>8}", value < 999.5 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value));
  return text;
}

std::string sensor_text(const sim::BrightnessReport& report) {
  const sim::ExpectedCounts& counts = report.counts;
  std::string text = "on the sensor, a pixel on the axis       red   green    blue\n";
  for (const sim::LineCounts& line : counts.lines) {
    const double full = line.saturation_kilorayleigh;
    text += row(fmt::format("1 kR of {:.1f} nm", line.wavelength_nm),
                fmt::format("electrons   {}{}", three(line.electrons_per_kilorayleigh),
                            std::isfinite(full) ? "   full at " + rayleighs(1e3 * full) : ""));
  }
  const sim::SpotCounts& spot = report.spot_counts;
  text += row("most luminous spot",
              "electrons   " + three(spot.electrons) + (spot.saturated ? "   saturated" : ""));
  text += row("", fmt::format("above black {}   DN", three(spot.dn)));
  text += row("", "signal/noise" + three(spot.signal_to_noise));
  if (!counts.relative_uncertainty)
    return text + row("how sure", "unknown: the scale is sensor.gain_per_kilorayleigh as given");
  std::string parts;
  for (const sim::UncertaintyPart& part : counts.parts)
    parts += fmt::format("{}{} {:.0f} %", parts.empty() ? "" : ", ", part.name, 100.0 * part.relative);
  return text + row("how sure", fmt::format("within {:.0f} % (one sigma): {}",
                                            100.0 * *counts.relative_uncertainty, parts));
}

using nlohmann::ordered_json;

/// null for what is no number.
ordered_json number(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

/// null where all is dark: no pixel is brighter than another.
void add_place(const sim::BrightSpot& spot, ordered_json& json) {
  const bool is_lit = spot.value > 0.0;
  json["pixel"] = is_lit ? ordered_json{spot.x, spot.y} : ordered_json(nullptr);
  json["azimuth_deg"] = is_lit ? ordered_json(spot.azimuth_deg) : ordered_json(nullptr);
  json["elevation_deg"] = is_lit ? ordered_json(spot.elevation_deg) : ordered_json(nullptr);
}

ordered_json sheet_json(const sim::SheetBrightness& sheet, int layers, const std::vector<double>& lines_nm) {
  ordered_json lines = ordered_json::array();
  for (std::size_t l = 0; l < lines_nm.size(); ++l)
    lines.push_back({{"wavelength_nm", lines_nm[l]}, {"rayleigh", sheet.layer_rayleigh[l]}});
  ordered_json power = nullptr;
  if (sheet.power)
    power = {{"energy_flux_mw_m2", sheet.power->energy_flux_mw_m2},
             {"mean_energy_kev", sheet.power->mean_energy_kev},
             {"electrons_cm2_s", sheet.power->electrons_cm2_s},
             {"watts_per_km", sheet.power->watts_per_km},
             {"watts", sheet.power->watts},
             {"joules", sheet.power->joules}};
  const double green = sheet.layer_green_kilorayleigh;
  return {{"name", sheet.name},
          {"layers", layers},
          {"substorm_level", sheet.level},
          {"along_the_field",
           {{"class", sim::brightness_class(green)},
            {"ibc", number(sim::brightness_coefficient(green))},
            {"kilorayleigh_5577", green},
            {"lines", lines}}},
          {"power", power}};
}

ordered_json picture_json(const sim::BrightnessReport& report) {
  ordered_json picture;
  picture["lines"] = ordered_json::array();
  for (std::size_t l = 0; l < report.lines_nm.size(); ++l) {
    ordered_json line = {{"wavelength_nm", report.lines_nm[l]}, {"rayleigh", report.brightest[l].value}};
    add_place(report.brightest[l], line);
    picture["lines"].push_back(line);
  }
  const double luminance = report.most_luminous.value;
  ordered_json& spot = picture["most_luminous"];
  add_place(report.most_luminous, spot);
  spot["rayleigh"] = report.most_luminous.rayleigh;
  spot["luminance_cd_m2"] = luminance;
  spot["magnitudes_per_square_arcsecond"] = number(sim::magnitudes_per_square_arcsecond(luminance));
  spot["times_natural_sky"] = luminance / sim::kNaturalSky_cd_m2;
  spot["times_moonlit_white"] = luminance / sim::kMoonlitWhite_cd_m2;
  spot["eye"] = {{"vision", report.eye.vision},
                 {"cone_share", report.eye.cone_share},
                 {"above_eye_limit", report.eye.above_eye_limit}};
  return picture;
}

ordered_json sensor_json(const sim::BrightnessReport& report) {
  const sim::ExpectedCounts& counts = report.counts;
  ordered_json lines = ordered_json::array();
  for (const sim::LineCounts& line : counts.lines)
    lines.push_back({{"wavelength_nm", line.wavelength_nm},
                     {"electrons_per_kilorayleigh", line.electrons_per_kilorayleigh},
                     {"dn_per_kilorayleigh", line.dn_per_kilorayleigh},
                     {"saturation_kilorayleigh", number(line.saturation_kilorayleigh)}});
  ordered_json parts = ordered_json::array();
  for (const sim::UncertaintyPart& part : counts.parts)
    parts.push_back({{"name", part.name}, {"relative", part.relative}, {"source", part.source}});
  const sim::SpotCounts& spot = report.spot_counts;
  return {{"exposure", report.sensor_exposure},
          {"lines", lines},
          {"white_e", counts.white_e},
          {"saturation_e", counts.saturation_e},
          {"dn_per_electron", counts.dn_per_electron},
          {"black_dn", counts.black_dn},
          {"most_luminous",
           {{"electrons", spot.electrons},
            {"dn", spot.dn},
            {"signal_to_noise", spot.signal_to_noise},
            {"saturated", spot.saturated}}},
          {"relative_uncertainty",
           counts.relative_uncertainty ? ordered_json(*counts.relative_uncertainty) : ordered_json(nullptr)},
          {"uncertainty_parts", parts}};
}

}  // namespace

std::string brightness_text(const sim::BrightnessReport& report) {
  std::string text;
  for (std::size_t s = 0; s < report.sheets.size(); ++s)
    text += sheet_text(report.sheets[s], report.layers[s], report);
  text += picture_text(report);
  if (report.ground) text += ground_text(*report.ground);
  return text + sensor_text(report);
}

std::string brightness_json(const sim::BrightnessReport& report) {
  ordered_json json = {{"version", sim::version()}, {"exposure_s", report.exposure_s}};
  json["sheets"] = ordered_json::array();
  for (std::size_t s = 0; s < report.sheets.size(); ++s)
    json["sheets"].push_back(sheet_json(report.sheets[s], report.layers[s], report.lines_nm));
  json["picture"] = picture_json(report);
  if (report.ground)
    json["ground"] = {{"illuminance_lx", report.ground->lux()},
                      {"aurora_lx", report.ground->aurora_lx},
                      {"night_sky_lx", report.ground->night_sky_lx},
                      {"stars_lx", report.ground->stars_lx},
                      {"full_moons", report.ground->lux() / sim::kFullMoon_lx}};
  json["sensor"] = sensor_json(report);
  using Handler = ordered_json::error_handler_t;
  std::string text = json.dump(2, ' ', false, Handler::replace);
  // It goes to terminals too: what would act on one is written by its number.
  if (sim::shown_lines(text) != text) text = json.dump(2, ' ', true, Handler::replace);
  return text + "\n";
}

}  // namespace vegard::apps
