#include "fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "fit/compare/profile_cost.h"
#include "fit/fit_observations.h"
#include "fit/measure/unknown_transfer_curve.h"
#include "fit/parameters/free_parameters.h"
#include "fit/parameters/prior_rows.h"
#include "fit/radar/radar_refusal.h"
#include "fit/search/journal.h"
#include "fit/search/profile_rounds.h"
#include "fit/search/search.h"
#include "fit/uncertainty/sampled_uncertainty.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"
#include "sim/base/number/deviance_search.h"

// Fits a scene together with the unknown transfer curve of its photograph.
//
// A change of the curve changes the data themselves, so the curve cannot be one more parameter of the fit; it
// is searched for outside of it. First comes a whole search with the curve taken as sRGB. Then the curve's
// one or two numbers are searched (sim/base/number/deviance_search.h) by the likelihood of the file's numbers
// (fit/measure/unknown_transfer_curve.h); for each trial curve all other parameters are fitted by a descent
// from the answer at the nearest earlier trial. The final answer is computed with the curve that was found.
// The likelihood is divided by the number of correlated residuals per independent one, as for error bars.

namespace vegard::fit {
namespace {

constexpr int kTrialIterations = 60;
constexpr double kShareOfSearch = 0.5, kSharePerTrial = 0.03, kMaxShare = 0.88;  // guesses

sim::BentSrgb bent_at(const std::vector<double>& logarithms) {
  return {std::exp(logarithms.front()), std::exp(logarithms.back())};
}

sim::Error needs_known_curve(const sim::Scene& scene, const std::string& key, const std::string& what) {
  return sim::Error(sim::ErrorKind::scene, what + " with an unknown transfer curve")
      .file(scene.file)
      .key(key)
      .hint("or say the curve: --decoding srgb, gamma:2.2 or curve:FILE.csv");
}

void check_curve_fit(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                     const FitOptions& options) {
  const sim::Fit& f = scene.fit;
  if (f.weight[sim::StatisticKind::profile] <= 0.0)
    throw needs_known_curve(scene, "fit.profile_weight", "nothing would be compared").expected("above 0");
  for (const sim::StatisticFacts& facts : sim::kStatistics)
    if (facts.kind != sim::StatisticKind::profile && f.weight[facts.kind] > 0.0)
      throw needs_known_curve(scene, weight_key(facts.kind), "profiles alone can be compared").expected("0");
  if (f.photo_noise != sim::PhotoNoise::estimated)
    throw needs_known_curve(scene, "fit.photo_noise", "the sensor's noise is no guide")
        .expected("\"estimated\"");
  if (!spline_lines(scene, free).empty())
    throw needs_known_curve(scene, "fit.free", "a free-form height profile cannot be told apart")
        .expected("no spline_rate");
  refuse_radars(scene, "a fit with an unknown transfer curve");
  if (options.intervals || options.bootstrap > 0 || options.mcmc > 0)
    throw sim::Error(sim::ErrorKind::usage, "error bars cannot be validated with an unknown transfer curve")
        .key("--intervals, --bootstrap, --mcmc")
        .expected("a decoding that is known")
        .hint("fit the curve first, then give what it finds as --decoding");
}

/// Everything but the curve, at one curve after the other.
class TransferCurveFit {
 public:
  TransferCurveFit(const sim::Scene& given, const Photo& as_srgb, const FitOptions& options)
      : options_(options), as_srgb_(as_srgb), free_(free_numbers(given)), scene_(with_ties(given, free_)) {
    check_curve_fit(scene_, free_, options);
    log_.limit = options.max_evaluations;
    log_.stop = options.stop;
  }

  FitResult run(Photo& photo) {
    std::vector<Observation> first;
    first.push_back(observed(scene_, as_srgb_, options_.threads));
    first_ = &first.front();
    const SearchOutcome searched = search_outcome_of(
        recorded_step(options_.journal, "the whole search as sRGB", free_.size(), log_, trace_,
                      [&] {
                        return output_of(search(scene_, free_,
                                                {cost_terms(first, free_, Detail::coarse),
                                                 cost_terms(first, free_, Detail::full)},
                                                options_, log_, trace_));
                      }),
        free_.size());
    start_ = searched.best.values;
    if (std::isfinite(searched.best.chi2))
      weight_ = std::sqrt(correlated_at(first.front(), start_, photo.unknowns));
    const sim::DevianceMinimum found = sim::deviance_minimum(
        std::vector<double>(static_cast<std::size_t>(photo.unknowns), 0.0), std::log(kMaxExponent),
        [&](const std::vector<double>& at, const sim::DevianceTrial* nearest) {
          return trial(at, nearest == nullptr ? start_ : values_of(nearest->solution));
        });

    FoundTransferCurve curve;
    curve.covariance = found.covariance;
    curve.slopes = found.slopes;
    describe(found, curve);
    photo = decoded_by(as_srgb_, bent_at(found.at));
    const std::size_t file = photo.decoding.find(" (");
    photo.decoding = "unknown, found as " + curve.fitted.words +
                     (file == std::string::npos ? std::string() : photo.decoding.substr(file));
    std::vector<Observation> last;
    last.push_back(with_other_decoding(*first_, photo, options_.threads));
    polish(found, searched, last, curve.outcome);
    if (found.slopes.empty() || !found.converged) {
      curve.against.push_back("the search for the transfer curve did not settle");
      curve.slopes.assign(curve.covariance.size(), std::vector<double>(free_.size(), 0.0));
    }
    curve.log = log_;
    curve.trace = trace_;
    return fit_observations(scene_, free_, last, options_, &curve);
  }

