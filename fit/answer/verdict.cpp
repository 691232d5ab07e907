#include "fit/answer/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/answer/derived.h"
#include "sim/base/file/number_text.h"
#include "sim/base/text.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::fit {
namespace {

constexpr double kMinReducedChi2 = 0.3, kMaxReducedChi2 = 3.0;
constexpr double kMaxRms = 0.10;
constexpr double kIndependentPerParameter = 10.0;
constexpr double kMinGain = 0.5;              // of the chi2 that a dark sky leaves
constexpr double kIndependentForShape = 5.0;  // of numbers that do not depend on lateral offsets
constexpr double kStationaryGain = 0.25;      // of chi2 over the inflation squared: half a standard deviation
constexpr double kStationaryCosine =
    0.02;  // moving one parameter could take 0.04 % off chi2; a descent ends at 0.003 %
constexpr double kAtTheAnswer_sigma = 0.1;  // a start so near to the answer was one already
constexpr const char* kOneAnswerCheck = "one answer";
constexpr const char* kCorrelationCheck = "effective sample size";
constexpr double kNoRise = 1e-6;  // of chi2 at the start: rounding

/// Collects the checks and the reasons of the verdict.
class Checks {
 public:
  explicit Checks(FitResult& result) : result_(result) {
    result_.checks.clear();
    result_.reasons.clear();
  }

  /// The check passes if there are no objections; else the objections become reasons of the verdict.
  void add(const std::string& name, const std::string& found, const std::vector<std::string>& against) {
    result_.checks.push_back({name, against.empty(), against.empty() ? found : sim::joined(against, "; ")});
    result_.reasons.insert(result_.reasons.end(), against.begin(), against.end());
  }

  void add(const std::string& name, const std::string& found, bool passed, const std::string& against) {
    add(name, found, passed ? std::vector<std::string>() : std::vector<std::string>{against});
  }

