#include "fit/search/search.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "fit/parameters/volume_starts.h"
#include "fit/search/journal.h"
#include "fit/search/lateral_offsets.h"
#include "fit/search/profile_rounds.h"
#include "fit/search/sine_numbers.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/dense_solvers.h"
#include "sim/base/number/random.h"

namespace vegard::fit {
namespace {

constexpr int kOverallDescents = 2;
constexpr int kShortDescent = 12;  // iterations
constexpr int kLongDescent = 60;
constexpr int kPhases = 12;         // where the sine's amplitude is fixed
constexpr double kScanRange = 1.1;  // of log(wavelength): a factor 0.58 to 1.73 about the start
// Ranges of the overall trials: of logarithms, and degrees.
constexpr double kDistances = 1.4, kSearchApart = 0.6, kEnergies = 3.0, kBearings = 24.0;
constexpr double kFootprintDistances = 0.8, kFootprintEnergies = 1.6;
constexpr int kOfFootprints = 4;             // one trial for so many of sheets
constexpr double kPull = 0.3;                // of the distance: what a start may well be off by
constexpr double kCoarsePriorWeight = 20.0;  // residuals of smoothed profiles are correlated
constexpr int kSines = 8, kSinesOfEach = 3;  // of one sheet alone, and of each of several
constexpr int kExchangeRounds = 3, kExchangeDescents = 2;
constexpr double kExchangeGain = 1e-3;  // of chi2
constexpr double kHopeless = 4.0;       // times the chi2 of the best trial: not worth a descent
constexpr int kCourseRounds = 2;
constexpr double kNearWaveNumber = 2e-3;  // per km, by which a round may move it: half a wave in 250 km
constexpr double kNearlyStraight = 0.1;
constexpr double kDamping = 1e-4;

using sim::ParameterRole;
using Values = std::vector<double>;

struct Trial {
  Values values;
  double chi2 = 0.0;
};

StepOutput output_of(const std::vector<Trial>& trials) {
  StepOutput output;
  for (const Trial& trial : trials) {
    std::vector<double>& numbers = output.numbers["trial " + std::to_string(output.numbers.size() + 1000000)];
    numbers = trial.values;
    numbers.push_back(trial.chi2);
  }
  return output;
}

std::vector<Trial> trials_of(const StepOutput& output, std::size_t free) {
  std::vector<Trial> trials;
  for (const auto& [name, numbers] : output.numbers) {
    if (numbers.size() != free + 1) output.refuse(name);
    trials.push_back({Values(numbers.begin(), numbers.end() - 1), numbers.back()});
  }
  return trials;
}

bool is(const FreeNumber& number, ParameterRole role) { return number.id.role() == role; }
bool is_periodic(const FreeNumber& n) {
  return is(n, ParameterRole::wavelength) || is(n, ParameterRole::phase);
}

/// What shapes the profile as a whole, rather than what varies along the arc.
bool is_overall(const FreeNumber& n) {
  if (is_of_volume(n)) return false;
  return is(n, ParameterRole::centre) || is(n, ParameterRole::energy) || is(n, ParameterRole::bearing) ||
         is(n, ParameterRole::energy_flux) || !n.has_path();
}

/// The coefficients of free-form profiles stay as they are until the polish: they would make up for whatever
/// a trial has wrong.
bool is_searched(const FreeNumber& n) { return !is(n, ParameterRole::profile_coefficient); }

bool is_thickness(const FreeNumber& n) { return is(n, ParameterRole::amplitude); }

std::vector<std::size_t> indices(const std::vector<FreeNumber>& free, bool (*belongs)(const FreeNumber&)) {
  std::vector<std::size_t> result;
  for (std::size_t j = 0; j < free.size(); ++j)
    if (belongs(free[j])) result.push_back(j);
  return result;
}

double inside(const FreeNumber& n, double value) { return n.value(n.coordinate(value)); }

/// A point of a seeded low-discrepancy sequence (Roberts' R_d, additive recurrence) in `dimensions`
/// dimensions.
std::vector<double> even_point(int i, int dimensions, std::uint64_t seed) {
  double root = 2.0;  // of x^(d+1) = x + 1
  for (int k = 0; k < 40; ++k) root = std::pow(1.0 + root, 1.0 / (dimensions + 1));
  std::vector<double> point(dimensions);
  for (int d = 0; d < dimensions; ++d) {
    const double shift =
        sim::uniform(sim::random_words(seed, sim::Stream::search, 0, static_cast<std::uint32_t>(d))[0]);
    const double x = shift + (i + 1) * std::pow(1.0 / root, d + 1);
    point[d] = x - std::floor(x);
  }
  return point;
}

class Search {
 public:
  Search(const sim::Scene& scene, const std::vector<FreeNumber>& free, const SearchModels& models,
         const FitOptions& options, EvaluationLog& log, std::vector<TraceRow>& trace)
      : scene_(scene),
        free_(free),
        models_(models),
        options_(options),
        log_(log),
        trace_(trace),
        coarse_(free, models.coarse, log, coarse_options()),
        full_(free, models.full, log,
              {{}, {}, spline_prior(scene, free, first_smoothness(scene)), kFirstPriorWeight, {}}),
        searched_(indices(free, is_searched)) {}

