#include "fit/answer/information_criteria.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "sim/base/file/number_text.h"

namespace vegard::fit {
namespace {

constexpr double kMention = 2.0, kPositive = 6.0, kEvidenceStrong = 10.0;

bool is_plural(const std::string& name) { return !name.empty() && name.back() == 's'; }

std::string amount(double difference) { return sim::short_number(difference, difference < 100.0 ? 2 : 3); }

}  // namespace

ChiSquareScaling chi2_scaling_of(const FittedModel& richest) {
  ChiSquareScaling b;
  const double reduced = richest.chi2 / std::max(1, richest.values - richest.parameters);
  b.correlated = std::max(1.0, richest.correlated);
  b.chi2_divisor = b.correlated * std::max(1.0, reduced);
  return b;
}

InformationCriteria information_criteria(const FittedModel& model, const ChiSquareScaling& scaling) {
  InformationCriteria c;
  const double k = model.parameters;
  c.chi2 = model.chi2 / scaling.chi2_divisor;
  c.values = std::max(1.0, model.values / scaling.correlated);
  c.aic = c.chi2 + 2.0 * k;
  const double left = c.values - k - 1.0;
  c.aicc = left > 0.0 ? c.aic + 2.0 * k * (k + 1.0) / left : std::numeric_limits<double>::infinity();
  c.bic = c.chi2 + k * std::log(c.values);
  return c;
}

std::string evidence_words(double bic_difference) {
  const double size = std::abs(bic_difference);
  if (size <= kMention) return "not worth more than a bare mention";
  if (size <= kPositive) return "positive evidence";
  return size <= kEvidenceStrong ? "strong evidence" : "very strong evidence";
}

std::string compared_in_words(const FittedModel& one, const FittedModel& two) {
  const ChiSquareScaling scaling = chi2_scaling_of(one.parameters > two.parameters ? one : two);
  const InformationCriteria a = information_criteria(one, scaling), b = information_criteria(two, scaling);
  const bool first = a.bic <= b.bic;
  const FittedModel &better = first ? one : two, &worse = first ? two : one;
  const double bic = std::abs(a.bic - b.bic);
  std::string text;
  if (bic <= kMention)
    text = fmt::format("{} and {} explain it equally well: BIC differs by {} ({})", one.name, two.name,
                       amount(bic), evidence_words(bic));
  else
    text = fmt::format("{} {} it better than {}: BIC lower by {} ({})", better.name,
                       is_plural(better.name) ? "explain" : "explains", worse.name, amount(bic),
                       evidence_words(bic));
  const double aicc = (first ? b.aicc - a.aicc : a.aicc - b.aicc);  // above 0: for the better one too
  if (bic > kMention && std::isfinite(aicc) && aicc < -kMention)
    text += fmt::format("; AICc, whose penalty on parameters is smaller, prefers {}, lower by {}", worse.name,
                        amount(-aicc));
  return text;
}

}  // namespace vegard::fit