 private:
  FitResult& result_;
};

std::string number_of(std::size_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

/// How the search ended, for a check that is called "converged" already and readers who do not know Ceres.
std::string words_of_end(const std::string& termination) {
  static const std::string kName = "converged";
  std::string words = termination.substr(0, termination.find(" (Ceres"));
  if (words.compare(0, kName.size(), kName) == 0) words.erase(0, words.find_first_not_of(": ", kName.size()));
  return words.empty() ? "the search ended" : words;
}

/// Whether the gradient vanishes: moving one parameter would reduce chi2 by a negligible share, or by less
/// than noise does.
bool is_stationary(const FitResult& r) {
  const double share = r.gradient_cosine * r.gradient_cosine;
  return r.gradient_cosine <= kStationaryCosine ||
         share * r.chi2 <= kStationaryGain * r.error_inflation * r.error_inflation;
}

/// Checks that the search converged to a minimum: chi2 decreased and its gradient vanishes.
void check_convergence(const FitResult& r, Checks& checks) {
  if (std::isfinite(r.chi2_initial) && r.chi2_initial > 0.0)
    checks.add("chi2 fell",
               fmt::format("from {} at the start to {}", sim::short_number(r.chi2_initial, 4),
                           sim::short_number(r.chi2, 4)),
               r.chi2 <= (1.0 + kNoRise) * r.chi2_initial,
               fmt::format("chi2 is {} and was {} at the start: the search diverged",
                           sim::short_number(r.chi2, 4), sim::short_number(r.chi2_initial, 4)));
  if (std::isfinite(r.gradient_cosine)) {
    const std::string share =
        fmt::format("{} %", sim::short_number(100.0 * r.gradient_cosine * r.gradient_cosine, 2));
    checks.add("gradient at the end",
               "moving any one parameter could take no more than " + share + " off chi2", is_stationary(r),
               "chi2 still falls at the end: moving one parameter could take " + share + " off it");
  }
}

/// Checks that the model explains the data within their errors.
void check_misfit(const Evidence& evidence, FitResult& r, Checks& checks) {
  const double reduced = r.dof > 0 ? r.chi2 / r.dof : 0.0;
  std::vector<std::string> against;
  if (reduced > kMaxReducedChi2)
    against.push_back(
        fmt::format("chi2 per degree of freedom is {:.2g}: the model misses something in the data", reduced));
  checks.add("chi2 per degree of freedom", fmt::format("{:.2f}", reduced), against);
  const double percent = 100.0 * r.rms_over_peak;
  // This holds for the profile, whether it is a compared statistic or not.
  if (std::isfinite(evidence.chi2_without_aurora))
    checks.add("rms residual", fmt::format("{:.1f} % of the profile's peak", percent),
               !(r.rms_over_peak > kMaxRms),
               fmt::format("the rms residual is {:.1f} % of the profile's peak", percent));
  const double independent = r.dof / std::max(1.0, r.correlated_residuals);
  const double unknowns =
      evidence.unknowns > 0.0 ? evidence.unknowns : static_cast<double>(r.parameters.size());
  r.independent_per_unknown = independent / std::max(1.0, unknowns);
  checks.add(
      kCorrelationCheck, fmt::format("{:.0f}", independent),
      independent >= kIndependentPerParameter * unknowns,
      fmt::format("the residuals are correlated: their effective sample size is {:.0f}; see where model "
                  "and photograph differ",
                  independent));
}

/// A sheet's length, its phase and its position along itself trade off where no end of it is in view. The
/// position across the line of sight is still constrained if the distance has an error bar.
bool is_constrained_by_ends_only(const FitResult& r, const FittedParameter& p) {
  for (const sim::Sheet& sheet : r.best.sheets) {
    const std::string of_sheet = "sheet." + sheet.name + ".";
    bool is_such = false;
    for (const char* key : {"length_km", "phase_rad", "center_km.east", "center_km.north"})
      is_such = is_such || p.path == of_sheet + key;
    if (!is_such) continue;
    return std::any_of(r.derived.begin(), r.derived.end(), [&](const DerivedNumber& d) {
      return d.name == "distance of the " + sheet.name + " sheet" && d.sigma;
    });
  }
  return false;
}

/// Ends that are out of view may be as far as the limits let them.
bool is_length_at_limit(const FittedParameter& p) {
  return p.at_limit && sim::ends_with(p.path, ".length_km");
}

/// Parameters that the data do not constrain and that leave all other results unaffected.
std::string unconstrained_parameters(const FitResult& r) {
  std::vector<std::string> names;
  for (const FittedParameter& p : r.parameters)
    if ((!p.sigma || is_length_at_limit(p)) && is_constrained_by_ends_only(r, p))
      names.push_back(sim::short_path(p.path, r.best.sheets.size() == 1));
  return sim::joined(names, ", ", " and ");
}

/// One sentence for each unconstrained direction, then the parameters without an error bar. The report gives
/// the reason of each.
std::vector<std::string> without_error_bar(const FitResult& r) {
  std::vector<std::string> names;
  std::size_t coefficients = 0;
  for (const FittedParameter& p : r.parameters) {
    if (p.sigma || is_constrained_by_ends_only(r, p)) continue;
    if (p.of_profile)
      ++coefficients;
    else
      names.push_back(sim::short_path(p.path, r.best.sheets.size() == 1));
  }
  if (coefficients > 0) names.push_back(number_of(coefficients, "coefficient") + " of free-form profiles");
  if (names.empty()) return {};
  std::vector<std::string> reasons = r.undetermined;
  reasons.push_back("no error bar for " + sim::joined(names, ", ", " and "));
  return reasons;
}

/// Checks that the data constrain every parameter.
void check_parameters(const FitResult& r, Checks& checks) {
  std::vector<std::string> at_limit, standing;
  std::size_t moved = 0;
  double furthest_sigma = 0.0;
  for (const FittedParameter& p : r.parameters) {
    moved += p.moved;
    // What has no error bar may wander without a change.
    if (p.moved) furthest_sigma = std::max(furthest_sigma, p.moved_sigma.value_or(0.0));
    if (p.at_limit && !(is_length_at_limit(p) && is_constrained_by_ends_only(r, p)))
      at_limit.push_back(p.path + " is at a limit");
    if (!p.moved && p.sigma)
      standing.push_back(p.path + " did not move from its start, though the data constrain it");
  }
  const bool started_at_answer = furthest_sigma <= kAtTheAnswer_sigma && is_stationary(r);
  if (started_at_answer) standing.clear();
  const std::string all = number_of(r.parameters.size(), "parameter");
  checks.add("moved",
             !started_at_answer ? fmt::format("{} of {}", moved, all)
             : moved == 0       ? "nothing: the start was the answer"
                                : "hardly: the start was the answer",
             standing);
  checks.add("inside the limits", all, at_limit);
  const std::string unconstrained = unconstrained_parameters(r);
  checks.add("error bars",
             unconstrained.empty() ? all : all + "; not constrained by the data: " + unconstrained,
             without_error_bar(r));
}

/// Checks of a fit that say how well the model explains the picture or how the search has ended. The others,
/// of limits and error bars, speak of single parameters.
constexpr const char* kChecksOfParameters[] = {"moved", "inside the limits", "error bars"};

/// Whether a number is good even if either of two answers may be the right one.
bool is_good_at_both(const DerivedNumber& number) {
  if (!number.at_other_mode || !number.error()) return false;
  const double difference = number.unit == "deg" ? std::remainder(*number.at_other_mode - number.value, 360.0)
                                                 : *number.at_other_mode - number.value;
  return trust_of(number.quantity, number.value, std::hypot(*number.error(), difference)) == Trust::good;
}

/// The first failed check of the whole fit that applies to a number, as text; empty if there is none.
/// Correlated residuals come from lateral offsets that the sheet does not follow. The error bars of numbers
/// that depend on the profile's shape allow for them, unless the effective sample size is too small.
std::string objection_to_fit(const FitResult& result, const DerivedNumber& number) {
  for (const Check& check : result.checks) {
    const auto is_name = [&](const char* name) { return check.name == name; };
    if (check.name == kOneAnswerCheck && is_good_at_both(number)) continue;
    if (check.name == kCorrelationCheck && !number.is_lateral &&
        result.independent_per_unknown >= kIndependentForShape)
      continue;
    if (check.passed || std::any_of(std::begin(kChecksOfParameters), std::end(kChecksOfParameters), is_name))
      continue;
    return check.words;
  }
  return {};
}

/// The first parameter at a limit that the number depends on.
std::string limit_it_depends_on(const FitResult& result, const DerivedNumber& number) {
  for (const FittedParameter& p : result.parameters)
    if (p.at_limit &&
        std::find(number.depends_on.begin(), number.depends_on.end(), p.path) != number.depends_on.end())
      return p.path;
  return {};
}

std::string error_words(const DerivedNumber& number) {
  const ErrorScale scale = error_scale(number.quantity);
  const auto words = [&](double error) {
    return scale.relative ? sim::short_number(100.0 * error / std::abs(number.value), 2) + " %"
                          : sim::short_number(error, 2) + " " + number.unit;
  };
  std::string text =
      "the standard error is " + words(*number.error()) + (scale.relative ? " of the value" : "");
  if (number.systematic)
    text += ": statistical " + words(*number.sigma) + ", by the fit's choices " + words(*number.systematic);
  return text;
}

void assess_quantity(const FitResult& result, DerivedNumber& d) {
  d.trust = Trust::unconstrained;
  if (!std::isfinite(d.value)) {
    d.trust_reason = d.why_none;
    return;
  }
  if (!d.sigma) {
    d.trust_reason = d.why_no_sigma;
    return;
  }
  if (result.verdict == Verdict::failed || result.verdict == Verdict::interrupted) {
    d.trust_reason = result.verdict == Verdict::failed ? "the fit has failed" : "the fit was interrupted";
    return;
  }
  d.trust = trust_of(d.quantity, d.value, *d.error());
  d.trust_reason = error_words(d);
  if (d.trust != Trust::good) return;
  const std::string against = objection_to_fit(result, d);
  const std::string limit = limit_it_depends_on(result, d);
  if (against.empty() && limit.empty()) return;
  d.trust = Trust::doubtful;
  d.trust_reason = !against.empty() ? against : "it depends on " + limit + ", which is at a limit";
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

void assess_fit(const Evidence& evidence, FitResult& result) {
  std::vector<std::string>& reasons = result.reasons;
  Checks checks(result);
  const double reduced = result.dof > 0 ? result.chi2 / result.dof : 0.0;
  if (!evidence.aurora_in_view && !evidence.stopped) {
    result.verdict = Verdict::failed;
    checks.add("light in view", "", false,
               "no light of the scene's " + sources_of(result.best) +
                   " falls into the region of interest: check where they are and where the camera points");
    result.verdict_line = "Do not believe it: " + reasons.front() + ".";
    return;
  }
  result.checks.push_back(
      {"converged", evidence.converged && !evidence.stopped, words_of_end(result.termination)});
  check_convergence(result, checks);
  check_misfit(evidence, result, checks);
  check_parameters(result, checks);
  if (!evidence.transfer_curve_words.empty())
    checks.add("transfer curve", evidence.transfer_curve_words, evidence.against_transfer_curve);
  for (const FittedRadar& radar : result.radars)
    checks.add("radar " + radar.name,
               fmt::format("its densities are explained: chi2 {} of {}", sim::short_number(radar.chi2, 3),
                           radar.values),
               !contradicts(radar),
               fmt::format("the densities of radar {} are not explained: chi2 {} of {}", radar.name,
                           sim::short_number(radar.chi2, 3), radar.values));
  const std::string light = light_noun(result.best);
  if (std::isfinite(evidence.chi2_without_aurora))
    checks.add(light + " or none",
               fmt::format("a sky without any {} has chi2 {}", light,
                           sim::short_number(evidence.chi2_without_aurora, 4)),
               !(result.chi2 > kMinGain * evidence.chi2_without_aurora),
               "a sky without any " + light + " explains the data almost as well");
  checks.add(kOneAnswerCheck, "no other end of the search explains the data as well", !evidence.second_mode,
             evidence.second_mode_text);

  if (evidence.stopped) {
    result.verdict = Verdict::interrupted;
    result.verdict_line = "Interrupted: the best point so far, not an answer.";
  } else if (!evidence.converged) {
    result.verdict = Verdict::failed;
    if (evidence.out_of_evaluations)
      reasons.insert(reasons.begin(), "the evaluations ran out (--max-evaluations)");
    result.verdict_line = "Do not believe it: the search did not converge" +
                          (reasons.empty() ? std::string() : "; " + sim::joined(reasons, "; ")) + ".";
  } else if (!reasons.empty()) {
    result.verdict = Verdict::doubtful;
    result.verdict_line = "Doubtful: " + sim::joined(reasons, "; ") + ".";
  } else {
    result.verdict = Verdict::good;
    result.verdict_line = fmt::format(
        "Believable: converged, chi2 per degree of freedom {:.2f}, rms residual {:.1f} % of the peak, every "
        "parameter determined and inside its limits{}.",
        reduced, 100.0 * result.rms_over_peak,
        unconstrained_parameters(result).empty()
            ? ""
            : ", but for " + unconstrained_parameters(result) + ", which the data do not constrain");
  }
  // Worth knowing, and nothing against the answer: error bars go by the residuals themselves.
  std::vector<std::string> notes = unusual_sheets(result.best);
  if (reduced < kMinReducedChi2)
    notes.push_back(fmt::format(
        "chi2 per degree of freedom is {:.2g}: fit.model_error is larger than what the model misses",
        reduced));
  reasons.insert(reasons.end(), notes.begin(), notes.end());
}

void assess_quantities(FitResult& result) {
  static const std::string kGoodAllTheSame = " Good all the same: ";
  std::string good;
  // Assessed again, it may be another one.
  result.verdict_line.erase(std::min(result.verdict_line.size(), result.verdict_line.find(kGoodAllTheSame)));
  for (DerivedNumber& d : result.derived) {
    assess_quantity(result, d);
    if (!d.is_detail && d.trust == Trust::good) good += (good.empty() ? "" : ", ") + d.name;
  }
  if (result.verdict == Verdict::doubtful && !good.empty())
    result.verdict_line += kGoodAllTheSame + good + ".";
}

}  // namespace vegard::fit