  SearchOutcome run() {
    Values start;
    for (const FreeNumber& n : free_) start.push_back(inside(n, n.start));
    SearchOutcome outcome;
    outcome.chi2_initial = full_.at(start, false).chi2;
    trace_.push_back({"start", log_.residuals, outcome.chi2_initial, start});

    std::vector<Trial> ends = {tried(start)};
    if (scene_.fit.scan_points > 0 && !searched_.empty()) {
      const Trial straight =
          trials_step("overall", 1, [&] { return std::vector<Trial>{overall(ends.front())}; }).front();
      std::vector<Trial> trials =
          trials_step("lateral offsets", 0, [&] { return by_lateral_offsets(straight); });
      if (trials.empty()) trials = trials_step("scan", 0, [&] { return scan(straight); });
      if (has_movable_footprint(free_))
        for (Trial& trial : trials_step("volumes", 0, [&] { return other_footprints(straight); }))
          trials.push_back(std::move(trial));
      trials.push_back(ends.front());  // whoever starts close is not to be led away
      sort(trials);
      ends = descend_from(trials, scene_.fit.scan_descents, "descent");
      search_sines_again(ends);
    }
    std::vector<Descent> polished;
    for (std::size_t i = 0; i < ends.size() && static_cast<int>(i) < scene_.fit.polish_descents; ++i) {
      if (i > 0 && (log_.exhausted() || ends[i].chi2 > 1.5 * ends[0].chi2)) break;
      polished.push_back(
          polish(ends[i], "polish " + std::to_string(i + 1), 0.8 + 0.1 * static_cast<double>(i)));
    }
    const auto better = [](const Descent& a, const Descent& b) { return a.chi2 < b.chi2; };
    std::stable_sort(polished.begin(), polished.end(), better);
    if (has_lost_a_sine(polished.front().values) && !log_.exhausted()) {
      std::vector<Trial> others = {tried(polished.front().values)};
      search_sines_again(others, ", polished");
      if (others.size() > 1) polished.push_back(polish(others.front(), "polish of another sine", 0.88));
      std::stable_sort(polished.begin(), polished.end(), better);
    }
    outcome.best = polished.front();
    outcome.others.assign(polished.begin() + 1, polished.end());
    return outcome;
  }

 private:
  Descent polish(const Trial& from, const std::string& stage, double share) {
    tell(stage, share);
    const ProfileCost cost(free_, models_.full, log_,
                           {{},
                            {},
                            spline_prior(scene_, free_, first_smoothness(scene_)),
                            kFirstPriorWeight,
                            anchors(free_, {}, from.values)});
    return descent_of(recorded_step(options_.journal, stage, free_.size(), log_, trace_,
                                    [&] {
                                      const Descent end = descend_off_limits(cost, from.values, kLongDescent,
                                                                             stage, log_, trace_);
                                      note(end.values, end.chi2, true);
                                      return output_of(end);
                                    }),
                      free_.size());
  }

