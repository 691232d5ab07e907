#include <cmath>

#include <nlohmann/json.hpp>

#include "apps/brightness_report.h"
#include "sim/base/version.h"
#include "sim/view/sky/night_luminances.h"

namespace vegard::apps {
namespace {

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

ordered_json picture_json(const BrightnessReport& report) {
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

ordered_json sensor_json(const BrightnessReport& report) {
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
  const SpotCounts& spot = report.spot_counts;
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

std::string brightness_json(const BrightnessReport& report) {
  ordered_json json = {{"version", sim::version()}, {"exposure_s", report.exposure_s}};
  json["sheets"] = ordered_json::array();
  for (std::size_t s = 0; s < report.sheets.size(); ++s)
    json["sheets"].push_back(sheet_json(report.sheets[s], report.layers[s], report.lines_nm));
  json["picture"] = picture_json(report);
  json["sensor"] = sensor_json(report);
  return json.dump(2) + "\n";
}

}  // namespace vegard::apps
