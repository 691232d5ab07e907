#include "fit/report/table/result_json.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "fit/answer/result_numbers.h"
#include "fit/report/table/curtain_steps_table.h"
#include "fit/report/table/mode_information_json.h"
#include "fit/version.h"
#include "sim/base/version.h"
#include "sim/scene/table/parameter_table.h"

namespace vegard::fit {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no word for NaN or infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json words(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

void put_by_mode(const std::vector<double>& by_mode, Json& json) {
  if (by_mode.empty()) return;
  for (const double change : by_mode) json["by_mode"].push_back(number(change));
}

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
  json["moved"] = p.moved;
  json["moved_sigma"] = number(p.moved_sigma);
  json["by_bands"] = number(p.by_bands);
  put_by_mode(p.by_mode, json);
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
                    {"model_error", number(photo.model_error)},
                    {"solved", solved_numbers(photo)},
                    {"decoding", photo.decoding}});
  return json;
}

Json pair(const std::pair<double, double>& interval) {
  return Json::array({number(interval.first), number(interval.second)});
}

Json matrix_rows(const std::vector<std::vector<double>>& matrix) {
  Json json = Json::array();
  for (const std::vector<double>& row : matrix) {
    Json cells = Json::array();
    for (const double value : row) cells.push_back(number(value));
    json.push_back(std::move(cells));
  }
  return json;
}

/// One entry for each parameter, from vectors in their order.
Json by_parameter(const FitResult& result, const std::function<void(std::size_t, Json&)>& fill) {
  Json json = Json::array();
  for (std::size_t j = 0; j < result.parameters.size(); ++j) {
    Json entry;
    entry["path"] = result.parameters[j].path;
    fill(j, entry);
    json.push_back(std::move(entry));
  }
  return json;
}

Json profile_intervals(const FitResult& result) {
  Json json = Json::array();
  for (const ProfiledInterval& p : result.profile_intervals) {
    Json entry;
    entry["path"] = result.parameters[p.parameter].path;
    entry["interval68"] = Json::array({number(p.lower68), number(p.upper68)});
    entry["interval95"] = Json::array({number(p.lower95), number(p.upper95)});
    entry["whole"] = p.whole;
    entry["found_better"] = p.found_better;
    entry["rise"] = Json::array();
    for (const double rise : p.rise) entry["rise"].push_back(number(rise));
    entry["values"] = matrix_rows(p.values);
    json.push_back(std::move(entry));
  }
  return json;
}

Json bootstrap(const FitResult& result) {
  const BootstrapErrors& b = *result.bootstrap;
  Json json;
  json["bands"] = b.bands;
  json["replicates"] = b.replicates;
  json["failed"] = b.failed;
  json["refitted"] = b.refitted;
  json["parameters"] = by_parameter(result, [&](std::size_t j, Json& entry) {
    if (j >= b.sigma.size()) return;
    entry["sigma"] = number(b.sigma[j]);
    entry["interval68"] = pair(b.interval68[j]);
    entry["interval95"] = pair(b.interval95[j]);
  });
  json["correlation"] = matrix_rows(b.correlation);
  return json;
}

/// Without the samples, which would be megabytes.
Json chain(const FitResult& result) {
  const ChainErrors& c = *result.chain;
  Json json;
  json["walkers"] = c.walkers;
  json["burn_in"] = c.burn_in;
  json["steps"] = c.steps;
  json["acceptance"] = number(c.acceptance);
  json["long_enough"] = c.long_enough;
  json["parameters"] = by_parameter(result, [&](std::size_t j, Json& entry) {
    if (j >= c.sigma.size()) return;
    entry["median"] = number(c.median[j]);
    entry["sigma"] = number(c.sigma[j]);
    entry["interval68"] = pair(c.interval68[j]);
    entry["interval95"] = pair(c.interval95[j]);
    entry["autocorrelation_steps"] = number(c.autocorrelation_steps[j]);
    entry["effective_samples"] = number(c.effective[j]);
    if (j < c.r_hat.size()) entry["r_hat"] = number(c.r_hat[j]);
  });
  json["correlation"] = matrix_rows(c.correlation);
  return json;
}