  /// Of several sheets, one whose amplitude has gone to its lower limit.
  bool has_lost_a_sine(const Values& values) const {
    const std::vector<int> waved = waved_sheets();
    return scene_.fit.scan_points > 0 && waved.size() > 1 &&
           std::any_of(waved.begin(), waved.end(), [&](int s) {
             const int j = sine_of(s).thickness;
             return free_[j].at_limit(values[j]) && values[j] < free_[j].start;
           });
  }

  static ProfileCost::Options coarse_options() {
    ProfileCost::Options options;
    options.prior_weight = kCoarsePriorWeight;
    return options;
  }

  /// Trials found by a step of the journal, so many or more.
  std::vector<Trial> trials_step(const std::string& name, std::size_t least,
                                 const std::function<std::vector<Trial>()>& work) {
    const StepOutput output =
        recorded_step(options_.journal, name, free_.size(), log_, trace_, [&] { return output_of(work()); });
    std::vector<Trial> trials = trials_of(output, free_.size());
    if (trials.size() < least) output.refuse("trial");
    return trials;
  }

  void tell(const std::string& stage, double share) const {
    if (options_.progress)
      options_.progress(stage, log_.residuals,
                        log_.best_is_full ? log_.best_chi2 / std::max(1, full_.data_residuals())
                                          : std::numeric_limits<double>::infinity(),
                        share);
  }

  /// Keeps the best point met, for an interrupted fit. What the full model has seen goes before what the
  /// coarse one has.
  void note(const Values& values, double chi2, bool full) {
    if (!std::isfinite(chi2)) return;
    if (full == log_.best_is_full ? chi2 >= log_.best_chi2 : !full) return;
    log_.best_is_full = full;
    log_.best_chi2 = chi2;
    log_.best_values = values;
  }

  /// At some values of all free numbers, for those that are to move (none named: all).
  std::vector<PhaseAnchor> anchors(const std::vector<FreeNumber>& free, const std::vector<int>& moved,
                                   const Values& values) const {
    sim::Scene scene = scene_;
    ParameterMap(scene_, free_).put(values, scene);
    std::vector<FreeNumber> some;
    Values of_some;
    for (const int j : moved) {
      some.push_back(free[j]);
      of_some.push_back(values[j]);
    }
    return moved.empty() ? phase_anchors(scene, free, values) : phase_anchors(scene, some, of_some);
  }

  Trial tried(const Values& values) {
    const double chi2 = coarse_.at(values, false).chi2;
    return {values, std::isfinite(chi2) ? chi2 : 1e300};
  }

  static void sort(std::vector<Trial>& trials) {
    std::stable_sort(trials.begin(), trials.end(),
                     [](const Trial& a, const Trial& b) { return a.chi2 < b.chi2; });
  }

  /// A direction that the data do not determine is not to drift away during the search: every parameter but a
  /// phase is held to the user's start, by less than the least of what data say. The polish is free of it.
  std::optional<sim::Prior> gentle_pull(const FreeNumber& n) const {
    if (is_of_volume(n)) {
      const std::optional<double> error = usual_error(scene_, n, kPull);
      return error ? std::optional(sim::Prior{n.start, *error}) : std::nullopt;
    }
    if (is(n, ParameterRole::centre)) {
      double square = 0.0;
      for (const FreeNumber& other : free_)
        if (is(other, ParameterRole::centre) && other.id.element == n.id.element)
          square += other.start * other.start;
      return sim::Prior{n.start, std::max(20.0, kPull * std::sqrt(square))};
    }
    if (n.logarithmic()) return sim::Prior{n.start, 2.0 * kPull * n.start};
    if (is(n, ParameterRole::bearing)) return sim::Prior{n.start, 20.0};
    return {};
  }

