#include "fit/fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "fit/answer/information_criteria.h"
#include "fit/compare/observation.h"
#include "fit/compare/profile_cost.h"
#include "fit/fit_observations.h"
#include "fit/parameters/free_parameters.h"
#include "fit/radar/radar_refusal.h"
#include "fit/search/journal.h"
#include "sim/base/error.h"
#include "sim/base/file/number_text.h"

// Refines the curtains of a map in a fit by beams: `vegard fit --from-map`.
//
// Each curtain becomes a sheet along a curve (fit/map/curtains/curtain_sheets.h). All sheets are first fitted
// together by a descent with exact derivatives that starts from the map. Then the fit tries to leave out
// curves, the weakest first, and to add curtains that are below the map's brightness limit, the strongest
// first. After each change all other parameters are fitted again, and the change is kept if it lowers the BIC
// (fit/answer/information_criteria.h). After an addition, the fit tries again to leave out the curves that
// the new one may replace. Two rejected changes in a row end a round. All these models are compared with the
// same values and the same sigma.

namespace vegard::fit {
namespace {

constexpr int kCurtainIterations = 60;
constexpr int kMaxRefused = 2;  // changes of a kind in a row, after which no weaker one is tried
constexpr int kMaxAdded = 6;    // faint curtains that are tried
constexpr double kShareOfStart = 0.4, kShareOfAll = 0.85;

/// Some curves, all that is free of them, and where they have settled.
struct CurtainModel {
  sim::Scene scene;  ///< with the values that were found
  std::vector<FreeNumber> free;
  Descent end;
  std::vector<TraceRow> trace;
  double chi2_initial = 0.0;
  FittedModel fitted;
};

std::string curves_in_words(std::size_t count) {
  return fmt::format("{} curve{}", count, count == 1 ? "" : "s");
}

class CurtainFit {
 public:
  CurtainFit(const sim::Scene& scene, const std::vector<Photo>& photos, const FitOptions& options)
      : given_(scene), photos_(photos), options_(options) {
    log_.limit = options.max_evaluations;
    log_.stop = options.stop;
  }

  FitResult run(const std::vector<Ridge>& curtains, const std::vector<Ridge>& faint) {
    const sim::Scene start = scene_of_ridges(given_, curtains);
    first_ = observations_of(start);
    best_ = settled(start, "curves of the map", kShareOfStart);
    if (!is_overdetermined(best_.fitted))
      throw sim::unreadable(photos_.front().file_name,
                            fmt::format("only {} usable values for the {} numbers of {}", best_.fitted.values,
                                        best_.fitted.parameters, best_.fitted.name))
          .key("fit.bands")
          .expected("more values than unknowns")
          .hint("more bands, a larger region, or a map with fewer curtains");
    record(CurtainStep::Change::start, "", best_, true, 0.0);
    drop_what_is_not_needed();
    // A curve may have stood in for one that was missing.
    if (add_what_is_missing(faint)) drop_what_is_not_needed();
    return answer();
  }

 private:
  bool stopped() const { return log_.exhausted(); }

  std::vector<Observation> observations_of(const sim::Scene& scene) const {
    const std::vector<FreeNumber> free = free_numbers(scene);
    const sim::Scene tied = with_ties(scene, free);
    std::vector<Observation> observations;
    if (scene.fit.photos.empty()) {
      observations.push_back(observed(tied, photos_.front(), options_.threads));
      return observations;
    }
    for (std::size_t i = 0; i < photos_.size(); ++i) {
      const FramedScene framed = framed_scene(tied, scene.fit.photos[i]);
      observations.push_back(
          observed(with_ties(framed.scene, free, framed.frame), photos_[i], options_.threads, framed.frame));
    }
    return observations;
  }