Json numbers(const std::vector<double>& list) {
  Json json = Json::array();
  for (const double value : list) json.push_back(number(value));
  return json;
}

Json radars(const FitResult& result) {
  Json json = Json::array();
  for (const FittedRadar& radar : result.radars)
    json.push_back({{"name", radar.name},
                    {"chi2", number(radar.chi2)},
                    {"values", radar.values},
                    {"scale", number(radar.scale)},
                    {"scale_sigma", number(radar.scale_sigma)},
                    {"time_s", number(radar.time_s)},
                    {"foot_latitude_deg", number(radar.foot_latitude_deg)},
                    {"foot_longitude_deg", number(radar.foot_longitude_deg)},
                    {"energy_flux_mw_m2", number(radar.energy_flux_mw_m2)},
                    {"energy_kev", number(radar.energy_kev)},
                    {"altitude_km", numbers(radar.altitude_km)},
                    {"density_cm3", numbers(radar.density_cm3)},
                    {"density_cm3_error", numbers(radar.sigma_cm3)},
                    {"electrons_cm3", numbers(radar.electrons_cm3)},
                    {"model_cm3", numbers(radar.model_cm3)}});
  return json;
}

/// By wavelength.
Json transfer_curve_json(const FittedTransferCurve& c) {
  Json json;
  json["words"] = c.words;
  json["decoding"] = c.decoding_word;
  json["exponents"] = Json::array();
  for (const FittedTransferCurve::Exponent& e : c.exponents)
    json["exponents"].push_back({{"name", e.name},
                                 {"value", number(e.value)},
                                 {"sigma", number(e.sigma)},
                                 {"at_limit", e.at_limit},
                                 {"undetermined", e.undetermined}});
  if (c.exponents.size() > 1) json["correlation"] = number(c.correlation);
  json["limits"] = {number(c.least), number(c.most)};
  json["trials"] = matrix_rows(c.trials);
  return json;
}

Json stability(const FitResult& result) {
  Json json = Json::array();
  for (const StabilityRow& row : *result.stability) {
    Json entry = {{"choice", row.choice},          {"name", row.name},
                  {"problem", words(row.problem)}, {"chi2_per_dof", number(row.chi2_per_dof)},
                  {"is_refuted", row.is_refuted},  {"shifts", Json::object()}};
    for (std::size_t i = 0; i < row.derived.size(); ++i)
      entry["shifts"][result.derived[i].name] = number(row.derived[i].by);
    json.push_back(std::move(entry));
  }
  return json;
}

Json curtain_steps(const FitResult& result) {
  Json json = Json::array();
  for (const CurtainStep& step : result.curtain_steps)
    json.push_back({{"change", change_name(step.change)},
                    {"curve", words(step.curtain)},
                    {"curves", step.curtains},
                    {"chi2", number(step.chi2)},
                    {"values", step.values},
                    {"unknowns", step.unknowns},
                    {"bic_lower_by", number(step.bic_lower_by)},
                    {"kept", step.kept},
                    {"words", curtain_step_in_words(step)}});
  return json;
}

void put_numbers(const FitResult& result, ResultGroup group, Json& json) {
  for (const ResultNumber& row : result_numbers()) {
    if (row.group != group || (row.applies != nullptr && !row.applies(result))) continue;
    const std::optional<double> value = row.value(result);
    if (row.form == ResultForm::count && value)
      json[row.key] = static_cast<int>(*value);
    else
      json[row.key] = number(value);
  }
}

}  // namespace