  /// A descent of some parameters only, with the coarse model.
  Trial partial_descent(const Trial& from, const std::vector<std::size_t>& which, const std::string& stage) {
    std::vector<FreeNumber> pulled = free_;
    Values start;
    ProfileCost::Options moving;
    moving.held = from.values;
    for (std::size_t j : which) {
      moving.moved.push_back(static_cast<int>(j));
      if (!pulled[j].prior && (pulled[j].prior = gentle_pull(free_[j])))
        pulled[j].prior->sigma *= kCoarsePriorWeight;
      start.push_back(from.values[j]);
    }
    moving.anchors = anchors(pulled, moving.moved, from.values);
    moving.prior_weight = kCoarsePriorWeight;
    const ProfileCost cost(pulled, models_.coarse, log_, moving);
    std::vector<TraceRow> rows;
    const Descent end = descend(cost, start, kShortDescent, stage, log_, rows);
    Trial result = from;
    for (std::size_t k = 0; k < which.size(); ++k) result.values[which[k]] = end.values[k];
    result.chi2 = end.chi2;
    return result;
  }

  /// Range of the overall trials of a bearing, degrees: between limits that the user has set, most of it.
  static double turned_by(const FreeNumber& n) {
    return n.limited() ? std::max(kBearings, 0.6 * (n.max - n.min)) : kBearings;
  }

  /// Trials of distance, bearing and energy around the start, and short descents from the best. A sine with
  /// the wrong phase would pull the bearing its way, so the sheet is all but straight while this lasts.
  Trial overall(const Trial& start) {
    const std::vector<std::size_t> which = indices(free_, is_overall);
    if (which.empty() || scene_.sheets.empty()) return start;
    tell("overall", 0.02);
    Values straight = start.values;
    for (std::size_t j : indices(free_, is_thickness))
      straight[j] = inside(free_[j], kNearlyStraight * straight[j]);
    std::vector<Trial> trials = {tried(straight)};
    const int sheets = static_cast<int>(scene_.sheets.size());
    for (int i = 0; i < sheets * scene_.fit.overall_trials && !log_.exhausted(); ++i) {
      // All sheets together go out or in and turn; then each has a distance and an energy of its own. One
      // draw moves both components of a centre: along its own direction.
      const std::vector<double> u = even_point(i, 1 + 2 * sheets, scene_.seed);
      Values values = straight;
      for (std::size_t j : which) {
        const FreeNumber& n = free_[j];
        const int s = std::max(0, n.id.sheet());
        const double distance = std::exp((u[1] - 0.5) * kDistances) *
                                (s > 0 ? std::exp((u[1 + 2 * s] - 0.5) * kSearchApart) : 1.0);
        if (is(n, ParameterRole::centre)) values[j] *= distance;
        if (is(n, ParameterRole::energy)) values[j] *= std::exp((u[2 + 2 * s] - 0.5) * kEnergies);
        if (!n.has_path())
          values[j] =
              n.logarithmic() ? n.min * std::pow(n.max / n.min, u[1]) : n.min + u[1] * (n.max - n.min);
        if (is(n, ParameterRole::bearing)) values[j] += (u[0] - 0.5) * turned_by(n);
        values[j] = inside(n, values[j]);
      }
      trials.push_back(tried(values));
    }
    sort(trials);
    std::vector<Trial> ends;
    for (int i = 0; i < kOverallDescents && i < static_cast<int>(trials.size()) && !log_.exhausted(); ++i)
      ends.push_back(partial_descent(trials[i], which, "overall"));
    if (ends.empty()) ends.push_back(trials.front());
    sort(ends);
    record(ends.front(), "overall");
    return ends.front();
  }

  /// Trials of footprints nearer and farther, with more energy and less.
  std::vector<Trial> other_footprints(const Trial& from) {
    std::vector<Trial> trials;
    tell("volumes", 0.35);
    for (int i = 0; i < scene_.fit.overall_trials / kOfFootprints && !log_.exhausted(); ++i) {
      const std::vector<double> u = even_point(i, 2, scene_.seed + 2);
      trials.push_back(
          tried(moved_footprints(scene_, free_, from.values, std::exp((u[0] - 0.5) * kFootprintDistances),
                                 std::exp((u[1] - 0.5) * kFootprintEnergies))));
    }
    sort(trials);
    return trials;
  }

