#include "fit/report/table/run_comparison.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"

namespace vegard::fit {
namespace {

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