  /// The photographs with other curves, compared with the values and the sigma of the first ones: what the
  /// sampling of other beams makes of sigma is not to weigh in their favour.
  std::vector<Observation> seen_with(const sim::Scene& scene, const std::vector<FreeNumber>& free) const {
    std::vector<Observation> observations;
    const sim::Scene tied = with_ties(scene, free);
    for (std::size_t i = 0; i < photos_.size(); ++i) {
      Observation o;
      o.photo = &photos_[i];
      o.scene = tied;
      if (!scene.fit.photos.empty()) {
        const FramedScene framed = framed_scene(tied, scene.fit.photos[i]);
        o.frame = framed.frame;
        o.scene = with_ties(framed.scene, free, framed.frame);
      }
      o.scene = scene_of_pixels(o.scene, photos_[i]);
      o.region = first_[i].region;
      o.sum_of_weights = first_[i].sum_of_weights;
      o.sampling_error = first_[i].sampling_error;
      const auto like = [&](const Comparison& comparison, double share) {
        return std::make_unique<Comparison>(
            o.scene, photos_[i], comparison,
            Comparison::Resolution{share, kProfileSmoothing_px, options_.threads});
      };
      o.full = like(*first_[i].full, 1.0);
      o.coarse = like(*first_[i].full, o.scene.fit.search_beams);
      observations.push_back(std::move(o));
    }
    return observations;
  }

  /// A descent of everything from where a scene has it.
  CurtainModel settled(const sim::Scene& scene, const std::string& stage, double share) {
    CurtainModel model;
    model.free = free_numbers(scene);
    model.scene = scene;
    const std::vector<Observation> observations = seen_with(scene, model.free);
    const std::vector<CostTerm> terms = cost_terms(observations, model.free, Detail::full);
    if (options_.progress)
      options_.progress(stage, log_.residuals, best_.fitted.values > 0 ? per_dof(best_) : infinite(), share);
    const std::vector<double> start = start_values(model.free);
    model.end = descent_of(
        recorded_step(options_.journal, stage, model.free.size(), log_, model.trace,
                      [&] {
                        const ProfileCost cost(model.free, terms, log_);
                        return output_of(descend(cost, start, kCurtainIterations, stage, log_, model.trace));
                      }),
        model.free.size());
    model.chi2_initial = model.end.chi2_initial;
    const std::vector<double>& values = std::isfinite(model.end.chi2) ? model.end.values : start;
    ParameterMap(scene, model.free).put(values, model.scene);
    start_from(model.free, values, model.scene);

    EvaluationLog aside;
    const ProfileCost cost(model.free, terms, aside);
    const ProfileCost::Point point = cost.at(values, false);
    FittedModel& fitted = model.fitted;
    fitted.name = curves_in_words(scene.sheets.size());
    fitted.chi2 = point.chi2;
    fitted.parameters = static_cast<int>(model.free.size());
    for (std::size_t o = 0; o < observations.size(); ++o) {
      fitted.values += observations[o].full->residuals();
      fitted.parameters +=
          observations[o].full->coefficients() - observations[o].full->held_gains(point.by_photo[o]);
    }
    if (is_overdetermined(fitted))
      fitted.correlated = joint_inflation(cost, point, fitted.parameters).correlated;
    return model;
  }

  static bool is_overdetermined(const FittedModel& fitted) { return fitted.values > fitted.parameters; }
  static double infinite() { return std::numeric_limits<double>::infinity(); }
  static double per_dof(const CurtainModel& model) {
    return model.fitted.chi2 / std::max(1, model.fitted.values - model.fitted.parameters);
  }

  /// By how much BIC is lower of the second model; the richer one says how far errors are to be believed.
  static double bic_gain(const CurtainModel& before, const CurtainModel& after) {
    const bool richer = after.fitted.parameters > before.fitted.parameters;
    const ChiSquareScaling believed = chi2_scaling_of(richer ? after.fitted : before.fitted);
    return information_criteria(before.fitted, believed).bic -
           information_criteria(after.fitted, believed).bic;
  }

  void record(CurtainStep::Change change, const std::string& name, const CurtainModel& model, bool kept,
              double gain) {
    CurtainStep step;
    step.change = change;
    step.curtain = name;
    step.curtains = static_cast<int>(model.scene.sheets.size());
    step.chi2 = model.fitted.chi2;
    step.values = model.fitted.values;
    step.unknowns = model.fitted.parameters;
    step.bic_lower_by = gain;
    step.kept = kept;
    steps_.push_back(step);
  }