  SineNumbers sine_of(int sheet) const { return sine_numbers(free_, sheet); }

  /// Wavelengths between which a sheet's sine is looked for.
  std::pair<double, double> wavelengths_of(const SineNumbers& sine, int sheet, const Values& values) const {
    if (sine.wavelength < 0) {
      const double fixed = scene_at(values).sheets[sheet].wavelength_km;
      return {fixed, fixed};
    }
    const FreeNumber& n = free_[sine.wavelength];
    return {scanned_wavelength(n, values[sine.wavelength], 1.0),
            scanned_wavelength(n, values[sine.wavelength], 0.0)};
  }

  /// At home, in the frame of the free numbers.
  sim::Scene scene_at(const Values& values) const {
    sim::Scene scene = scene_;
    ParameterMap(scene_, free_).put(values, scene);
    return scene;
  }

  std::vector<std::vector<LateralOffset>> offsets_at(const Values& values) {
    ++log_.residuals;
    ++log_.jacobians;
    const CostTerm& first = models_.coarse.front();
    sim::Scene scene = first.scene;
    first.map.put(values, scene);
    return lateral_offsets(*first.comparison, scene);
  }

  /// Sheets whose sines are to be found.
  std::vector<int> waved_sheets() const {
    std::vector<int> waved;
    for (std::size_t s = 0; s < scene_.sheets.size(); ++s) {
      const SineNumbers sine = sine_of(static_cast<int>(s));
      if (sine.phase >= 0 && sine.thickness >= 0) waved.push_back(static_cast<int>(s));
    }
    return waved;
  }

  /// Trials of the sheets' sines from their offsets; none where the bands do not show enough of a sheet.
  std::vector<Trial> by_lateral_offsets(const Trial& straight) {
    const std::vector<int> waved = waved_sheets();
    if (waved.empty()) return {};
    tell("lateral offsets", 0.1);
    const auto found = offsets_at(straight.values);
    std::vector<Values> starts = {straight.values};
    for (const int s : waved) {
      const SineNumbers sine = sine_of(s);
      const auto [least, most] = wavelengths_of(sine, s, straight.values);
      const std::vector<SineThroughOffsets> sines =
          sines_through(found[s], 0.5 * scene_at(straight.values).sheets[s].length_km, least, most,
                        free_[sine.thickness].start, waved.size() > 1 ? kSinesOfEach : kSines);
      if (sines.empty()) return {};
      std::vector<Values> more;
      for (const Values& start : starts)
        for (const SineThroughOffsets& candidate : sines) {
          more.push_back(start);
          take_sine(scene_, free_, candidate, s, more.back());
        }
      starts = std::move(more);
    }
    std::vector<Trial> trials = {straight};
    for (std::size_t i = 0; i < starts.size() && !log_.exhausted(); ++i) {
      tell("lateral offsets", 0.1 + 0.3 * static_cast<double>(i) / static_cast<double>(starts.size()));
      Trial best = tried(starts[i]);
      Values values = starts[i];
      for (int round = 0; round < kCourseRounds && !log_.exhausted(); ++round) {
        const auto again = offsets_at(values);
        for (const int s : waved) {
          const SineNumbers sine = sine_of(s);
          const double length = scene_at(values).sheets[s].length_km;
          const double now = scene_at(values).sheets[s].wavelength_km;
          const auto [least, most] = wavelengths_of(sine, s, straight.values);
          const double near = sine.wavelength >= 0 ? kNearWaveNumber : 0.0;
          const std::vector<SineThroughOffsets> sines =
              sines_through(again[s], 0.5 * length, std::max(least, 1.0 / (1.0 / now + near)),
                            1.0 / std::max(1.0 / most, 1.0 / now - near), free_[sine.thickness].start, 1);
          if (!sines.empty()) take_sine(scene_, free_, sines.front(), s, values);
        }
        const Trial next = tried(values);
        if (next.chi2 < best.chi2) best = next;
      }
      trials.push_back(best);
    }
    sort(trials);
    record(trials.front(), "lateral offsets");
    return trials;
  }

