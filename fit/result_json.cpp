#include "fit/result_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "fit/version.h"
#include "sim/base/version.h"

namespace vegard::fit {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no word for NaN or infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json parameter(const FittedParameter& p) {
  Json json;
  const std::string whose = " of " + p.photo;
  json["path"] = p.photo.empty() ? p.path : p.path.substr(0, p.path.size() - whose.size());
  if (!p.photo.empty()) json["photo"] = p.photo;
  json["meaning"] = p.meaning;
  json["value"] = number(p.value);
  json["unit"] = p.unit;
  json["sigma"] = number(p.sigma);
  if (p.interval68)
    json["interval68"] = {number(p.interval68->first), number(p.interval68->second)};
  else
    json["interval68"] = nullptr;
  json["why_no_sigma"] = p.sigma ? Json(nullptr) : Json(p.why_no_sigma);
  json["initial"] = number(p.initial);
  json["min"] = number(p.min);
  json["max"] = number(p.max);
  json["at_limit"] = p.at_limit;
  return json;
}

Json solved_numbers(const FittedPhoto& photo) {
  Json json = Json::array();
  for (const SolvedNumber& s : photo.solved)
    json.push_back({{"name", s.name}, {"value", number(s.value)}, {"sigma", number(s.sigma)}});
  return json;
}

/// Of several photographs: what is each one's own.
Json photos_of(const FitResult& result) {
  Json json = Json::array();
  for (const FittedPhoto& photo : result.photos)
    json.push_back({{"name", photo.name},
                    {"chi2", number(photo.chi2)},
                    {"rms_over_peak", number(photo.rms_over_peak)},
                    {"solved", solved_numbers(photo)},
                    {"decoding", photo.decoding}});
  return json;
}

}  // namespace

std::string result_json(const FitResult& result) {
  Json json;
  json["verdict"] = verdict_name(result.verdict);
  json["verdict_line"] = result.verdict_line;
  json["reasons"] = result.reasons;
  json["parameters"] = Json::array();
  for (const FittedParameter& p : result.parameters) json["parameters"].push_back(parameter(p));
  const bool several = result.photos.size() > 1;
  if (several)
    json["photos"] = photos_of(result);
  else
    json["solved"] = result.photos.empty() ? Json::array() : solved_numbers(result.photos.front());
  json["derived"] = Json::array();
  for (const DerivedNumber& d : result.derived)
    json["derived"].push_back(
        {{"name", d.name}, {"value", number(d.value)}, {"sigma", number(d.sigma)}, {"unit", d.unit}});
  json["correlation"] = Json::array();
  for (const std::vector<double>& row : result.correlation) {
    Json cells = Json::array();
    for (const double value : row) cells.push_back(number(value));
    json["correlation"].push_back(std::move(cells));
  }
  json["chi2"] = number(result.chi2);
  json["chi2_initial"] = number(result.chi2_initial);
  json["dof"] = result.dof;
  json["rms_over_peak"] = number(result.rms_over_peak);
  json["error_inflation"] = number(result.error_inflation);
  json["termination"] = result.termination;
  json["evaluations"] = result.evaluations;
  json["jacobian_evaluations"] = result.jacobian_evaluations;
  json["seed"] = result.seed;
  json["version"] = sim::version();
  json["libraries"] = {
      {"ceres", ceres_version()}, {"opencv", opencv_version()}, {"eigen", sim::eigen_version()}};
  json["command"] = result.command;
  json["inputs"] = Json::array();
  for (const InputFile& input : result.inputs)
    json["inputs"].push_back({{"role", input.role}, {"name", input.name}, {"sha256", input.sha256}});
  if (!several) json["decoding"] = result.photos.empty() ? "" : result.photos.front().decoding;
  // A file's name may hold bytes that are no UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace vegard::fit
