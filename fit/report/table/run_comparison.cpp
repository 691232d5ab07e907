#include "fit/report/table/run_comparison.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "fit/report/table/result_json.h"
#include "sim/base/error.h"
#include "sim/base/file/input_file.h"

namespace vegard::fit {
namespace {

using Json = nlohmann::ordered_json;

sim::Error unreadable(const std::string& file, const std::string& problem, const std::string& hint) {
  return sim::Error(sim::ErrorKind::unreadable_input, problem)
      .file(file)
      .expected("the result.json of a run")
      .hint(hint);
}

/// Throws Json::exception.
RunSummary run_summary_of(const Json& json) {
  RunSummary run;
  run.verdict = json.at("verdict").get<std::string>();
  for (const Json& p : json.at("parameters")) {
    RunSummary::Parameter parameter;
    parameter.value = p.at("value").is_null() ? std::nan("") : p.at("value").get<double>();
    if (!p.at("sigma").is_null()) parameter.sigma = p.at("sigma").get<double>();
    parameter.unit = p.at("unit").get<std::string>();
    run.paths.push_back(p.at("path").get<std::string>());
    run.parameters[run.paths.back()] = parameter;
  }
  run.chi2 = json.at("chi2").get<double>();
  run.dof = json.at("dof").get<int>();
  run.correlated_residuals = json.at("correlated_residuals").get<double>();
  for (const Json& input : json.at("inputs"))
    if (const std::string role = input.at("role").get<std::string>(); role != "scene")
      run.pictures.push_back({role, input.at("sha256").get<std::string>()});
  if (json.contains("decoding"))
    run.decoding = json.at("decoding").get<std::string>();
  else  // several photographs have one each
    for (const Json& photo : json.at("photos"))
      run.decoding += (run.decoding.empty() ? "" : "; ") + photo.at("name").get<std::string>() + ": " +
                      photo.at("decoding").get<std::string>();
  const Json& compared = json.at("compared");
  run.regions_px = compared.at("regions_px").get<std::vector<std::array<int, 4>>>();
  run.values = compared.at("values").get<int>();
  run.sum_of_weights = compared.at("sum_of_weights").get<double>();
  run.sampling_error = compared.at("sampling_error").get<double>();
  run.unknowns = compared.at("unknowns").get<int>();
  return run;
}

constexpr double kAlikeSampling = 1.5, kMinSampling = 5e-3;
constexpr double kSameWeights = 1e-9;  // of the sum: rounding

FittedModel model_of(const RunSummary& run) {
  FittedModel model;
  model.name = run.name;
  model.chi2 = run.chi2;
  model.values = run.values;
  model.parameters = run.unknowns;
  model.correlated = run.correlated_residuals;
  return model;
}

/// What makes two runs ones of different data; empty if nothing does.
std::string difference(const RunSummary& a, const RunSummary& b) {
  if (a.pictures != b.pictures) return "another photograph or mask";
  if (a.decoding != b.decoding) return "another decoding of the photograph";
  if (a.regions_px != b.regions_px) return "another fit.roi_px";
  if (a.values != b.values) return "another number of values (fit.bands, say)";
  if (std::abs(a.sum_of_weights - b.sum_of_weights) > kSameWeights * a.sum_of_weights)
    return "other weights (fit.model_error, say)";
  // It is in the weights, and chi2 of unlike weights say nothing of the models.
  if (std::max(a.sampling_error, b.sampling_error) >
      kAlikeSampling * std::max(kMinSampling, std::min(a.sampling_error, b.sampling_error)))
    return "a model sampled far better or worse (sheet beams, say)";
  return {};
}

void require_same_data(const std::vector<RunSummary>& runs) {
  for (const RunSummary& run : runs) {
    const std::string problem = difference(runs.front(), run);
    if (problem.empty()) continue;
    throw sim::Error(sim::ErrorKind::usage, "cannot be compared with " + runs.front().name + ": " + problem)
        .file(run.name)
        .hint("fit both scenes to the same photograph with the same [fit], but for what is free");
  }
}

}  // namespace

RunSummary read_run(const std::string& directory) {
  const std::string file = directory + "/result.json";
  const sim::InputFile text = sim::read_input(file, kMaxResultBytes);
  if (!text.problem.empty()) throw unreadable(file, text.problem, "is that the directory of a run?");
  const Json json = Json::parse(text.bytes, nullptr, false);
  if (!json.is_object()) throw unreadable(file, "is no JSON", "");
  try {
    RunSummary run = run_summary_of(json);
    run.name = directory;
    while (run.name.size() > 1 && run.name.back() == '/') run.name.pop_back();
    return run;
  } catch (const Json::exception&) {
    throw unreadable(file, "lacks what a comparison needs", "fit it again with this version");
  }
}

RunComparison compared(const std::vector<RunSummary>& runs) {
  require_same_data(runs);
  RunComparison comparison;
  const auto richest =
      std::max_element(runs.begin(), runs.end(),
                       [](const RunSummary& a, const RunSummary& b) { return a.unknowns < b.unknowns; });
  const ChiSquareScaling scaling = chi2_scaling_of(model_of(*richest));
  for (const RunSummary& run : runs)
    comparison.runs.push_back({run, information_criteria(model_of(run), scaling), 0.0, 0.0});
  double min_aic = comparison.runs.front().criteria.aic;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    min_aic = std::min(min_aic, comparison.runs[i].criteria.aic);
    if (comparison.runs[i].criteria.bic < comparison.runs[comparison.best].criteria.bic) comparison.best = i;
  }
  comparison.independent_values = comparison.runs.front().criteria.values;
  const ComparedRun best = comparison.runs[comparison.best];
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    comparison.runs[i].bic_difference = comparison.runs[i].criteria.bic - best.criteria.bic;
    comparison.runs[i].aic_difference = comparison.runs[i].criteria.aic - min_aic;
    if (i != comparison.best)
      comparison.sentences.push_back(compared_in_words(model_of(best.run), model_of(runs[i])));
  }
  return comparison;
}

}  // namespace vegard::fit