  /// The wavelength at a share of the scan. Between limits that the user has set, even steps of the wave
  /// number, by which the phase at the ends of what is in view goes; else a range about the start.
  static double scanned_wavelength(const FreeNumber& n, double start_km, double share) {
    if (n.limited()) return 1.0 / (1.0 / n.max + share * (1.0 / n.min - 1.0 / n.max));
    return start_km * std::exp(kScanRange * (share - 0.5));
  }

  /// Trials of wavelength and phase, sheet by sheet, from a sheet that is all but straight. The wavelengths'
  /// steps are as fine as the phase at the far end of the arc asks for; the seed shifts their origin.
  std::vector<Trial> scan(const Trial& from) {
    std::vector<Trial> trials = {from};
    const std::vector<double> shift = even_point(0, 2, scene_.seed + 1);
    for (std::size_t s = 0; s < scene_.sheets.size(); ++s) {
      const SineNumbers sine = sine_of(static_cast<int>(s));
      if (sine.wavelength < 0 && sine.phase < 0) continue;
      const Trial base = trials.front();
      const int wavelengths = sine.wavelength < 0 ? 1 : scene_.fit.scan_points;
      for (int w = 0; w < wavelengths && !log_.exhausted(); ++w) {
        tell("scan", 0.1 + 0.3 * w / wavelengths);
        Values values = base.values;
        if (sine.wavelength >= 0)
          values[sine.wavelength] = inside(free_[sine.wavelength],
                                           scanned_wavelength(free_[sine.wavelength], values[sine.wavelength],
                                                              (w + shift[0]) / wavelengths));
        if (sine.phase >= 0 && sine.thickness >= 0)
          trials.push_back(straightest_sine(values, sine));
        else
          for (int f = 0; sine.phase >= 0 && f < kPhases; ++f) {
            values[sine.phase] = inside(free_[sine.phase],
                                        base.values[sine.phase] + 2.0 * sim::kPi * (f + shift[1]) / kPhases);
            trials.push_back(tried(values));
          }
      }
      sort(trials);
    }
    record(trials.front(), "scan");
    return trials;
  }

  /// The sine of given wavelength that fits best, to first order: w sin(x + phase) = a sin x + b cos x is
  /// linear in a and b, so two Jacobians of a nearly straight sheet, with phases 0 and a quarter turn, give a
  /// and b together with the steps of everything else but the wavelength. One evaluation then tells what the
  /// trial is worth.
  Trial straightest_sine(Values values, const SineNumbers& sine) {
    const std::size_t n = free_.size();
    values[sine.phase] = inside(free_[sine.phase], 0.0);
    const ProfileCost::Point point = coarse_.at(values, true);
    std::vector<double> in_phase, quadrature;
    coarse_.data_jacobian(point, in_phase);
    Values turned = values;
    turned[sine.phase] = inside(free_[sine.phase], 0.5 * sim::kPi);
    const ProfileCost::Point quarter = coarse_.at(turned, true);
    coarse_.data_jacobian(quarter, quadrature);

    // Normal equations of residual + J step, columns: all coordinates but wavelength and phase, then
    // quadrature.
    const auto m = static_cast<Eigen::Index>(n + 1);
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(m, m);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(m), row(m);
    const std::vector<double> residual = coarse_.data_residual(point);
    for (std::size_t k = 0; k < residual.size(); ++k) {
      for (std::size_t j = 0; j < n; ++j)
        row(static_cast<Eigen::Index>(j)) = is_searched(free_[j]) ? in_phase[k * n + j] : 0.0;
      row(static_cast<Eigen::Index>(n)) = quadrature[k * n + sine.thickness];
      row(sine.phase) = 0.0;
      if (sine.wavelength >= 0) row(sine.wavelength) = 0.0;
      normal.selfadjointView<Eigen::Lower>().rankUpdate(row);
      right -= row * residual[k];
    }
    normal = normal.selfadjointView<Eigen::Lower>();
    for (Eigen::Index j = 0; j < m; ++j)
      normal(j, j) = normal(j, j) * (1.0 + kDamping) + (normal(j, j) > 0.0 ? 0.0 : 1.0);
    const Eigen::VectorXd step = sim::solve_symmetric(normal, right);

    const double a = step(sine.thickness) + values[sine.thickness], b = step(static_cast<Eigen::Index>(n));
    Values best = values;
    for (std::size_t j = 0; j < n; ++j) {
      const FreeNumber& number = free_[j];
      if (static_cast<int>(j) == sine.thickness || static_cast<int>(j) == sine.phase ||
          !std::isfinite(step(static_cast<Eigen::Index>(j))))
        continue;
      const double most = number.logarithmic() ? 0.3 * values[j] : std::max(0.1 * std::abs(values[j]), 5.0);
      best[j] = inside(number, values[j] + std::clamp(step(static_cast<Eigen::Index>(j)), -most, most));
    }
    if (std::isfinite(a) && std::isfinite(b)) {
      const double usual = free_[sine.thickness].start;
      best[sine.thickness] =
          inside(free_[sine.thickness], std::clamp(std::hypot(a, b), 0.2 * usual, 3.0 * usual));
      best[sine.phase] = inside(free_[sine.phase], std::atan2(b, a));
    }
    return tried(best);
  }

