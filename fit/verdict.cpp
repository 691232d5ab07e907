#include "fit/verdict.h"

#include <fmt/format.h>

#include <algorithm>

#include "fit/derived.h"

namespace vegard::fit {
namespace {

constexpr double kLeastChi2 = 0.3, kMostChi2 = 3.0;
constexpr double kMostRms = 0.10;
constexpr double kIndependentPerParameter = 10.0;
constexpr double kLeastGain = 0.5;  // of the chi2 that a dark sky leaves

std::string joined(const std::vector<std::string>& reasons) {
  std::string text;
  for (const std::string& reason : reasons) text += (text.empty() ? "" : "; ") + reason;
  return text;
}

}  // namespace

const char* verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::good:
      return "good";
    case Verdict::doubtful:
      return "doubtful";
    case Verdict::failed:
      return "failed";
    case Verdict::interrupted:
      return "interrupted";
  }
  return "";
}

void judge(const Evidence& evidence, FitResult& result) {
  std::vector<std::string>& reasons = result.reasons;
  reasons.clear();
  const double reduced = result.dof > 0 ? result.chi2 / result.dof : 0.0;
  if (!evidence.aurora_in_view && !evidence.stopped) {
    result.verdict = Verdict::failed;
    reasons.push_back(
        "no light of the scene's sheets falls into the region of interest: check where the sheets "
        "are and where the camera points");
    result.verdict_line = "Do not believe it: " + reasons.front() + ".";
    return;
  }
  if (reduced > kMostChi2)
    reasons.push_back(
        fmt::format("chi2 per degree of freedom is {:.2g}: the model misses something in the data", reduced));
  if (reduced < kLeastChi2)
    reasons.push_back(
        fmt::format("chi2 per degree of freedom is {:.2g}: fit.model_error is larger than what the model "
                    "misses, so chi2 proves little",
                    reduced));
  if (result.rms_over_peak > kMostRms)
    reasons.push_back(
        fmt::format("the rms residual is {:.1f} % of the profile's peak", 100.0 * result.rms_over_peak));
  const double together = result.error_inflation * result.error_inflation / std::max(1.0, reduced);
  const double independent = result.dof / std::max(1.0, together);
  const double unknowns =
      evidence.unknowns > 0.0 ? evidence.unknowns : static_cast<double>(result.parameters.size());
  if (independent < kIndependentPerParameter * unknowns)
    reasons.push_back(
        fmt::format("the residuals form patterns, worth no more than {:.0f} independent values: see where "
                    "model and photograph differ",
                    independent));
  for (const FittedParameter& p : result.parameters) {
    if (p.at_limit) reasons.push_back(p.path + " is at a limit");
    if (!p.sigma) reasons.push_back(p.path + " has no error bar: " + p.why_no_sigma);
  }
  if (result.chi2 > kLeastGain * evidence.chi2_without_aurora)
    reasons.push_back("a sky without any aurora explains the data almost as well");
  if (evidence.second_mode) reasons.push_back(evidence.second_mode_text);

  if (evidence.stopped) {
    result.verdict = Verdict::interrupted;
    result.verdict_line = "Interrupted: the best point so far, not an answer.";
  } else if (!evidence.converged) {
    result.verdict = Verdict::failed;
    if (evidence.out_of_evaluations)
      reasons.insert(reasons.begin(), "the evaluations ran out (--max-evaluations)");
    result.verdict_line = "Do not believe it: the search did not converge" +
                          (reasons.empty() ? std::string() : "; " + joined(reasons)) + ".";
  } else if (!reasons.empty()) {
    result.verdict = Verdict::doubtful;
    result.verdict_line = "Doubtful: " + joined(reasons) + ".";
  } else {
    result.verdict = Verdict::good;
    result.verdict_line = fmt::format(
        "Believable: converged, chi2 per degree of freedom {:.2f}, rms residual {:.1f} % of the peak, every "
        "parameter determined and inside its limits.",
        reduced, 100.0 * result.rms_over_peak);
  }
  const std::vector<std::string> notes = unusual_sheets(result.best);
  reasons.insert(reasons.end(), notes.begin(), notes.end());
}

}  // namespace vegard::fit