 private:
  std::vector<double> coordinates_of(const std::vector<double>& values) const {
    std::vector<double> coordinates;
    for (std::size_t j = 0; j < free_.size(); ++j) coordinates.push_back(free_[j].coordinate(values[j]));
    return coordinates;
  }

  std::vector<double> values_of(const std::vector<double>& coordinates) const {
    std::vector<double> values;
    for (std::size_t j = 0; j < free_.size(); ++j) values.push_back(free_[j].value(coordinates[j]));
    return values;
  }

  Descent descent(const std::vector<CostTerm>& terms, const std::vector<double>& from,
                  const std::string& stage) {
    sim::Scene there = scene_;
    ParameterMap(scene_, free_).put(from, there);
    const ProfileCost cost(free_, terms, log_, {{}, {}, {}, weight_, phase_anchors(there, free_, from)});
    return descent_of(
        recorded_step(options_.journal, stage, free_.size(), log_, trace_,
                      [&] { return output_of(descend(cost, from, kTrialIterations, stage, log_, trace_)); }),
        free_.size());
  }

  sim::DevianceTrial trial(const std::vector<double>& at, const std::vector<double>& from) {
    const sim::BentSrgb bent = bent_at(at);
    const Photo photo = decoded_by(as_srgb_, bent);
    std::vector<Observation> observations;
    observations.push_back(with_other_decoding(*first_, photo, options_.threads));
    const std::string stage = "curve " + std::to_string(++trials_);
    if (options_.progress)
      options_.progress(stage, log_.residuals, std::numeric_limits<double>::infinity(),
                        std::min(kMaxShare, kShareOfSearch + kSharePerTrial * trials_));
    const std::vector<CostTerm> terms = cost_terms(observations, free_, Detail::full);
    const Descent end = descent(terms, from, stage);
    sim::DevianceTrial result;
    result.value = std::numeric_limits<double>::infinity();
    if (!std::isfinite(end.chi2) || (options_.stop != nullptr && options_.stop->load())) return result;
    const Comparison& full = *observations.front().full;
    double chi2 = 0.0;
    int dof = 0;
    result.correlated =
        correlated_at(observations.front(), end.values, static_cast<int>(at.size()), &chi2, &dof);
    const double weight = scene_.fit.weight[sim::StatisticKind::profile];
    const std::vector<double> slopes = mean_slopes(as_srgb_, bent, full.data().grid, kProfileSmoothing_px);
    result.value = scaled_chi2(chi2, dof) + weight * log_determinant(full.sigma(), slopes) +
                   result.correlated * prior_chi2_at(end.values);
    result.solution = coordinates_of(end.values);
    return result;
  }

  /// How many of the residuals go up and down as one, at some values; chi2 of the data there too.
  double correlated_at(const Observation& observation, const std::vector<double>& values,
                       int transfer_curve_unknowns, double* chi2_there = nullptr,
                       int* dof_there = nullptr) const {
    const Comparison& full = *observation.full;
    const std::vector<CostTerm> terms = {{observation.scene,
                                          ParameterMap(observation.scene, free_, observation.frame),
                                          observation.full.get()}};
    EvaluationLog ignored;
    const ProfileCost cost(free_, terms, ignored);
    const ProfileCost::Point point = cost.at(values, false);
    const double chi2 = point.by_photo.front().chi2;
    const int unknowns = static_cast<int>(free_.size()) + transfer_curve_unknowns + full.coefficients();
    const int dof = std::max(1, full.residuals() - unknowns);
    if (chi2_there != nullptr) *chi2_there = chi2;
    if (dof_there != nullptr) *dof_there = dof;
    return joint_inflation(cost, point, unknowns).correlated;
  }

  double prior_chi2_at(const std::vector<double>& values) const {
    std::vector<double> residuals;
    PriorRows(free_).evaluate(values, residuals, nullptr);
    double sum = 0.0;
    for (const double x : residuals) sum += x * x;
    return sum;
  }