  /// Short descents of everything from the best distinct trials.
  std::vector<Trial> descend_from(const std::vector<Trial>& trials, int most, const std::string& stage) {
    std::vector<Trial> starts;
    for (const Trial& trial : trials) {
      if (static_cast<int>(starts.size()) >= most) break;
      if (!starts.empty() && trial.chi2 > kHopeless * starts.front().chi2) break;
      const auto near = [&](const Trial& other) { return same_valley(trial.values, other.values); };
      if (std::none_of(starts.begin(), starts.end(), near)) starts.push_back(trial);
    }
    std::vector<Trial> ends;
    for (std::size_t i = 0; i < starts.size() && !log_.exhausted(); ++i) {
      tell(stage + " " + std::to_string(i + 1), 0.4 + 0.4 * static_cast<double>(i) / starts.size());
      const std::string name = stage + " " + std::to_string(i + 1);
      ends.push_back(trials_step(name, 1, [&] {
                       const Trial end = partial_descent(starts[i], searched_, stage);
                       record(end, name);
                       return std::vector<Trial>{end};
                     }).front());
    }
    if (ends.empty()) ends.push_back(trials.front());
    sort(ends);
    std::vector<Trial> distinct;
    for (const Trial& end : ends) {
      const auto near = [&](const Trial& other) { return same_valley(end.values, other.values); };
      if (std::none_of(distinct.begin(), distinct.end(), near)) distinct.push_back(end);
    }
    return distinct;
  }

  /// Two points are in one valley if their periodic parameters are: wavelengths within 5 %, phases within a
  /// sixth of a turn, and their footprints at like distances.
  bool same_valley(const Values& a, const Values& b) const {
    for (std::size_t j : indices(free_, is_periodic)) {
      if (is(free_[j], ParameterRole::wavelength) && std::abs(std::log(a[j] / b[j])) > 0.05) return false;
      if (is(free_[j], ParameterRole::phase) &&
          std::abs(std::remainder(a[j] - b[j], 2.0 * sim::kPi)) > sim::kPi / 3.0)
        return false;
    }
    return !footprints_differ(scene_, free_, a, b);
  }

