#include "fit/report/table/mode_information_json.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "sim/light/tables/light_modes.h"

namespace vegard::fit {

nlohmann::ordered_json mode_information_json(const ModeInformation& told) {
  nlohmann::ordered_json json;
  const std::size_t count = told.modes.size();
  json["modes_sha256"] = told.tables;
  for (const int mode : told.modes) json["modes"].push_back(mode + 1);
  for (std::size_t i = 0; i < count; ++i)
    json["information"].push_back(
        std::vector<double>(told.information.begin() + static_cast<std::ptrdiff_t>(i * count),
                            told.information.begin() + static_cast<std::ptrdiff_t>((i + 1) * count)));
  json["towards"] = told.towards;
  for (const LineByModes& line : told.lines)
    json["lines"].push_back(
        {{"nm", line.wavelength_nm}, {"over_nm", line.over_nm}, {"ln_ratio_by_mode", line.ln_ratio}});
  return json;
}

nlohmann::ordered_json corrections_json(const std::vector<TablesCorrection>& corrections) {
  const auto number = [](double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
  };
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const TablesCorrection& c : corrections)
    json[fmt::format("{:.1f}", c.wavelength_nm)] = {{"over_nm", c.over_nm},
                                                    {"factor", number(c.factor)},
                                                    {"ln_sigma", number(c.ln_sigma)},
                                                    {"ln_sigma_of_tables", number(c.ln_sigma_of_tables)}};
  return json;
}

ModeInformation mode_information_of(const nlohmann::ordered_json& json) {
  ModeInformation told;
  told.tables = json.at("modes_sha256").get<std::string>();
  for (const int mode : json.at("modes").get<std::vector<int>>()) told.modes.push_back(mode - 1);
  for (const nlohmann::ordered_json& row : json.at("information"))
    for (const double value : row.get<std::vector<double>>()) told.information.push_back(value);
  told.towards = json.at("towards").get<std::vector<double>>();
  if (json.contains("lines"))
    for (const nlohmann::ordered_json& line : json.at("lines"))
      told.lines.push_back({line.at("nm").get<double>(), line.at("over_nm").get<double>(),
                            line.at("ln_ratio_by_mode").get<std::vector<double>>()});
  bool fits = true;
  for (const LineByModes& line : told.lines) fits = fits && line.ln_ratio.size() == told.modes.size();
  if (!fits || told.modes.size() > static_cast<std::size_t>(sim::kMaxLightModes) ||
      told.towards.size() != told.modes.size() ||
      told.information.size() != told.modes.size() * told.modes.size())
    throw nlohmann::json::other_error::create(501, "sizes that do not match", &json);
  return told;
}

}  // namespace vegard::fit
