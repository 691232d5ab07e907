#include "fit/fit_observations.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>

#include "fit/answer/answer.h"
#include "fit/answer/derived.h"
#include "fit/answer/energy_flux.h"
#include "fit/answer/error_bar_validation.h"
#include "fit/answer/photo_line_ratio.h"
#include "fit/answer/tables_correction.h"
#include "fit/answer/verdict.h"
#include "fit/compare/observation.h"
#include "fit/compare/profile_cost.h"
#include "fit/measure/noise_model.h"
#include "fit/parameters/free_parameters.h"
#include "fit/parameters/prior_rows.h"
#include "fit/photo/averaging.h"
#include "fit/search/descent.h"
#include "fit/search/journal.h"
#include "fit/search/profile_rounds.h"
#include "fit/search/search.h"
#include "fit/uncertainty/band_scatter.h"
#include "fit/uncertainty/physics_uncertainty.h"
#include "fit/uncertainty/sampled_uncertainty.h"
#include "fit/uncertainty/uncertainty.h"
#include "sim/base/error.h"
#include "sim/base/file/sha256.h"
#include "sim/scene/table/emission_folder.h"
#include "sim/scene/table/value_check.h"

namespace vegard::fit {
namespace {

constexpr double kShareBeforeErrorBars = 0.9;
constexpr double kSecondMode = 4.0;  // difference of chi2 (two standard deviations) in units of the inflation

/// The sky alone, with the night sky's known lights where the fit ended.
double chi2_without_aurora(const std::vector<Observation>& observations, const ProfileCost::Point& point) {
  double chi2 = 0.0;
  for (std::size_t o = 0; o < observations.size(); ++o)
    chi2 += observations[o].full->chi2_without_aurora(point.by_photo[o]);
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

/// The derivative of minus the same, for one number, by its coordinate.
double half_slope_of_limits(const FreeNumber& free, double coordinate) {
  return std::isfinite(free.min) && std::isfinite(free.max) ? std::tanh(0.5 * coordinate) : 0.0;
}

std::vector<FittedRadar> fitted_radars(const RadarTerm& term, const std::vector<double>& values) {
  sim::Scene there = term.scene;
  term.map.put(values, there);
  return term.radars->fitted(there);
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
    held += observations[o].full->held_gains(point.by_photo[o]);
  return held;
}

/// Of all photographs together, statistic by statistic.
std::vector<ComparedStatistic> compared_statistics(const std::vector<Observation>& observations,
                                                   const ProfileCost::Point& point) {
  std::vector<ComparedStatistic> all;
  for (std::size_t o = 0; o < observations.size(); ++o)
    for (const Comparison::Share& share : observations[o].full->shares(point.by_photo[o])) {
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
    fitted.model = full.profile_model(point.by_photo[o]);
    fitted.behind =
        full.linear().light(point.by_photo[o].aurora, point.by_photo[o].solution, fitted.model.size()).behind;
    fitted.chi2 = point.by_photo[o].chi2;
    fitted.best = observations[o].scene;
    terms[o].map.put(values, fitted.best);
    if (!fitted.name.empty()) {  // a scene by itself, where no other photograph is known
      fitted.best.fit.free.clear();
      fitted.best.fit.tied.clear();
    }
    put_solution(full, point.by_photo[o], known, r.error_inflation, o, fitted);
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

DerivedNumber exponent_of(const FittedTransferCurve::Exponent& e) {
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

ModeInformation told_of_physics(const ModeEffects& effects, const sim::Scene& scene, double inflation) {
  ModeInformation told = mode_information(effects, inflation);
  if (told.modes.empty()) return told;
  const std::shared_ptr<const sim::TableFolder> tables = sim::are_built_in_tables(scene.emission.tables)
                                                             ? sim::built_in_tables(scene.emission.tables)
                                                             : scene.emission.folder;
  told.tables = sim::sha256(tables->files.at(sim::kModesFile));
  return told;
}

/// One fit: its state, and its steps in the order of run().
class FitRun {
 public:
  FitRun(const sim::Scene& scene, const std::vector<FreeNumber>& free,
         const std::vector<Observation>& observations, const FitOptions& asked,
         const FoundTransferCurve* curve, const FinishedSearch* done)
      : scene_(scene),
        free_(free),
        observations_(observations),
        asked_(asked),
        options_(with_validation_progress(asked, free.size())),
        curve_(curve),
        done_(done),
        full_(cost_terms(observations, free, Detail::full)),
        journal_(options_.journal != nullptr ? *options_.journal : nowhere_) {
    r_.seed = scene.seed;
  }

  FitResult run() {
    count_unknowns();
    const SearchOutcome outcome = find_minimum();
    settle_priors(outcome);
    evaluate_answer();
    const Uncertainty u = find_error_bars();
    Uncertainty whole = u;
    if (!evidence_.stopped) {
      const ModeEffects effects = mode_effects(*cost_, values_);
      add_physics(effects, whole);
      widen_by_bands(u.covariance, whole);
      // The noise of drawn beams in a Jacobian would look like knowledge.
      if (!r_.compared.draws) r_.physics = told_of_physics(effects, scene_, r_.error_inflation);
    }
    put_answer(whole);
    if (!r_.physics.modes.empty()) {
      r_.physics.lines = lines_by_modes(r_.best, r_.physics.modes);
      r_.tables = tables_corrections(r_.physics.lines, learnt_modes(r_.physics));
    }
    judge(outcome);
    if (r_.verdict == Verdict::good || r_.verdict == Verdict::doubtful)
      validate_error_bars({scene_, free_, observations_, values_, settled_.prior, r_.error_inflation, u},
                          asked_, journal_, r_);
    return std::move(r_);
  }

 private:
  /// Throws if there are not more data than unknowns.
  void count_unknowns() {
    unknowns_ = static_cast<int>(free_.size());
    if (curve_ != nullptr) unknowns_ += static_cast<int>(curve_->covariance.size());
    for (const Observation& o : observations_) {
      unknowns_ += o.full->coefficients();
      residuals_ += o.full->residuals();
    }
    if (residuals_ > unknowns_) return;
    throw sim::unreadable(observations_.front().photo->file_name,
                          "only " + std::to_string(residuals_) + " usable values in the region of interest")
        .key("fit.roi_px")
        .expected("more than " + std::to_string(unknowns_))
        .hint("is everything masked or clipped?");
  }

  SearchOutcome find_minimum() {
    log_.limit = options_.max_evaluations;
    log_.stop = options_.stop;
    if (curve_ != nullptr) {
      log_ = curve_->log;
      r_.trace = curve_->trace;
    }
    if (done_ != nullptr) {
      log_ = done_->log;
      r_.trace = done_->trace;
    }
    if (curve_ != nullptr) return curve_->outcome;
    if (done_ != nullptr) return done_->outcome;
    return search_outcome_of(
        recorded_step(options_.journal, "the whole search", free_.size(), log_, r_.trace,
                      [&] {
                        return output_of(search(scene_, free_,
                                                {cost_terms(observations_, free_, Detail::coarse), full_},
                                                options_, log_, r_.trace));
                      }),
        free_.size());
  }

  /// Repeats descents where priors depend on the misfit; sets the answer's values.
  void settle_priors(const SearchOutcome& outcome) {
    r_.chi2_initial = outcome.chi2_initial;
    Descent best = outcome.best;
    if (PriorRows(free_).count() > 0 || !spline_lines(scene_, free_).empty() || radar() != nullptr) {
      settled_ = settle(scene_, free_, full_, best, log_, r_.trace, options_.journal);
      best = settled_.descent;
    }
    evidence_.converged = best.converged;
    evidence_.stopped = options_.stop != nullptr && options_.stop->load();
    r_.termination = evidence_.stopped ? words_for_stop(log_) : best.termination;
    evidence_.out_of_evaluations =
        log_.residuals >= log_.limit && (!evidence_.converged || (done_ != nullptr && done_->cut_short));
    values_ = best.values;
    if (!std::isfinite(best.chi2) && !log_.best_values.empty()) values_ = log_.best_values;
    r_.evaluations = log_.residuals;
    r_.jacobian_evaluations = log_.jacobians;
  }

  /// Evaluates the full model and its exact Jacobian, whatever the limit on evaluations says.
  void evaluate_answer() {
    sim::Scene there = scene_;
    ParameterMap(scene_, free_).put(values_, there);
    anchors_ = phase_anchors(there, free_, values_);
    cost_.emplace(free_, full_, closing_log_,
                  ProfileCost::Options{{}, {}, settled_.prior, settled_.inflation, anchors_});
    point_ = cost_->at(values_, true);
    evidence_.chi2_without_aurora = chi2_without_aurora(observations_, point_);
    r_.chi2 = chi2_of_priors(free_, values_);
    for (const Comparison::Point& p : point_.by_photo) r_.chi2 += p.chi2;
    if (radar() != nullptr) r_.radars = fitted_radars(*radar(), values_);
    int of_radars = 0;
    for (const FittedRadar& fitted : r_.radars) r_.chi2 += fitted.chi2, of_radars += fitted.values;
    const int held = held_gains(observations_, point_);
    r_.dof = residuals_ + static_cast<int>(PriorRows(free_).count()) + of_radars - unknowns_ + held;
    const Inflation inflation = joint_inflation(*cost_, point_, unknowns_);
    r_.error_inflation = inflation.factor();
    r_.correlated_residuals = inflation.correlated;
    r_.statistics = compared_statistics(observations_, point_);
    for (const FittedRadar& fitted : r_.radars)
      r_.statistics.push_back({"radar " + fitted.name, 1.0, fitted.values, fitted.chi2});
    r_.compared = compared_values(observations_, unknowns_ - held);
    r_.gradient_cosine = gradient_cosine(*cost_, values_);
  }

  Uncertainty find_error_bars() {
    if (evidence_.stopped) return no_uncertainty(free_.size(), r_.error_inflation);
    if (options_.progress)
      options_.progress("error bars", log_.residuals, r_.chi2 / std::max(1, r_.dof), kShareBeforeErrorBars);
    return uncertainty_of(journal_.step("error bars", [&] { return output_of(error_bars()); }), free_.size());
  }

  ChiSquareRise chi2_rise() const {
    const auto at = [this](const std::vector<double>& step) {
      std::vector<double> moved = cost_->coordinates(values_);
      for (std::size_t k = 0; k < free_.size(); ++k) moved[k] += step[k];
      return moved;
    };
    const double unit = r_.error_inflation * r_.error_inflation;
    ChiSquareRise rise;
    rise.rise = [this, at, unit](const std::vector<double>& step) {
      const std::vector<double> moved = at(step);
      return (cost_->at(cost_->values(moved.data()), false).chi2 - point_.chi2) / unit -
             2.0 * log_of_limits(free_, values_, step);
    };
    rise.half_gradient = [this, at, unit](const std::vector<double>& step) -> std::vector<double> {
      if (options_.stop != nullptr && *options_.stop) return {};
      const std::vector<double> moved = at(step);
      const auto rows = static_cast<std::size_t>(cost_->num_residuals());
      std::vector<double> residuals(rows), jacobian(rows * moved.size()), gradient(moved.size(), 0.0);
      const double* parameters[] = {moved.data()};
      double* jacobians[] = {jacobian.data()};
      if (!cost_->Evaluate(parameters, residuals.data(), jacobians)) return {};
      for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t k = 0; k < gradient.size(); ++k)
          gradient[k] += jacobian[i * gradient.size() + k] * residuals[i] / unit;
      for (std::size_t k = 0; k < gradient.size(); ++k)
        gradient[k] += half_slope_of_limits(free_[k], moved[k]);
      return gradient;
    };
    return rise;
  }

  Uncertainty error_bars() const {
    const std::vector<std::vector<double>> jacobians =
        sampled_jacobians(observations_, free_, values_, anchors_, options_.threads);
    Uncertainty u = sampled_uncertainty(observations_, free_, values_, settled_.prior, anchors_,
                                        r_.error_inflation, jacobians);
    drop_flat_directions(chi2_rise(), bounded_by_prior(settled_.prior, free_.size()), u);
    without_anchors(anchors_, free_, values_, u);
    BandRows rows = photo_rows(observations_, *cost_, point_, jacobians, r_.error_inflation);
    without_anchors(anchors_, free_, values_, rows.jacobian);
    u.by_bands = factors_by_bands(rows, u.covariance);
    if (curve_ != nullptr) widen(*curve_, u);
    return u;
  }

  void put_answer(const Uncertainty& u) {
    const ValueUncertainty known = put_parameters(scene_, free_, values_, u, evidence_.stopped, r_);
    std::vector<double> tidied;
    for (const FittedParameter& p : r_.parameters) tidied.push_back(p.value);
    r_.best = scene_;
    const ParameterMap shared(scene_, free_);
    shared.put(tidied, r_.best);
    r_.tied = tied_numbers(shared, tidied, r_.best, known);
    start_from(free_, tidied, r_.best);
    put_photos(observations_, full_, free_, tidied, point_, known, r_);
    if (observations_.size() == 1 && r_.photos.front().name.empty()) {
      start_from(free_, tidied, r_.photos.front().best);
      r_.best = with_pixels_of(scene_, r_.photos.front().best);
    }
    put_derived(observations_, free_, tidied, known, evidence_.stopped, r_);
    if (curve_ != nullptr) put_curve();
    if (!settled_.prior.any()) return;
    evidence_.unknowns = settled_.determined;
    r_.profiles = free_profiles(r_.best, settled_.prior, known);
  }

  void put_curve() {
    r_.transfer_curve = curve_->fitted;
    for (const FittedTransferCurve::Exponent& e : curve_->fitted.exponents)
      r_.derived.push_back(exponent_of(e));
    evidence_.transfer_curve_words = curve_->fitted.words;
    evidence_.against_transfer_curve = curve_->against;
  }

  void judge(const SearchOutcome& outcome) {
    evidence_.aurora_in_view =
        std::any_of(point_.by_photo.begin(), point_.by_photo.end(), [](const Comparison::Point& p) {
          return std::any_of(p.aurora.value.begin(), p.aurora.value.end(), [](double x) { return x > 0.0; });
        });
    look_for_second_mode(free_, values_, outcome, r_, evidence_);
    if (evidence_.second_mode) put_second_mode(scene_, free_, evidence_.second_mode_values, r_);
    assess_fit(evidence_, r_);
    assess_quantities(r_);
  }

  const RadarTerm* radar() const { return full_.front().radar.get(); }

  const sim::Scene& scene_;
  const std::vector<FreeNumber>& free_;
  const std::vector<Observation>& observations_;
  const FitOptions& asked_;
  const FitOptions options_;
  const FoundTransferCurve* curve_;
  const FinishedSearch* done_;
  const std::vector<CostTerm> full_;
  NullJournal nowhere_;
  Journal& journal_;

  int unknowns_ = 0, residuals_ = 0;
  EvaluationLog log_, closing_log_;
  Settled settled_;
  std::vector<double> values_;  // of the free numbers, at the answer
  std::vector<PhaseAnchor> anchors_;
  std::optional<ProfileCost> cost_;
  ProfileCost::Point point_;
  Evidence evidence_;
  FitResult r_;
};

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
    add_radars(scene, observations);
    return observations;
  }
  assert(photos.size() == scene.fit.photos.size());
  for (const Photo* photo : photos)
    if (photo->unknowns > 0)
      throw sim::Error(sim::ErrorKind::scene,
                       "the transfer curve of " + photo->file_name +
                           " is unknown, and that of one photograph alone can be found")
          .file(scene.file)
          .key("fit.decoding")
          .expected("a decoding that is known")
          .hint("fit one of them by itself with --decoding unknown, and give all the curve that it finds");
  for (std::size_t i = 0; i < photos.size(); ++i) {
    const FramedScene framed = framed_scene(scene, scene.fit.photos[i]);
    observations.push_back(
        observed(with_ties(framed.scene, free, framed.frame), *photos[i], threads, framed.frame));
  }
  add_radars(scene, observations);
  return observations;
}

FitResult fit_observations(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                           const std::vector<Observation>& observations, const FitOptions& asked,
                           const FoundTransferCurve* curve, const FinishedSearch* done) {
  sim::require_earth(scene, "a fit");
  return FitRun(scene, free, observations, asked, curve, done).run();
}

}  // namespace vegard::fit