std::string result_json(const FitResult& result) {
  Json json;
  json["verdict"] = verdict_name(result.verdict);
  json["verdict_line"] = result.verdict_line;
  json["reasons"] = result.reasons;
  json["checks"] = Json::array();
  for (const Check& check : result.checks)
    json["checks"].push_back({{"name", check.name}, {"passed", check.passed}, {"words", check.words}});
  json["parameters"] = Json::array();
  for (const FittedParameter& p : result.parameters) json["parameters"].push_back(parameter(p));
  json["tied"] = Json::array();
  for (const TiedNumber& t : result.tied)
    json["tied"].push_back({{"path", t.path},
                            {"meaning", t.meaning},
                            {"value", number(t.value)},
                            {"unit", t.unit},
                            {"sigma", number(t.sigma)},
                            {"equals", t.equals}});
  const bool several = result.photos.size() > 1;
  if (several)
    json["photos"] = photos_of(result);
  else
    json["solved"] = result.photos.empty() ? Json::array() : solved_numbers(result.photos.front());
  json["derived"] = Json::array();
  for (const DerivedNumber& d : result.derived) {
    json["derived"].push_back({{"name", d.name},
                               {"value", number(d.value)},
                               {"sigma", number(d.sigma)},
                               {"systematic", number(d.systematic)},
                               {"unit", d.unit},
                               {"why_none", words(d.why_none)},
                               {"why_no_sigma", words(d.why_no_sigma)},
                               {"trust", trust_name(d.trust)},
                               {"trust_reason", words(d.trust_reason)}});
    put_by_mode(d.by_mode, json["derived"].back());
  }
  if (!result.tables.empty()) json["tables"] = corrections_json(result.tables);
  if (!result.physics.modes.empty()) json["physics"] = mode_information_json(result.physics);
  if (!result.radars.empty()) json["radars"] = radars(result);
  if (result.transfer_curve) json["curve"] = transfer_curve_json(*result.transfer_curve);
  json["correlation"] = matrix_rows(result.correlation);
  if (!result.trade_offs.empty()) json["trade_offs"] = result.trade_offs;
  if (!result.undetermined.empty()) json["undetermined"] = result.undetermined;
  if (!result.profile_intervals.empty()) json["profile_intervals"] = profile_intervals(result);
  if (result.bootstrap) json["bootstrap"] = bootstrap(result);
  if (result.chain) json["chain"] = chain(result);
  if (result.stability) json["stability"] = stability(result);
  if (result.validation_interrupted) json["validation_interrupted"] = true;
  if (!result.curtain_steps.empty()) json["curve_steps"] = curtain_steps(result);
  put_numbers(result, ResultGroup::misfit, json);
  json["compared"] = {
      {"regions_px", result.compared.regions_px},
      {"values", result.compared.values},
      {"sum_of_weights", number(result.compared.sum_of_weights)},
      {"sampling_error", number(result.compared.sampling_error)},
      {"model", sim::word_of(result.compared.draws ? sim::FitModel::draws : sim::FitModel::expected)},
      {"unknowns", result.compared.unknowns}};
  put_numbers(result, ResultGroup::convergence, json);
  json["statistics"] = Json::array();
  for (const ComparedStatistic& s : result.statistics)
    json["statistics"].push_back({{"name", s.name},
                                  {"weight", number(s.weight)},
                                  {"residuals", s.residuals},
                                  {"chi2", number(s.chi2)}});
  put_numbers(result, ResultGroup::errors, json);
  json["termination"] = result.termination;
  put_numbers(result, ResultGroup::effort, json);
  json["seed"] = result.seed;
  json["version"] = sim::version();
  json["libraries"] = {
      {"ceres", ceres_version()}, {"opencv", opencv_version()}, {"eigen", sim::eigen_version()}};
  json["command"] = result.command;
  json["inputs"] = Json::array();
  for (const InputFile& input : result.inputs)
    json["inputs"].push_back({{"role", input.role}, {"name", input.name}, {"sha256", input.sha256}});
  for (const PhotoFact& fact : result.from_photograph)
    json["from_photograph"].push_back({{"path", fact.path}, {"value", fact.value}, {"source", fact.source}});
  if (!several) json["decoding"] = result.photos.empty() ? "" : result.photos.front().decoding;
  // A file's name may hold bytes that are no UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace vegard::fit