  /// Whether the change has been kept.
  bool tried(const sim::Scene& scene, CurtainStep::Change change, const std::string& name) {
    const bool adds = change == CurtainStep::Change::add;
    const double share = std::min(kShareOfAll, kShareOfStart + 0.05 * static_cast<double>(steps_.size()));
    const std::string stage =
        fmt::format("{} {} {}", steps_.size(), adds ? "with" : "without", name);  // its name in the journal
    CurtainModel model = settled(scene, stage, share);
    if (stopped()) {  // it has not settled
      cut_short_ = true;
      return false;
    }
    if (!is_overdetermined(model.fitted)) return false;
    const double gain = bic_gain(best_, model);
    const bool kept = gain > 0.0;
    record(change, name, model, kept, gain);
    if (!kept) return false;
    // What the answer reports as its start is where the map's curves began.
    model.chi2_initial = best_.chi2_initial;
    best_ = std::move(model);
    return true;
  }

  void drop_what_is_not_needed() {
    std::vector<std::pair<double, std::string>> by_light;
    for (const sim::Sheet& sheet : best_.scene.sheets)
      by_light.emplace_back(light_of_curtain(sheet), sheet.name);
    std::stable_sort(by_light.begin(), by_light.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    int refused = 0;
    for (const auto& [light, name] : by_light) {
      if (refused == kMaxRefused || best_.scene.sheets.size() < 2) return;
      cut_short_ = cut_short_ || stopped();
      if (stopped()) return;
      sim::Scene fewer = best_.scene;
      drop_curtain(fewer, name);
      refused = tried(fewer, CurtainStep::Change::drop, name) ? 0 : refused + 1;
    }
  }

  /// Whether any was added.
  bool add_what_is_missing(const std::vector<Ridge>& faint) {
    bool any = false;
    int refused = 0, asked = 0;
    for (const Ridge& ridge : faint) {
      if (refused == kMaxRefused || asked++ == kMaxAdded) break;
      cut_short_ = cut_short_ || stopped();
      if (stopped()) break;
      sim::Scene more = best_.scene;
      add_curtain(more, ridge);
      const bool kept = tried(more, CurtainStep::Change::add, ridge.name);
      any = any || kept;
      refused = kept ? 0 : refused + 1;
    }
    return any;
  }

  /// As any other fit's, of the curves that are left, with their descent for its search.
  FitResult answer() {
    SearchOutcome outcome;
    outcome.best = best_.end;
    outcome.chi2_initial = best_.chi2_initial;
    const FinishedSearch search{outcome, log_, best_.trace, cut_short_};
    const std::vector<Observation> observations = seen_with(best_.scene, best_.free);
    FitResult result = fit_observations(best_.scene, best_.free, observations, options_, nullptr, &search);
    result.curtain_steps = std::move(steps_);
    return result;
  }

  const sim::Scene given_;
  const std::vector<Photo>& photos_;
  const FitOptions& options_;
  std::vector<Observation> first_;
  EvaluationLog log_;
  CurtainModel best_;
  std::vector<CurtainStep> steps_;
  bool cut_short_ = false;  ///< whether a curve was not tried, or not to its end
};

}  // namespace

FitResult fit_curtains(const sim::Scene& scene, const std::vector<Photo>& photos,
                       const std::vector<Ridge>& curtains, const std::vector<Ridge>& faint,
                       const FitOptions& options) {
  assert(!curtains.empty() && !photos.empty());
  refuse_radars(scene, "the fit of a map's curtains");
  for (const Photo& photo : photos)
    if (photo.unknowns > 0)
      throw sim::Error(sim::ErrorKind::scene, "the transfer curve of " + photo.file_name + " is unknown")
          .file(scene.file)
          .key("fit.decoding")
          .expected("a decoding that is known")
          .hint("curtains are refined with the decoding that they were mapped with");
  return CurtainFit(scene, photos, options).run(curtains, faint);
}

}  // namespace vegard::fit
