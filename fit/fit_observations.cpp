#include "fit/fit_observations.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "fit/answer/answer.h"
#include "fit/answer/derived.h"
#include "fit/answer/energy_flux.h"
#include "fit/answer/error_bar_validation.h"
#include "fit/answer/free_profile.h"
#include "fit/answer/photo_line_ratio.h"
#include "fit/answer/verdict.h"
#include "fit/compare/observation.h"
#include "fit/compare/profile_cost.h"
#include "fit/measure/noise_model.h"
#include "fit/parameters/free_parameters.h"
#include "fit/parameters/prior_rows.h"
#include "fit/photo/averaging.h"
#include "fit/search/gradient_cosine.h"
#include "fit/search/journal.h"
#include "fit/search/profile_rounds.h"
#include "fit/search/search.h"
#include "fit/search/search_outcome.h"
#include "fit/uncertainty/flat_directions.h"
#include "fit/uncertainty/sampled_uncertainty.h"
#include "fit/uncertainty/uncertainty.h"
#include "sim/base/error.h"
#include "sim/scene/table/value_check.h"

namespace vegard::fit {
namespace {

constexpr double kShareBeforeErrorBars = 0.9;
constexpr double kSecondMode = 4.0;  // difference of chi2 (two standard deviations) in units of the inflation

/// The sky alone, with the night sky's known lights where the fit ended.
double chi2_without_aurora(const std::vector<Observation>& observations, const ProfileCost::Point& point) {
  double chi2 = 0.0;
  for (std::size_t o = 0; o < observations.size(); ++o)
    chi2 += observations[o].full->chi2_without_aurora(point.of_photo[o]);
  return chi2;
}

/// Of single numbers; what smooth profiles cost is no matter of data.
double chi2_of_priors(const std::vector<FreeNumber>& free, const std::vector<double>& values) {
  std::vector<double> residuals;
  PriorRows(free).evaluate(values, residuals, nullptr);
  return std::accumulate(residuals.begin(), residuals.end(), 0.0,
                         [](double sum, double x) { return sum + x * x; });
}

/// By coordinate: a free-form profile's, which its smoothness bounds where the data do not.
std::vector<bool> bounded_by_prior(const SplinePrior& prior, std::size_t coordinates) {
  std::vector<bool> bounded(coordinates, false);
  for (const SplineLine& line : prior.lines)
    for (const int j : line.numbers) bounded[j] = true;
  return bounded;
}

/// How much likelier a step from some values makes the coordinates, as far as their limits go: between two
/// limits every value is alike likely, and so the coordinate has a logistic distribution.
double log_of_limits(const std::vector<FreeNumber>& free, const std::vector<double>& values,
                     const std::vector<double>& step) {
  const auto log_density = [](double u) { return -std::abs(u) - 2.0 * std::log1p(std::exp(-std::abs(u))); };
  double sum = 0.0;
  for (std::size_t j = 0; j < free.size(); ++j) {
    if (!std::isfinite(free[j].min) || !std::isfinite(free[j].max)) continue;
    const double at = free[j].coordinate(values[j]);
    sum += log_density(at + step[j]) - log_density(at);
  }
  return sum;
}

ComparedValues compared_values(const std::vector<Observation>& observations, int unknowns) {
  ComparedValues compared;
  compared.unknowns = unknowns;
  for (const Observation& o : observations) {
    compared.regions_px.push_back(region_in_file(o.scene.camera, o.region));
    compared.values += o.full->residuals();
    compared.sum_of_weights += o.sum_of_weights;
    compared.sampling_error = std::max(compared.sampling_error, o.sampling_error);
    compared.draws = compared.draws || (!o.scene.sheets.empty() && is_drawn(o.scene));
  }
  return compared;
}

int held_gains(const std::vector<Observation>& observations, const ProfileCost::Point& point) {
  int held = 0;
  for (std::size_t o = 0; o < observations.size(); ++o)
    held += observations[o].full->held_gains(point.of_photo[o]);
  return held;
}

/// Of all photographs together, statistic by statistic.
std::vector<ComparedStatistic> compared_statistics(const std::vector<Observation>& observations,
                                                   const ProfileCost::Point& point) {
  std::vector<ComparedStatistic> all;
  for (std::size_t o = 0; o < observations.size(); ++o)
    for (const Comparison::Share& share : observations[o].full->shares(point.of_photo[o])) {
      auto found = std::find_if(all.begin(), all.end(),
                                [&](const ComparedStatistic& s) { return s.name == share.name; });
      if (found == all.end()) found = all.insert(all.end(), {share.name, share.weight, 0, 0.0});
      found->residuals += share.residuals;
      found->chi2 += share.chi2;
    }
  return all;
}

/// An end of another descent that explains the data almost as well, at another place.
void look_for_second_mode(const std::vector<FreeNumber>& free, const std::vector<double>& values,
                          const SearchOutcome& outcome, const FitResult& r, Evidence& evidence) {
  for (const Descent& other : outcome.others) {
    const double difference = (other.chi2 - outcome.best.chi2) / (r.error_inflation * r.error_inflation);
    if (difference > kSecondMode) continue;
    for (std::size_t j = 0; j < free.size(); ++j) {
      if (!r.parameters[j].sigma ||
          wrapped_difference(free[j], other.values[j], values[j]) <= 3.0 * *r.parameters[j].sigma)
        continue;
      evidence.second_mode = true;
      evidence.second_mode_values = other.values;
      evidence.second_mode_text = "another answer explains the data almost as well, with " + free[j].label() +
                                  " = " + std::to_string(wrapped_angle(free[j], other.values[j]));
      break;
    }
  }
}

/// What the other end has for each derived number, by which one may see how much it matters.
void put_second_mode(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                     const std::vector<double>& values, FitResult& r) {
  sim::Scene there = r.best;
  ParameterMap(scene, free).put(values, there);
  const ValueUncertainty nothing_known{
      std::vector<std::vector<double>>(free.size(), std::vector<double>(free.size(), 0.0)), {}};
  for (const DerivedNumber& other : derived_numbers(there, free, values, nothing_known))
    for (DerivedNumber& d : r.derived)
      if (d.name == other.name && std::isfinite(other.value)) d.at_other_mode = other.value;
}

/// What each photograph has of the answer. Several leave what is theirs in the best scene's entries.
void put_photos(const std::vector<Observation>& observations, const std::vector<CostTerm>& terms,
                const std::vector<FreeNumber>& free, const std::vector<double>& values,
                const ProfileCost::Point& point, const ValueUncertainty& known, FitResult& r) {
  for (std::size_t o = 0; o < observations.size(); ++o) {
    const Comparison& full = *observations[o].full;
    FittedPhoto fitted;
    fitted.name = observations[o].frame.name;
    fitted.decoding = observations[o].photo->decoding;
    if (const std::string averaged = averaging_words(observations[o].scene.camera); !averaged.empty())
      fitted.decoding += ", " + averaged;
    fitted.data = full.data();
    fitted.sigma = full.sigma();
    fitted.model = full.profile_model(point.of_photo[o]);
    fitted.behind =
        full.linear().light(point.of_photo[o].aurora, point.of_photo[o].solution, fitted.model.size()).behind;
    fitted.chi2 = point.of_photo[o].chi2;
    fitted.best = observations[o].scene;
    terms[o].map.put(values, fitted.best);
    if (!fitted.name.empty()) {  // a scene by itself, where no other photograph is known
      fitted.best.fit.free.clear();
      fitted.best.fit.tied.clear();
    }
    put_solution(full, point.of_photo[o], known, r.error_inflation, fitted);
    fitted.rms_over_peak = rms_over_peak(fitted);
    fitted.model_error = found_model_error(
        fitted.data, fitted.model, fitted.sigma,
        std::hypot(observations[o].scene.fit.model_error, observations[o].sampling_error),
        r.compared.values > 0 ? static_cast<double>(std::count_if(fitted.sigma.begin(), fitted.sigma.end(),
                                                                  [](double s) { return s > 0.0; })) *
                                    r.dof / r.compared.values
                              : 0.0);
    r.rms_over_peak = std::max(r.rms_over_peak, fitted.rms_over_peak);
    if (!fitted.name.empty())
      r.best.fit.photos[o] = entry_of_best(r.best.fit.photos[o], fitted, free, r.parameters);
    r.photos.push_back(std::move(fitted));
  }
}

DerivedNumber exponent_of(const FittedCurve::Exponent& e) {
  DerivedNumber number;
  number.name = "exponent of the transfer curve over sRGB " + e.name;
  number.value = e.value;
  number.sigma = e.sigma;
  return number;
}

/// What follows from the answer and is what people publish.
void put_derived(const std::vector<Observation>& observations, const std::vector<FreeNumber>& free,
                 const std::vector<double>& values, const ValueUncertainty& known, bool stopped,
                 FitResult& r) {
  r.derived = derived_numbers(r.best, free, values, known);
  r.foot_bands = foot_bands(r.best, free, values, known);
  std::vector<const sim::Scene*> scenes;
  for (const Observation& observation : observations) scenes.push_back(&observation.scene);
  for (DerivedNumber& flux : energy_fluxes(scenes, r)) r.derived.push_back(std::move(flux));
  for (DerivedNumber& ratio : photo_line_ratios(r)) r.derived.push_back(std::move(ratio));
  if (!stopped) return;
  for (DerivedNumber& d : r.derived)
    if (!d.why_no_sigma.empty()) d.why_no_sigma = "the fit was interrupted";
}

}  // namespace

sim::Scene with_ties(const sim::Scene& given, const std::vector<FreeNumber>& free, const PhotoFrame& frame) {
  const ParameterMap map(given, free, frame);
  if (map.is_plain()) return given;
  std::vector<double> start;
  for (const FreeNumber& number : free) start.push_back(number.start);
  sim::Scene scene = given;
  map.put(start, scene);
  return scene;
}

std::vector<Observation> observations_of(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                                         const std::vector<const Photo*>& photos, int threads) {
  sim::require_earth(scene, "a fit");
  std::vector<Observation> observations;
  if (scene.fit.photos.empty()) {
    assert(photos.size() == 1);
    observations.push_back(observed(scene, *photos.front(), threads));
    return observations;
  }
  assert(photos.size() == scene.fit.photos.size());
  for (const Photo* photo : photos)
    if (photo->unknowns > 0)
      throw sim::Error(
          sim::ErrorKind::scene,
          {"the transfer curve of " + photo->file_name +
               " is unknown, and that of one photograph alone can be found",
           scene.file, 0, "fit.decoding", "a decoding that is known",
           "fit one of them by itself with --decoding unknown, and give all the curve that it finds"});
  for (std::size_t i = 0; i < photos.size(); ++i) {
    const FramedScene framed = framed_scene(scene, scene.fit.photos[i]);
    observations.push_back(
        observed(with_ties(framed.scene, free, framed.frame), *photos[i], threads, framed.frame));
  }
  return observations;
}

FitResult fit_observations(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                           const std::vector<Observation>& observations, const FitOptions& asked,
                           const FoundCurve* curve, const FinishedSearch* done) {
  sim::require_earth(scene, "a fit");
  const FitOptions options = with_validation_progress(asked, free.size());
  const std::vector<CostTerm> full = cost_terms(observations, free, Detail::full);

  FitResult r;
  r.seed = scene.seed;
  int unknowns = static_cast<int>(free.size()), residuals = 0;
  if (curve != nullptr) unknowns += static_cast<int>(curve->covariance.size());
  for (const Observation& o : observations) {
    unknowns += o.full->coefficients();
    residuals += o.full->residuals();
  }
  if (residuals <= unknowns)
    throw sim::Error(sim::ErrorKind::unreadable_input,
                     {"only " + std::to_string(residuals) + " usable values in the region of interest",
                      observations.front().photo->file_name, 0, "fit.roi_px",
                      "more than " + std::to_string(unknowns), "is everything masked or clipped?"});

  EvaluationLog log;
  log.limit = options.max_evaluations;
  log.stop = options.stop;
  if (curve != nullptr) {
    log = curve->log;
    r.trace = curve->trace;
  }
  if (done != nullptr) {
    log = done->log;
    r.trace = done->trace;
  }

  Evidence evidence;
  const SearchOutcome outcome =
      curve != nullptr ? curve->outcome
      : done != nullptr
          ? done->outcome
          : search_outcome_of(
                recorded_step(options.journal, "the whole search", free.size(), log, r.trace,
                              [&] {
                                return output_of(search(
                                    scene, free, {cost_terms(observations, free, Detail::coarse), full},
                                    options, log, r.trace));
                              }),
                free.size());
  r.chi2_initial = outcome.chi2_initial;
  r.termination = outcome.best.termination;
  Descent best = outcome.best;
  Settled settled;
  if (PriorRows(free).count() > 0 || !spline_lines(scene, free).empty()) {
    settled = settle(scene, free, full, best, log, r.trace, options.journal);
    best = settled.descent;
    r.termination = best.termination;
  }
  evidence.converged = best.converged;
  evidence.stopped = options.stop != nullptr && options.stop->load();
  if (evidence.stopped) r.termination = words_for_stop(log);
  evidence.out_of_evaluations =
      log.residuals >= log.limit && (!evidence.converged || (done != nullptr && done->cut_short));
  std::vector<double> values = best.values;
  if (!std::isfinite(best.chi2) && !log.best_values.empty()) values = log.best_values;

  // The last word: full model, exact Jacobian, whatever the limit on evaluations says.
  r.evaluations = log.residuals;
  r.jacobian_evaluations = log.jacobians;
  EvaluationLog closing;
  sim::Scene there = scene;
  ParameterMap(scene, free).put(values, there);
  const std::vector<PhaseAnchor> anchors = phase_anchors(there, free, values);
  const ProfileCost cost(free, full, closing, {{}, {}, settled.prior, settled.inflation, anchors});
  const ProfileCost::Point point = cost.at(values, true);
  evidence.chi2_without_aurora = chi2_without_aurora(observations, point);
  r.chi2 = chi2_of_priors(free, values);
  for (const Comparison::Point& p : point.of_photo) r.chi2 += p.chi2;
  r.dof = residuals + static_cast<int>(PriorRows(free).count()) - unknowns + held_gains(observations, point);
  const Inflation inflation = joint_inflation(cost, point, unknowns);
  r.error_inflation = inflation.factor();
  r.correlated_residuals = inflation.together;
  r.statistics = compared_statistics(observations, point);

  r.compared = compared_values(observations, unknowns - held_gains(observations, point));
  r.gradient_cosine = gradient_cosine(cost, values);

  const std::size_t n = free.size();
  const auto error_bars = [&] {
    Uncertainty u = sampled_uncertainty(observations, free, values, settled.prior, anchors, r.error_inflation,
                                        options.threads);
    drop_flat_directions(
        [&](const std::vector<double>& step) {
          std::vector<double> moved = cost.coordinates(values);
          for (std::size_t k = 0; k < n; ++k) moved[k] += step[k];
          moved = cost.values(moved.data());
          return (cost.at(moved, false).chi2 - point.chi2) / (r.error_inflation * r.error_inflation) -
                 2.0 * log_of_limits(free, values, step);
        },
        bounded_by_prior(settled.prior, n), u);
    without_anchors(anchors, free, values, u);
    if (curve != nullptr) widen(*curve, u);
    return output_of(u);
  };
  if (options.progress && !evidence.stopped)
    options.progress("error bars", log.residuals, r.chi2 / std::max(1, r.dof), kShareBeforeErrorBars);
  NullJournal nowhere;
  Journal& journal = options.journal != nullptr ? *options.journal : nowhere;
  const Uncertainty u = evidence.stopped ? no_uncertainty(n, r.error_inflation)
                                         : uncertainty_of(journal.step("error bars", error_bars), n);

  const ValueUncertainty known = put_parameters(scene, free, values, u, evidence.stopped, r);
  std::vector<double> tidied;
  for (const FittedParameter& p : r.parameters) tidied.push_back(p.value);
  r.best = scene;
  const ParameterMap shared(scene, free);
  shared.put(tidied, r.best);
  r.tied = tied_numbers(shared, tidied, r.best, known);
  start_from(free, tidied, r.best);
  put_photos(observations, full, free, tidied, point, known, r);
  if (observations.size() == 1 && r.photos.front().name.empty()) {
    start_from(free, tidied, r.photos.front().best);
    r.best = with_pixels_of(scene, r.photos.front().best);
  }
  put_derived(observations, free, tidied, known, evidence.stopped, r);
  if (curve != nullptr) {
    r.curve = curve->fitted;
    for (const FittedCurve::Exponent& e : curve->fitted.exponents) r.derived.push_back(exponent_of(e));
    evidence.curve_words = curve->fitted.words;
    evidence.against_curve = curve->against;
  }

  if (settled.prior.any()) {
    evidence.unknowns = settled.determined;
    r.profiles = free_profiles(r.best, settled.prior, known);
  }
  evidence.aurora_in_view =
      std::any_of(point.of_photo.begin(), point.of_photo.end(), [](const Comparison::Point& p) {
        return std::any_of(p.aurora.value.begin(), p.aurora.value.end(), [](double x) { return x > 0.0; });
      });
  look_for_second_mode(free, values, outcome, r, evidence);
  if (evidence.second_mode) put_second_mode(scene, free, evidence.second_mode_values, r);
  assess_fit(evidence, r);
  assess_quantities(r);
  if (r.verdict == Verdict::good || r.verdict == Verdict::doubtful)
    validate_error_bars({scene, free, observations, values, settled.prior, r.error_inflation, u}, asked,
                        journal, r);
  return r;
}

}  // namespace vegard::fit
