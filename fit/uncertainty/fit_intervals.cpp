#include "fit/uncertainty/converged_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/parameters/free_parameters.h"
#include "fit/parameters/phase_anchor.h"
#include "fit/parameters/prior_rows.h"
#include "fit/search/descent.h"

namespace vegard::fit {
namespace {

constexpr int kIntervalIterations = 40;
constexpr int kMaxWalks = 6;
constexpr double kWorthTelling = 0.25;  // of chi2 below the answer's: half a standard deviation
// Where there is no error bar to go by: of a coordinate between two limits, whose whole range is about ten of
// these either way; else of the value, or of one unit.
constexpr double kStepBetweenLimits = 0.5;
constexpr double kStepOfValue = 0.1;

bool between_limits(const FreeNumber& n) { return std::isfinite(n.min) && std::isfinite(n.max); }

/// For a cost that number j is not part of.
SplinePrior without_number(const SplinePrior& all, int j) {
  SplinePrior rest = all;
  for (SplineLine& line : rest.lines) {
    for (int& number : line.numbers) number -= number > j;
    for (Bend& bend : line.bends)
      for (int& number : bend.numbers) number -= number > j;
  }
  return rest;
}

double prior_chi2(const FreeNumber& number, double value) {
  std::vector<double> residuals;
  PriorRows({number}).evaluate({value}, residuals, nullptr);
  double sum = 0.0;
  for (const double r : residuals) sum += r * r;
  return sum;
}

class Minimiser {
 public:
  Minimiser(const ConvergedFit& fit, const std::atomic<bool>* stop)
      : fit_(fit), origin_(fit.coordinates()), terms_(cost_terms(fit.observations, fit.free, Detail::full)) {
    log_.stop = stop;
  }

  double at_answer() {
    const ProfileCost cost(fit_.free, terms_, log_, {{}, {}, fit_.prior, fit_.inflation, {}});
    return cost.at(fit_.values, false).chi2 / (fit_.inflation * fit_.inflation);
  }

  /// Where a walk is to begin.
  void begin_at(const std::vector<double>& origin) { origin_ = origin; }

  /// The least with one coordinate held, as MinimisedChi2 has it.
  double operator()(std::size_t j, double fixed, std::vector<double>& point) {
    if (fit_.free.size() > 1 && only_moved(j, point)) follow(j, fixed, point);
    std::vector<double> held, start;
    std::vector<int> moved;
    std::vector<FreeNumber> others;
    for (std::size_t k = 0; k < point.size(); ++k) {
      held.push_back(fit_.free[k].value(point[k]));
      if (k == j) continue;
      moved.push_back(static_cast<int>(k));
      others.push_back(fit_.free[k]);
      start.push_back(held.back());
    }
    const double own_prior_chi2 = prior_chi2(fit_.free[j], held[j]);
    const double unit = fit_.inflation * fit_.inflation;
    if (moved.empty()) {
      const ProfileCost cost(fit_.free, terms_, log_);
      const ProfileCost::Point here = cost.at(held, false);
      return (here.chi2 - own_prior_chi2) / unit + own_prior_chi2;
    }
    sim::Scene there = fit_.scene;
    ParameterMap(fit_.scene, fit_.free).put(held, there);
    const ProfileCost cost(fit_.free, terms_, log_,
                           {moved, held, without_number(fit_.prior, static_cast<int>(j)), fit_.inflation,
                            phase_anchors(there, others, start)});
    std::vector<TraceRow> unused;
    const Descent least = descend(cost, start, kIntervalIterations, {}, log_, unused);
    if (!(least.chi2 >= 0.0)) return std::numeric_limits<double>::infinity();  // nothing could be evaluated
    for (std::size_t k = 0; k < moved.size(); ++k) point[moved[k]] = others[k].coordinate(least.values[k]);
    return least.chi2 / unit + own_prior_chi2;
  }

 private:
  /// Whether the others stand where they do at the beginning: the first step of a walk.
  bool only_moved(std::size_t j, const std::vector<double>& point) const {
    for (std::size_t k = 0; k < point.size(); ++k)
      if (k != j && point[k] != origin_[k]) return false;
    return true;
  }

  /// Takes the others along the covariance's regression line.
  void follow(std::size_t j, double fixed, std::vector<double>& point) const {
    const std::vector<double>& row = fit_.uncertainty.covariance[j];
    for (std::size_t k = 0; k < point.size(); ++k) {
      const double step = row[k] / row[j] * (fixed - origin_[j]);
      if (k != j && std::isfinite(step)) point[k] += step;
    }
  }

