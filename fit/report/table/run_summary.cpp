#include "fit/report/table/run_summary.h"

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

}  // namespace vegard::fit