  /// Sheets that stand one behind the other take each other's waves in the first trials. So pairs exchange
  /// their sines, each sheet's sine is looked for again with the others as they were found, and what explains
  /// the picture better goes to the front of `ends`, until no sheet gives way.
  void search_sines_again(std::vector<Trial>& ends, const std::string& of = {}) {
    const std::vector<int> waved = waved_sheets();
    if (waved.size() < 2) return;
    for (int round = 0; round < kExchangeRounds; ++round) {
      bool any_better = false;
      const auto try_step = [&](const std::string& what, const std::function<std::vector<Trial>()>& work) {
        if (log_.exhausted()) return;
        tell(what, 0.8);
        const std::vector<Trial> found = trials_step(what, 0, work);
        if (found.empty() || found.front().chi2 > (1.0 - kExchangeGain) * ends.front().chi2) return;
        ends.insert(ends.begin(), found.front());
        any_better = true;
      };
      const std::string exchange = " exchange " + std::to_string(round + 1) + of;
      for (std::size_t i = 0; i + 1 < waved.size(); ++i) {
        const std::string name =
            "sheets " + std::to_string(waved[i] + 1) + " and " + std::to_string(waved[i + 1] + 1) + exchange;
        try_step(name, [&] { return with_sines_exchanged(ends.front(), waved[i], waved[i + 1], name); });
      }
      for (const int s : waved) {
        const std::string name = "sheet " + std::to_string(s + 1) + exchange;
        try_step(name, [&] { return with_another_sine(ends.front(), s, name); });
      }
      if (!any_better) return;
    }
  }

  /// A descent from where two sheets have each other's sine; none where these are not free in both.
  std::vector<Trial> with_sines_exchanged(const Trial& from, int first, int second,
                                          const std::string& stage) {
    const SineNumbers a = sine_of(first), b = sine_of(second);
    Values values = from.values;
    for (const auto& [i, j] :
         {std::pair(a.wavelength, b.wavelength), {a.phase, b.phase}, {a.thickness, b.thickness}}) {
      if (i < 0 || j < 0) return {};
      values[i] = inside(free_[i], from.values[j]);
      values[j] = inside(free_[j], from.values[i]);
    }
    if (same_valley(from.values, values)) return {};
    const Trial end = partial_descent(tried(values), searched_, stage);
    record(end, stage);
    return {end};
  }

  /// Descents from where one sheet has another sine, best first: through its lateral offsets when it is
  /// all but straight, and as it shows about the sine that it has.
  std::vector<Trial> with_another_sine(const Trial& from, int sheet, const std::string& stage) {
    const SineNumbers sine = sine_of(sheet);
    const auto [least, most] = wavelengths_of(sine, sheet, from.values);
    Values straight = from.values;
    straight[sine.thickness] = inside(free_[sine.thickness], kNearlyStraight * straight[sine.thickness]);
    std::vector<Trial> trials;
    for (const Values& values : {straight, from.values})
      for (const SineThroughOffsets& candidate :
           sines_through(offsets_at(values)[sheet], 0.5 * scene_at(values).sheets[sheet].length_km, least,
                         most, free_[sine.thickness].start, kSines)) {
        Values other = from.values;
        take_sine(scene_, free_, candidate, sheet, other);
        const auto is_near = [&](const Trial& trial) { return same_valley(trial.values, other); };
        if (!same_valley(from.values, other) && std::none_of(trials.begin(), trials.end(), is_near))
          trials.push_back(tried(other));
      }
    sort(trials);
    std::vector<Trial> ends;
    for (int i = 0; i < kExchangeDescents && i < static_cast<int>(trials.size()) && !log_.exhausted(); ++i)
      ends.push_back(partial_descent(trials[i], searched_, stage));
    sort(ends);
    if (!ends.empty()) record(ends.front(), stage);
    return ends;
  }

  void record(const Trial& trial, const std::string& stage) {
    if (!std::isfinite(trial.chi2)) return;
    note(trial.values, trial.chi2, false);
    trace_.push_back({stage, log_.residuals, trial.chi2, trial.values});
  }

  const sim::Scene& scene_;
  const std::vector<FreeNumber>& free_;
  const SearchModels& models_;
  const FitOptions& options_;
  EvaluationLog& log_;
  std::vector<TraceRow>& trace_;
  const ProfileCost coarse_, full_;
  const std::vector<std::size_t> searched_;
};

}  // namespace

SearchOutcome search(const sim::Scene& scene, const std::vector<FreeNumber>& free, const SearchModels& models,
                     const FitOptions& options, EvaluationLog& log, std::vector<TraceRow>& trace) {
  return Search(scene, free, models, options, log, trace).run();
}

}  // namespace vegard::fit
