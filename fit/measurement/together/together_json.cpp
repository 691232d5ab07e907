#include <cmath>

#include <nlohmann/json.hpp>

#include "fit/measurement/main_border.h"
#include "fit/measurement/together/measure_together.h"
#include "fit/triangulation/map_marks.h"
#include "sim/base/number/constants.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace together_numbers {

using Json = nlohmann::ordered_json;

Json height_json(const std::optional<PairHeight>& height) {
  if (!height) return nullptr;
  return {{"height_km", height->km},
          {"height_error_km", height->error_km},
          {"by", height->is_by_profiles ? "profiles" : "borders"},
          {"doubts", height->doubts}};
}

Json value_json(const WithError& number) {
  return {{"value", number_or_null(number.value)}, {"error", number_or_null(number.error)}};
}

Json curtain_json(const std::optional<MainCurtain>& curtain) {
  if (!curtain) return nullptr;
  return {{"distance_km", value_json(curtain->distance_km)},
          {"lower_border_km", value_json(curtain->lower_border_km)},
          {"energy_kev", value_json(curtain->energy_kev)},
          {"is_along_border", curtain->is_along_border}};
}

Json map_json(const JointMap& map, const std::vector<Contradiction>& contradictions) {
  Json json = {{"pictures", Json::array()},
               {"missing", map.missing.empty() ? Json(nullptr) : Json(map.missing)},
               {"command", map.command}};
  for (const std::size_t i : map.pictures) json["pictures"].push_back(i + 1);
  if (!map.missing.empty() || map.is_interrupted) return json;
  json["is_good"] = map.is_good;
  json["chi2_per_value"] = map.chi2_per_value;
  json["distance_from_picture"] = map.home + 1;
  json["main_curtain"] = curtain_json(map.curtain);
  json["nearest_km"] = value_json(map.nearest_km);
  json["contradictions"] = Json::array();
  for (const Contradiction& c : contradictions)
    json["contradictions"].push_back({{"quantity", c.quantity},
                                      {"geometry_km", value_json(c.geometry_km)},
                                      {"map_km", value_json(c.map_km)}});
  return json;
}

}  // namespace together_numbers

std::string together_json(const TogetherMeasurement& m) {
  using namespace together_numbers;
  Json json = {{"kind", "vegard measure, several"},
               {"version", sim::version()},
               {"command", m.command},
               {"trust", trust_name(m.trust)},
               {"word", m.word},
               {"answer", m.answer}};
  if (m.is_map_interrupted) json["interrupted"] = true;
  json["pictures"] = Json::array();
  for (std::size_t i = 0; i < m.alone.size(); ++i) {
    const Measurement& one = m.alone[i];
    Json alone = {{"photo", one.photo}, {"trust", trust_name(one.trust)}, {"answer", one.answer}};
    if (one.main_border)
      alone["main_border"] = {{"azimuth_deg", one.main_border->azimuth_deg},
                              {"distance_km", number_or_null(one.main_border->distance_km)},
                              {"distance_error_km", number_or_null(one.main_border->distance_error_km)}};
    if (one.main_curtain) alone["main_curtain"] = curtain_json(one.main_curtain);
    const ClockOffset& clock = m.clocks.offsets[i];
    alone["clock_offset_s"] = std::round(1e3 * clock.s) / 1e3 + 0.0;  // no negative zero
    alone["clock_offset_error_s"] = clock.error_s;
    alone["clock_offset_is_told"] = clock.is_told;
    json["pictures"].push_back(std::move(alone));
  }
  json["border"] = height_json(m.common_border);
  if (m.joint_map) json["map"] = map_json(*m.joint_map, m.contradictions);
  json["pairs"] = Json::array();
  for (const PairOfPictures& pair : m.pairs) {
    Json one = {{"pictures", {pair.first + 1, pair.second + 1}},
                {"refusal", pair.refusal.empty() ? Json(nullptr) : Json(pair.refusal)},
                {"base_km", number_or_null(pair.base_km)},
                {"base_azimuth_deg", number_or_null(pair.base_azimuth_deg)},
                {"apart_s", number_or_null(pair.apart_s)},
                {"exposures_differ_s", 2.0 * pair.exposures_s},
                {"shared_share", number_or_null(pair.shared_share)},
                {"border", nullptr},
                {"peak", nullptr}};
    if (pair.refusal.empty()) {
      one["border"] = height_json(height_of(pair));
      one["peak"] = height_json(peak_of(pair));
      const CrossCheck check = cross_check(pair, m.alone[pair.first], m.alone[pair.second]);
      one["cross_check"] = {
          {"points", check.compared}, {"covered", check.covered}, {"sentence", check.sentence}};
    }
    one["borders"] = Json::array();
    for (const BorderMatch& match : pair.borders.matches) {
      const MeanHeight& mean = match.branch.mean;
      one["borders"].push_back({{"traces", {match.first_trace + 1, match.second_trace + 1}},
                                {"height_km", number_or_null(mean.km)},
                                {"height_error_km", number_or_null(mean.error_km)},
                                {"common_error_km", number_or_null(mean.common_error_km)},
                                {"level_error_km", match.level_error_km},
                                {"scatter_km", number_or_null(mean.scatter_km)},
                                {"points", mean.points},
                                {"share", match.branch.share},
                                {"weight", match.weight}});
    }
    one["densest_light"] = Json::array();
    if (pair.pattern)
      for (const ShellHeight& height : pair.pattern->heights)
        one["densest_light"].push_back({{"height_km", height.km},
                                        {"height_error_km", height.error_km},
                                        {"correlation", height.correlation},
                                        {"weight", height.weight}});
    if (pair.profiles.is_given()) {
      const ProfileMatch& found = pair.profiles;
      const double peak_or_none_km = pair.is_peak_cut ? sim::kNaN : found.profiles.peak_above_km;
      one["profiles"] = {
          {"border_km", found.border_km},
          {"border_error_km", std::sqrt(found.covariance_km2(0, 0))},
          {"level_error_km", found.level_error_km},
          {"across_km", found.across_km},
          {"across_error_km", std::sqrt(found.covariance_km2(1, 1))},
          {"border_km_per_km", found.border_km_per_km},
          {"peak_above_km", number_or_null(peak_or_none_km)},
          {"peak_above_error_km",
           pair.is_peak_cut ? Json(nullptr) : number_or_null(found.profiles.peak_above_error_km)},
          {"correlation", found.correlation},
          {"alike", found.alike},
          {"weight", found.weight},
          {"with_clocks_km", number_or_null(pair.clocks.border_km)},
          {"with_clocks_error_km", number_or_null(pair.clocks.border_error_km)}};
    }
    json["pairs"].push_back(std::move(one));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace vegard::fit