  /// Descents with the curve that was found: of the answer, and of the search's other ends.
  void polish(const sim::DevianceMinimum& found, const SearchOutcome& searched,
              const std::vector<Observation>& last, SearchOutcome& outcome) {
    const std::vector<CostTerm> terms = cost_terms(last, free_, Detail::full);
    std::vector<double> from = start_;
    if (!found.trials.empty()) {
      std::vector<double> coordinates = found.centre.solution;
      for (std::size_t k = 0; k < found.slopes.size(); ++k)
        for (std::size_t j = 0; j < coordinates.size(); ++j)
          coordinates[j] += found.slopes[k][j] * (found.at[k] - found.centre.at[k]);
      from = values_of(coordinates);
    }
    outcome.best = descent(terms, from, "curve found");
    for (std::size_t i = 0; i < searched.others.size(); ++i)
      outcome.others.push_back(
          descent(terms, searched.others[i].values, "curve found, other end " + std::to_string(i + 1)));
    EvaluationLog ignored;
    const std::vector<double> start = start_values(free_);
    outcome.chi2_initial = ProfileCost(free_, terms, ignored).at(start, false).chi2;
  }

  void describe(const sim::DevianceMinimum& found, FoundTransferCurve& curve) const {
    FittedTransferCurve& fitted = curve.fitted;
    const std::size_t n = found.at.size();
    fitted.most = kMaxExponent;
    fitted.least = 1.0 / kMaxExponent;
    const char* const names[] = {"at black", "at white"};
    fitted.decoding_word = "srgb";
    for (std::size_t k = 0; k < n; ++k) {
      const double value = std::exp(found.at[k]);
      fitted.exponents.push_back({n == 1 ? "of all light" : names[k], value,
                                  value * std::sqrt(found.covariance[k][k]), found.at_limit[k],
                                  found.undetermined[k]});
      const FittedTransferCurve::Exponent& e = fitted.exponents.back();
      fitted.words +=
          (k == 0 ? "sRGB to the power of " : " at black and ") + sim::number_with_error(value, e.sigma);
      fitted.decoding_word += fmt::format(":{:.4g}", value);
      if (e.at_limit)
        curve.against.push_back("the exponent of the transfer curve over sRGB " + e.name + " is at a limit");
      else if (e.undetermined)
        curve.against.push_back("the data do not constrain the transfer curve: its exponent over sRGB " +
                                e.name + " may be anything about " + sim::number_with_error(value, e.sigma));
    }
    if (n == 2) {
      fitted.words += " at white";
      fitted.correlation =
          found.covariance[0][1] / std::sqrt(found.covariance[0][0] * found.covariance[1][1]);
    }
    double least = std::numeric_limits<double>::infinity();
    for (const sim::DevianceTrial& t : found.trials) least = std::min(least, t.value);
    for (const sim::DevianceTrial& t : found.trials) {
      fitted.trials.emplace_back();
      for (const double x : t.at) fitted.trials.back().push_back(std::exp(x));
      fitted.trials.back().push_back((t.value - least) / found.centre.correlated);
    }
  }

  const FitOptions& options_;
  const Photo& as_srgb_;
  const std::vector<FreeNumber> free_;
  const sim::Scene scene_;
  const Observation* first_ = nullptr;
  std::vector<double> start_;
  EvaluationLog log_;
  std::vector<TraceRow> trace_;
  int trials_ = 0;
  double weight_ = kFirstPriorWeight;  ///< of priors' rows in descents, and of a step that is worth making
};

}  // namespace

void widen(const FoundTransferCurve& curve, Uncertainty& u) {
  const std::size_t n = u.sigma.size();
  std::vector<std::vector<double>> more(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < curve.slopes.size(); ++k)
        for (std::size_t l = 0; l < curve.slopes.size(); ++l)
          more[i][j] += curve.slopes[k][i] * curve.covariance[k][l] * curve.slopes[l][j];
      u.covariance[i][j] += more[i][j];
    }
  std::vector<double> before = u.sigma;
  for (std::size_t i = 0; i < n; ++i) u.sigma[i] = std::sqrt(u.sigma[i] * u.sigma[i] + more[i][i]);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (std::isfinite(u.sigma[i]) && std::isfinite(u.sigma[j]) && u.sigma[i] * u.sigma[j] > 0.0)
        u.correlation[i][j] =
            (u.correlation[i][j] * before[i] * before[j] + more[i][j]) / (u.sigma[i] * u.sigma[j]);
}

FitResult fit_photo_and_transfer_curve(const sim::Scene& scene, Photo& photo, const FitOptions& options) {
  assert(photo.unknowns == 1 || photo.unknowns == 2);
  const Photo as_srgb = photo;
  return TransferCurveFit(scene, as_srgb, options).run(photo);
}

}  // namespace vegard::fit