  const ConvergedFit& fit_;
  std::vector<double> origin_;
  const std::vector<CostTerm> terms_;
  EvaluationLog log_;
};

double first_step(const ConvergedFit& fit, std::size_t j) {
  if (std::isfinite(fit.uncertainty.sigma[j]) && fit.uncertainty.sigma[j] > 0.0)
    return fit.uncertainty.sigma[j];
  if (between_limits(fit.free[j])) return kStepBetweenLimits;
  return kStepOfValue * (fit.free[j].logarithmic() ? 1.0 : std::max(1.0, std::abs(fit.values[j])));
}

/// None as NaN.
double end_or_nan(const std::optional<double>& end) {
  return end.value_or(std::numeric_limits<double>::quiet_NaN());
}

std::optional<double> end_of(double number) {
  return std::isnan(number) ? std::optional<double>() : std::optional<double>(number);
}

}  // namespace

LikelihoodProfile interval_of_fit(const ConvergedFit& fit, std::size_t j, const std::atomic<bool>* stop) {
  Minimiser minimiser(fit, stop);
  const std::vector<double> answer = fit.coordinates();
  ProfileLikelihoodOptions options;
  options.first_step = first_step(fit, j);
  options.stop = stop;
  if (const double turn = wrap_period(fit.free[j]); turn > 0.0) {
    options.least = fit.free[j].coordinate(fit.values[j] - 0.5 * turn);
    options.most = fit.free[j].coordinate(fit.values[j] + 0.5 * turn);
  }
  // A fit ends a little above the least, and chi2 has some Monte-Carlo roughness: a walk that falls below its
  // beginning is taken up again from there.
  std::vector<double> origin = answer;
  const double at_answer = minimiser.at_answer();
  double least = at_answer;
  LikelihoodProfile profile;
  for (int walk = 0; walk < kMaxWalks; ++walk) {
    minimiser.begin_at(origin);
    profile = profile_likelihood(
        j, origin, least,
        [&](std::size_t k, double fixed, std::vector<double>& point) { return minimiser(k, fixed, point); },
        options);
    if (!profile.better) break;
    origin = profile.better->point;
    least += profile.better->rise;
  }
  if (!profile.better && at_answer - least > kWorthTelling)
    profile.better = ProfilePoint{origin[j], least - at_answer, origin};
  else if (profile.better && at_answer - least <= kWorthTelling)
    profile.whole = false;
  if (at_answer - least <= kWorthTelling) profile.better.reset();
  return profile;
}

StepOutput output_of(const LikelihoodProfile& profile) {
  StepOutput output;
  output.numbers["coordinate"] = {static_cast<double>(profile.coordinate)};
  output.numbers["ends"] = {end_or_nan(profile.interval68.lower), end_or_nan(profile.interval68.upper),
                            end_or_nan(profile.interval95.lower), end_or_nan(profile.interval95.upper)};
  for (const ProfilePoint& p : profile.path) {
    output.numbers["fixed"].push_back(p.fixed);
    output.numbers["rise"].push_back(p.rise);
    std::vector<double>& points = output.numbers["points"];
    points.insert(points.end(), p.point.begin(), p.point.end());
  }
  output.flags["better"] = profile.better.has_value();
  if (profile.better) output.numbers["better"] = {profile.better->fixed, profile.better->rise};
  output.flags["whole"] = profile.whole;
  return output;
}

LikelihoodProfile likelihood_profile_of(const StepOutput& output, std::size_t free) {
  LikelihoodProfile profile;
  profile.coordinate = output.count_of(output.number_at("coordinate"), "coordinate", free - 1);
  const std::vector<double>& ends = output.numbers_at("ends", 4);
  profile.interval68 = {end_of(ends[0]), end_of(ends[1])};
  profile.interval95 = {end_of(ends[2]), end_of(ends[3])};
  const std::vector<double>& fixed = output.numbers_at("fixed");
  const std::vector<double>& rise = output.numbers_at("rise", fixed.size());
  const std::vector<double>& points = output.numbers_at("points", free * fixed.size());
  for (std::size_t i = 0; i < fixed.size(); ++i)
    profile.path.push_back({fixed[i],
                            rise[i],
                            {points.begin() + static_cast<std::ptrdiff_t>(i * free),
                             points.begin() + static_cast<std::ptrdiff_t>((i + 1) * free)}});
  if (output.flag_at("better")) {
    const std::vector<double>& better = output.numbers_at("better", 2);
    profile.better = ProfilePoint{better[0], better[1], {}};
  }
  profile.whole = output.flag_at("whole");
  return profile;
}

}  // namespace vegard::fit
