#include "fit/columns/column_inversion.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/base/number/constants.h"

namespace vegard::fit {
namespace {

constexpr double kWidestFirstStep = 0.3;  // of a logarithm, where the covariance says nothing
constexpr double kTradeOff = 0.9;         // of a correlation: two unknowns are reported as trading off
constexpr int kMaxMinimisations = 400, kMaxRestarts = 3;
constexpr const char* kNouns[kColumnUnknowns] = {"E0", "energy flux", "oxygen factor", "soft component"};
constexpr const char* kUnits[kColumnUnknowns] = {" keV", " mW m-2", "", " of the rest's flux"};

OpenInterval interval_of_exponential(const OpenInterval& ln_interval) {
  OpenInterval interval;
  if (ln_interval.lower) interval.lower = std::exp(*ln_interval.lower);
  if (ln_interval.upper) interval.upper = std::exp(*ln_interval.upper);
  return interval;
}

/// Finds the intervals of one unknown about a valley. Returns true if a deeper point turned up, which then is
/// `valley`.
bool take_intervals(const ColumnChi2& chi2, const ColumnData& data, ColumnValley& valley, std::size_t k,
                    double sigma_ln, ColumnEstimate& estimate) {
  const MinimisedChi2 minimised = [&](std::size_t j, double fixed, std::vector<double>& point) {
    ColumnFreedom free = chi2.free();
    free[j] = false;
    ColumnPoint start{};
    std::copy(point.begin(), point.end(), start.begin());
    start[j] = fixed;
    const ColumnValley there = chi2.descend(data, start, free);
    point.assign(there.at.begin(), there.at.end());
    return there.chi2;
  };
  ProfileLikelihoodOptions options;
  options.first_step = sigma_ln > 0.0 && sigma_ln < kWidestFirstStep ? sigma_ln : kWidestFirstStep;
  options.least = chi2.model().least(k);
  options.most = chi2.model().most(k);
  options.max_steps = 1e12;
  options.max_minimisations = kMaxMinimisations;
  options.tolerance = 1e-3;
  const LikelihoodProfile profile =
      profile_likelihood(k, {valley.at.begin(), valley.at.end()}, valley.chi2, minimised, options);
  if (profile.better) {
    ColumnPoint start{};
    std::copy(profile.better->point.begin(), profile.better->point.end(), start.begin());
    valley = chi2.descend(data, start, chi2.free());
    return true;
  }
  estimate.interval68 = interval_of_exponential(profile.interval68);
  estimate.interval95 = interval_of_exponential(profile.interval95);
  return false;
}

ColumnSolution solution_of(const ColumnChi2& chi2, const ColumnData& data, ColumnValley valley) {
  ColumnSolution solution;
  for (int restart = 0; restart <= kMaxRestarts; ++restart) {
    solution = {};
    const ColumnMatrix covariance = column_covariance(valley, chi2.free());
    bool found_better = false;
    for (std::size_t k = 0; k < kColumnUnknowns && !found_better; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      ColumnEstimate& estimate = solution.of[k];
      estimate.value = std::exp(valley.at[k]);
      estimate.is_free = chi2.free()[k];
      if (!estimate.is_free) continue;
      estimate.sigma_ln = valley.at_edge[k] ? sim::kNaN : std::sqrt(covariance(i, i));
      estimate.sigma_ln_alone = 1.0 / std::sqrt(valley.information(i, i));
      found_better =
          take_intervals(chi2, data, valley, k, estimate.sigma_ln, estimate) && restart < kMaxRestarts;
    }
    if (found_better) continue;
    for (Eigen::Index i = 0; i < covariance.rows(); ++i)
      for (Eigen::Index j = 0; j < covariance.cols(); ++j)
        if (i != j && covariance(i, i) > 0.0 && covariance(j, j) > 0.0)
          solution.correlation(i, j) = covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
    break;
  }
  solution.chi2 = valley.chi2;
  solution.corrections = chi2.corrections(data, valley);
  for (std::size_t l = 0; l < chi2.model().lines(); ++l)
    solution.rayleigh.push_back(std::exp(chi2.model().at(l, valley.at).ln_rayleigh) *
                                (solution.corrections.empty() ? 1.0 : solution.corrections[l].factor));
  return solution;
}

std::string column_value_text(std::size_t k, double value) {
  return fmt::format("{:.3g}{}", value, kUnits[k]);
}

/// Returns the name of the line with the largest deviation.
std::string farthest_line(const ColumnInversion& inversion) {
  const ColumnSolution& best = inversion.solutions.front();
  std::size_t farthest = 0;
  double most = 0.0;
  for (std::size_t l = 0; l < inversion.lines_nm.size(); ++l) {
    double normalised_residual = (inversion.data.rayleigh[l] - best.rayleigh[l]) / inversion.data.sigma[l];
    // Where the tables' light may be corrected, what the correction costs is a part of chi2.
    if (!best.corrections.empty() && best.corrections[l].ln_sigma_of_tables > 0.0) {
      const double corrected = std::log(best.corrections[l].factor) / best.corrections[l].ln_sigma_of_tables;
      if (std::abs(corrected) > std::abs(normalised_residual)) normalised_residual = corrected;
    }
    if (std::abs(normalised_residual) <= std::abs(most)) continue;
    most = normalised_residual;
    farthest = l;
  }
  return fmt::format("{:.1f} nm is {:.1f} standard deviations {} the best of the tables",
                     inversion.lines_nm[farthest], std::abs(most), most > 0.0 ? "above" : "below");
}

void assess_columns(ColumnInversion& inversion) {
  const ColumnSolution& best = inversion.solutions.front();
  if (contradicts_tables(best.chi2, inversion.degrees_of_freedom)) {
    inversion.verdict = ColumnVerdict::contradiction;
    inversion.reason =
        "no electrons of these tables make these lines within their errors: " + farthest_line(inversion);
    return;
  }
  if (inversion.solutions.size() > 1) {
    inversion.verdict = ColumnVerdict::two_solutions;
    std::string energies;
    for (const ColumnSolution& s : inversion.solutions)
      energies += (energies.empty() ? "" : " or ") + column_value_text(kLnEnergy, s.of[kLnEnergy].value);
    inversion.reason = "E0 may be " + energies +
                       ": a line whose ratio to these is not the same at both would tell them apart";
    return;
  }
  std::string open, wide;
  for (std::size_t k = 0; k < kColumnUnknowns; ++k) {
    const ColumnEstimate& estimate = best.of[k];
    if (!estimate.is_free) continue;
    const OpenInterval& interval = estimate.interval95;
    const std::string separator = open.empty() ? "" : ", ";
    if (!interval.lower && !interval.upper)
      open += separator + kNouns[k] + " is unconstrained";
    else if (!interval.lower)
      open += separator + kNouns[k] + " is below " + column_value_text(k, *interval.upper) + " (95 %)";
    else if (!interval.upper)
      open += separator + kNouns[k] + " is above " + column_value_text(k, *interval.lower) + " (95 %)";
    else if (*interval.upper > kWideFactor * *interval.lower)
      wide += (wide.empty() ? "" : ", ") + fmt::format("{} lies anywhere from {} to {} (95 %)", kNouns[k],
                                                       column_value_text(k, *interval.lower),
                                                       column_value_text(k, *interval.upper));
  }
  if (!open.empty()) {
    inversion.verdict = ColumnVerdict::one_sided;
    inversion.reason = open + ", as far as the tables reach";
  } else if (!wide.empty()) {
    inversion.verdict = ColumnVerdict::loosely_constrained;
    inversion.reason = wide;
  } else {
    inversion.verdict = ColumnVerdict::well_constrained;
    inversion.reason = "one solution, with closed intervals";
  }
}

/// Returns sentences that say which unknowns trade off, and which lines would separate them.
std::vector<std::string> degeneracies_of(const ColumnSolution& best) {
  std::vector<std::string> words;
  for (std::size_t a = 0; a < kColumnUnknowns; ++a)
    for (std::size_t b = a + 1; b < kColumnUnknowns; ++b) {
      const double r = best.correlation(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
      const ColumnEstimate &one = best.of[a], &other = best.of[b];
      if (!one.is_free || !other.is_free || std::abs(r) < kTradeOff) continue;
      words.push_back(fmt::format(
          "{} and {} trade off (correlation {:+.2f}): {} more of the one goes with {:.2g} % {} of the other; "
          "were all else known, {} would be known to {:.2g} % instead of {:.2g} %",
          kNouns[a], kNouns[b], r, "10 %", 10.0 * std::abs(r) * other.sigma_ln / one.sigma_ln,
          r > 0.0 ? "more" : "less", kNouns[a], 100.0 * one.sigma_ln_alone, 100.0 * one.sigma_ln));
    }
  return words;
}

}  // namespace

const char* column_verdict_name(ColumnVerdict verdict) {
  static constexpr std::array names = {
      "well constrained", "loosely constrained",           "constrained on one side",
      "two solutions",    "lines contradict each other",   "no light",
      "not measured",     "lines ask for another spectrum"};
  return names[static_cast<std::size_t>(verdict)];
}

bool contradicts_tables(double chi2, int degrees_of_freedom) {
  return degrees_of_freedom > 0 ? chi2_tail(chi2, degrees_of_freedom) < kMinChance
                                : !(chi2 <= kMaxColumnChi2);
}

int degrees_of_freedom(const ColumnChi2& chi2) {
  return static_cast<int>(chi2.model().lines()) -
         static_cast<int>(std::count(chi2.free().begin(), chi2.free().end(), true));
}

ColumnInversion invert_columns(const ColumnChi2& chi2, const ColumnData& data) {
  ColumnInversion inversion;
  inversion.lines_nm = chi2.model().lines_nm();
  inversion.data = data;
  inversion.degrees_of_freedom = degrees_of_freedom(chi2);
  const std::vector<ColumnValley> valleys = chi2.valleys(data);
  for (const ColumnValley& valley : valleys) {
    if (!inversion.solutions.empty() &&
        (valley.chi2 - valleys.front().chi2 > kEquivalentChi2 || valley.barrier < kMinBarrier))
      continue;
    inversion.solutions.push_back(solution_of(chi2, data, valley));
  }
  if (inversion.degrees_of_freedom > 0)
    inversion.p_value = chi2_tail(inversion.solutions.front().chi2, inversion.degrees_of_freedom);
  assess_columns(inversion);
  inversion.degeneracies = degeneracies_of(inversion.solutions.front());
  return inversion;
}

}  // namespace vegard::fit
