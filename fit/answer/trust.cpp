#include "fit/answer/trust.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "fit/answer/fit_result.h"
#include "sim/base/file/number_text.h"

namespace vegard::fit {
namespace {

/// Checks of a fit that say how well the model explains the picture or how the search has ended. The others,
/// of limits and error bars, speak of single parameters.
constexpr const char* kChecksOfParameters[] = {"moved", "inside the limits", "error bars"};

/// The first check of the whole that was not passed, in words; empty if there is none.
std::string against_the_whole(const FitResult& result) {
  for (const Check& check : result.checks) {
    const auto is_name = [&](const char* name) { return check.name == name; };
    if (check.passed || std::any_of(std::begin(kChecksOfParameters), std::end(kChecksOfParameters), is_name))
      continue;
    return check.words;
  }
  return {};
}

/// The first parameter at a limit that the number depends on.
std::string limit_it_leans_on(const FitResult& result, const DerivedNumber& number) {
  for (const FittedParameter& p : result.parameters)
    if (p.at_limit &&
        std::find(number.depends_on.begin(), number.depends_on.end(), p.path) != number.depends_on.end())
      return p.path;
  return {};
}

std::string error_words(const DerivedNumber& number) {
  const ErrorScale scale = error_scale(number.quantity);
  if (scale.relative)
    return fmt::format("the standard error is {} % of the value",
                       sim::short_number(100.0 * *number.sigma / std::abs(number.value), 2));
  return fmt::format("the standard error is {} {}", sim::short_number(*number.sigma, 2), number.unit);
}

void judge_one(const FitResult& result, const std::string& against, DerivedNumber& d) {
  d.trust = Trust::not_told;
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
  d.trust = trust_of(d.quantity, d.value, *d.sigma);
  d.trust_reason = error_words(d);
  if (d.trust != Trust::good) return;
  const std::string limit = limit_it_leans_on(result, d);
  if (against.empty() && limit.empty()) return;
  d.trust = Trust::doubtful;
  d.trust_reason = !against.empty() ? against : "it depends on " + limit + ", which is at a limit";
}

}  // namespace

const char* trust_name(Trust trust) {
  switch (trust) {
    case Trust::good:
      return "good";
    case Trust::doubtful:
      return "doubtful";
    case Trust::not_told:
      return "not told";
  }
  return "";
}

ErrorScale error_scale(Quantity kind) {
  switch (kind) {
    case Quantity::distance:
      return {true, 0.05, 0.2};
    case Quantity::energy:
      return {true, 0.15, 0.5};
    case Quantity::energy_flux:
      return {true, 0.35, 1.0};
    case Quantity::altitude:
      return {false, 3.0, 10.0};
    case Quantity::place:
      return {false, 0.3, 1.5};
    case Quantity::azimuth:
      return {false, 3.0, 15.0};
    case Quantity::width:
    case Quantity::ratio:
    case Quantity::other:
      break;
  }
  return {true, 0.25, 0.7};
}

Trust trust_of(Quantity kind, double value, double error) {
  const ErrorScale scale = error_scale(kind);
  const double size = scale.relative ? error / std::abs(value) : error;
  if (!(size < scale.none)) return Trust::not_told;
  return size <= scale.good ? Trust::good : Trust::doubtful;
}

void judge_quantities(FitResult& result) {
  const std::string against = against_the_whole(result);
  std::string good;
  for (DerivedNumber& d : result.derived) {
    judge_one(result, against, d);
    if (!d.is_detail && d.trust == Trust::good) good += (good.empty() ? "" : ", ") + d.name;
  }
  if (result.verdict == Verdict::doubtful && !good.empty())
    result.verdict_line += " Good all the same: " + good + ".";
}

}  // namespace vegard::fit
