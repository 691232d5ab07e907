#include "fit/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "fit/derived.h"
#include "fit/flat_directions.h"
#include "fit/free_parameters.h"
#include "fit/free_profile.h"
#include "fit/noise_model.h"
#include "fit/profile_rounds.h"
#include "fit/search.h"
#include "fit/smoothing.h"
#include "fit/uncertainty.h"
#include "fit/verdict.h"
#include "sim/base/error.h"
#include "sim/view/line_colours.h"
#include "sim/view/night_sky.h"

namespace vegard::fit {
namespace {

constexpr double kCoarseShare = 0.25;  // of the beams, for the search
constexpr double kSmoothing = 0.025;   // of the region's height, for the search
constexpr double kSearchError = 0.1;   // the search weighs bright and dark alike
constexpr double kSearchPeakShare = 0.5;
constexpr int kSamplings = 8;        // for the error bars
constexpr double kSecondMode = 4.0;  // difference of chi2 (two standard deviations) in units of the inflation

void check_sizes(const sim::Scene& scene, const Photo& photo) {
  if (photo.linear.width == scene.camera.width && photo.linear.height == scene.camera.height) return;
  const auto size = [](int w, int h) { return std::to_string(w) + " x " + std::to_string(h); };
  throw sim::Error(
      sim::ErrorKind::scene,
      {"the camera has " + size(scene.camera.width, scene.camera.height) + " pixels, " + photo.file_name +
           " has " + size(photo.linear.width, photo.linear.height),
       scene.file, 0, "camera.width", "the photograph's size", "set camera.width and camera.height"});
}

/// A film that counts points, or puts each into one cell, has no derivative by the points' places; nor has
/// the physical blur any here.
void check_film(const sim::Scene& scene) {
  const auto refuse = [&](const char* key, const std::string& value, const char* needed, const char* hint) {
    if (value == needed) return;
    throw sim::Error(sim::ErrorKind::scene, {"\"" + value + "\" cannot be fitted", scene.file, 0, key,
                                             "\"" + std::string(needed) + "\"", hint});
  };
  const char* literal = "the literal forward map is for rendering only";
  refuse("film.weight", scene.film.weight, "rayleigh", literal);
  refuse("film.splat", scene.film.splat, "bilinear", literal);
  refuse("blur.model", scene.blur.model, "angle", "the physical blur is for rendering only");
}

/// 360 or 2 pi for an angle, 0 for anything else.
double full_turn(const FreeNumber& n) {
  if (n.path.row->scale != sim::ParameterScale::angle) return 0.0;
  return n.path.row->unit == "rad" ? 2.0 * std::acos(-1.0) : 360.0;
}

/// An angle without needless turns, unless the user's own limits say which turn is meant.
double tidy(const FreeNumber& n, double value) {
  const double turn = full_turn(n);
  if (turn == 0.0 || n.min > n.path.row->min || n.max < n.path.row->max) return value;
  return value - turn * std::floor(value / turn);
}

/// The sky alone, with the night sky's known lights where the fit ended.
double chi2_without_aurora(const LinearPart& linear, const ModelProfile& aurora) {
  ModelProfile dark;
  dark.value.assign(aurora.value.size(), 0.0);
  dark.offset = aurora.offset;
  return linear.solve(dark).chi2;
}

/// Of single numbers; what smooth profiles cost is no matter of data.
double chi2_of_priors(const std::vector<FreeNumber>& free, const std::vector<double>& values) {
  std::vector<double> residuals;
  PriorRows(free).evaluate(values, residuals, nullptr);
  return std::accumulate(residuals.begin(), residuals.end(), 0.0,
                         [](double sum, double x) { return sum + x * x; });
}

double rms_over_peak(const FitResult& r) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < r.model.size(); ++i) {
    if (r.sigma[i] <= 0.0) continue;
    sum += std::pow(r.data.mean[i] - r.model[i], 2);
    ++count;
  }
  const double peak = profile_peak(r.data);
  return count > 0 && peak > 0.0 ? std::sqrt(sum / static_cast<double>(count)) / peak : 0.0;
}

/// Gains and sky into the result and into its best scene.
void put_solution(const ProfileCost::Point& point, const ValueUncertainty& known, const LinearPart& linear,
                  const GainLayout& gains, FitResult& r) {
  const LinearSolution& solution = point.solution;
  const std::vector<double> variance =
      linear.coefficient_variance(point.aurora, solution, r.error_inflation, known.covariance);
  static const char* const kChannel[3] = {"red", "green", "blue"};
  const auto solved = [&](const std::string& name, int j) {
    SolvedNumber s{name, solution.coefficients[j], {}};
    if (variance[j] > 0.0) s.sigma = std::sqrt(variance[j]);
    r.solved.push_back(s);
  };
  for (int b = 0; b < (gains.per_band ? gains.bands : 1); ++b)
    for (int c = 0; c < (gains.per_channel ? 3 : 1); ++c)
      solved(std::string("gain") + (gains.per_band ? ".band_" + std::to_string(b) : "") +
                 (gains.per_channel ? std::string(".") + kChannel[c] : ""),
             gains.column(b, c));
  double sum = 0.0;
  int lit = 0;
  r.gain.assign(r.data.bands, std::vector<double>(3));
  for (int b = 0; b < r.data.bands; ++b)
    for (int c = 0; c < 3; ++c) {
      r.gain[b][c] = solution.coefficients[gains.column(b, c)];
      if (r.gain[b][c] > 0.0) {
        sum += r.gain[b][c];
        ++lit;
      }
    }
  if (lit > 0) {
    // The night sky's lights keep the brightness that they had in the fit.
    if (sim::has_night_sky(r.best))
      r.best.sky.lights_gain *= sim::gain_per_kilorayleigh(r.best) / (sum / lit);
    r.best.sensor.exposure = "gain";  // found, in place of what the camera's settings say
    r.best.sensor.gain_per_kilorayleigh = sum / lit;
  }
  static const char* const kTerm[3] = {"level", "gradient", "curvature"};
  std::array<double, 3>* const terms[3] = {&r.best.sky.level, &r.best.sky.gradient, &r.best.sky.curvature};
  for (int t = 0; t < 3; ++t)
    for (int c = 0; c < 3; ++c) {
      (*terms[t])[c] = t < linear.sky_terms() ? solution.coefficients[linear.sky(t, c)] : 0.0;
      if (t < linear.sky_terms())
        solved(std::string("sky.") + kTerm[t] + "." + kChannel[c], linear.sky(t, c));
    }
}

/// "it trades off against sheet.main.phase_rad", from the undetermined direction that a coordinate leans on
/// most.
std::string why_undetermined(const std::vector<FreeNumber>& free, const Uncertainty& u, std::size_t j) {
  const std::vector<double>* most = nullptr;
  for (const std::vector<double>& direction : u.undetermined)
    if (most == nullptr || std::abs(direction[j]) > std::abs((*most)[j])) most = &direction;
  std::string others;
  for (std::size_t k = 0; most != nullptr && k < free.size(); ++k)
    if (k != j && (*most)[k] != 0.0) others += (others.empty() ? "" : " and ") + free[k].path.text;
  return others.empty() ? "the data do not bound it" : "it trades off against " + others;
}

/// Parameters with their error bars; returns what is known of combinations of them.
ValueUncertainty put_parameters(const std::vector<FreeNumber>& free, const std::vector<double>& values,
                                const Uncertainty& u, bool stopped, FitResult& r) {
  ValueUncertainty known{u.covariance, u.undetermined};
  std::vector<double> slopes;
  for (std::size_t j = 0; j < free.size(); ++j) {
    const FreeNumber& n = free[j];
    FittedParameter p;
    p.path = n.path.text;
    p.unit = n.path.row->unit;
    p.meaning = n.path.row->meaning;
    p.value = tidy(n, values[j]);
    p.initial = n.start;
    p.min = n.min;
    p.max = n.max;
    p.at_limit = n.at_limit(values[j]);
    p.of_profile = n.path.row->key == "spline_rate";
    const double at = n.coordinate(values[j]);
    slopes.push_back(n.slope(at));
    const double sigma = u.sigma[j] * slopes[j];
    if (std::isfinite(sigma)) {
      p.sigma = sigma;
      const double shift = p.value - values[j];
      p.interval68 = {n.value(at - u.sigma[j]) + shift, n.value(at + u.sigma[j]) + shift};
    } else {
      p.why_no_sigma = stopped ? "the fit was interrupted" : why_undetermined(free, u, j);
    }
    r.parameters.push_back(p);
  }
  r.correlation = u.correlation;
  for (std::size_t j = 0; j < free.size(); ++j)
    for (std::size_t k = 0; k < free.size(); ++k) known.covariance[j][k] *= slopes[j] * slopes[k];
  for (std::vector<double>& direction : known.undetermined)
    for (std::size_t j = 0; j < free.size(); ++j) direction[j] *= slopes[j];
  return known;
}

/// By coordinate: a free-form profile's, which its smoothness bounds where the data do not.
std::vector<bool> bounded_by_prior(const SplinePrior& prior, std::size_t coordinates) {
  std::vector<bool> bounded(coordinates, false);
  for (const SplineLine& line : prior.lines)
    for (const int j : line.numbers) bounded[j] = true;
  return bounded;
}

/// An interrupted fit is to end at once.
Uncertainty no_uncertainty(std::size_t coordinates, double inflation) {
  Uncertainty u;
  u.inflation = inflation;
  u.sigma.assign(coordinates, std::numeric_limits<double>::quiet_NaN());
  u.correlation.assign(coordinates, std::vector<double>(coordinates, 0.0));
  u.covariance = u.correlation;
  return u;
}

/// Error bars from several samplings of the same scene (see uncertainty.h).
Uncertainty sampled_uncertainty(const sim::Scene& scene, const Photo& photo, const Region& region,
                                const std::vector<FreeNumber>& free, const std::vector<double>& values,
                                const LinearPart& linear, const SplinePrior& prior, double inflation,
                                int threads) {
  const std::size_t n = free.size();
  std::vector<double> slopes;
  for (std::size_t j = 0; j < n; ++j) slopes.push_back(free[j].slope(free[j].coordinate(values[j])));
  PriorRows rows(free);
  append_rows(prior, scene, 1.0, rows);
  std::vector<double> ignored, by_value, prior_information(n * n, 0.0);
  rows.evaluate(values, ignored, &by_value);
  for (std::size_t r = 0; r < rows.count(); ++r)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k)
        prior_information[j * n + k] += by_value[r * n + j] * slopes[j] * by_value[r * n + k] * slopes[k];
  EvaluationLog closing;
  std::vector<std::vector<double>> jacobians;
  for (int sampling = 0; sampling < kSamplings; ++sampling) {
    sim::Scene other = scene;
    put_values(other, free, values);
    other.seed += static_cast<std::uint64_t>(sampling);
    ProfileModel model(other, photo, region, scene.fit.bands, 1.0, 0.0, threads);
    const ProfileCost::Point sampled = ProfileCost(other, free, model, linear, closing).at(values, true);
    jacobians.emplace_back();
    linear.jacobian(sampled.aurora, sampled.solution, jacobians.back());
    for (std::size_t k = 0; k < jacobians.back().size(); ++k) jacobians.back()[k] *= slopes[k % n];
  }
  return uncertainty(jacobians, linear.residuals(), static_cast<int>(n), prior_information, inflation);
}

}  // namespace

FitResult fit_photo(const sim::Scene& scene, const Photo& photo, const FitOptions& options) {
  check_sizes(scene, photo);
  check_film(scene);
  const std::vector<FreeNumber> free = free_numbers(scene);
  const Region region = checked_region(scene.fit.roi_px, photo.linear.width, photo.linear.height);

  FitResult r;
  r.seed = scene.seed;
  r.decoding = photo.decoding;
  r.data = extract_profile(photo, region, scene.fit.bands);
  r.sigma = profile_sigma(r.data, scene.fit.model_error);
  const GainLayout gains{scene.fit.bands, scene.fit.band_brightness, !scene.fit.white_balance_known};
  const LinearPart linear(r.data, r.sigma, gains, scene.fit.sky_terms, photo.linear.height);
  const int unknowns = static_cast<int>(free.size()) + linear.coefficients();
  if (linear.residuals() <= unknowns)
    throw sim::Error(
        sim::ErrorKind::unreadable_input,
        {"only " + std::to_string(linear.residuals()) + " usable profile values in the region of interest",
         photo.file_name, 0, "fit.roi_px", "more than " + std::to_string(unknowns),
         "is everything masked or clipped?"});

  const double smooth_rows = kSmoothing * region.height;
  const Profile smooth_data = smoothed(r.data, smooth_rows);
  const std::vector<double> smooth_sigma = profile_sigma(smooth_data, kSearchError, kSearchPeakShare);
  const LinearPart coarse_linear(smooth_data, smooth_sigma, gains, scene.fit.sky_terms, photo.linear.height);
  ProfileModel coarse(scene, photo, region, scene.fit.bands, kCoarseShare, smooth_rows, options.threads);
  ProfileModel full(scene, photo, region, scene.fit.bands, 1.0, 0.0, options.threads);
  EvaluationLog log;
  log.limit = options.max_evaluations;
  log.stop = options.stop;

  Evidence evidence;
  const SearchOutcome outcome =
      search(scene, free, {coarse, coarse_linear, full, linear}, options, log, r.trace);
  r.chi2_initial = outcome.chi2_initial;
  r.termination = outcome.best.termination;
  Descent best = outcome.best;
  SettledProfiles profiles;
  if (!spline_lines(scene, free).empty()) {
    profiles = settle_profiles(scene, free, full, linear, r.data, best, log, r.trace);
    best = profiles.descent;
    r.termination = best.termination;
  }
  evidence.converged = best.converged;
  evidence.stopped = options.stop != nullptr && options.stop->load();
  if (evidence.stopped) r.termination = words_for_stop(log);
  evidence.out_of_evaluations = !evidence.converged && log.residuals >= log.limit;
  std::vector<double> values = best.values;
  if (!evidence.converged && !log.best_values.empty()) values = log.best_values;

  // The last word: full model, exact Jacobian, whatever the limit on evaluations says.
  r.evaluations = log.residuals;
  r.jacobian_evaluations = log.jacobians;
  EvaluationLog closing;
  const ProfileCost cost(scene, free, full, linear, closing, profiles.prior, profiles.inflation);
  const ProfileCost::Point point = cost.at(values, true);
  evidence.chi2_without_aurora = chi2_without_aurora(linear, point.aurora);
  const int held = static_cast<int>(std::count(point.solution.held.begin(), point.solution.held.end(), true));
  r.chi2 = point.solution.chi2 + chi2_of_priors(free, values);
  const auto has_prior = [](const FreeNumber& number) { return number.prior.has_value(); };
  const int priors = static_cast<int>(std::count_if(free.begin(), free.end(), has_prior));
  r.dof = linear.residuals() + priors - unknowns + held;
  r.error_inflation = error_inflation(r.data, linear.used(), point.solution.residual, r.dof);

  const std::size_t n = free.size();
  Uncertainty u = evidence.stopped ? no_uncertainty(n, r.error_inflation)
                                   : sampled_uncertainty(scene, photo, region, free, values, linear,
                                                         profiles.prior, r.error_inflation, options.threads);
  if (!evidence.stopped)
    drop_flat_directions(
        [&](const std::vector<double>& step) {
          std::vector<double> moved(n);
          for (std::size_t k = 0; k < n; ++k)
            moved[k] = free[k].value(free[k].coordinate(values[k]) + step[k]);
          return (cost.at(moved, false).chi2 - point.chi2) / (r.error_inflation * r.error_inflation);
        },
        bounded_by_prior(profiles.prior, n), u);

  r.best = scene;
  r.model = linear.model(point.aurora, point.solution);
  const ValueUncertainty known = put_parameters(free, values, u, evidence.stopped, r);
  std::vector<double> tidied;
  for (const FittedParameter& p : r.parameters) tidied.push_back(p.value);
  put_values(r.best, free, tidied);
  put_solution(point, known, linear, gains, r);
  r.derived = derived_numbers(r.best, free, tidied, known);
  r.rms_over_peak = rms_over_peak(r);

  if (profiles.prior.any()) {
    evidence.unknowns = profiles.determined;
    r.profiles = free_profiles(r.best, profiles.prior, known);
  }
  evidence.aurora_in_view = std::any_of(point.aurora.value.begin(), point.aurora.value.end(),
                                        [](double light) { return light > 0.0; });
  for (const Descent& other : outcome.others) {
    const double difference = (other.chi2 - r.chi2) / (r.error_inflation * r.error_inflation);
    if (difference > kSecondMode) continue;
    for (std::size_t j = 0; j < n; ++j) {
      double apart = std::abs(other.values[j] - values[j]);
      if (const double turn = full_turn(free[j]); turn > 0.0) apart = std::abs(std::remainder(apart, turn));
      if (r.parameters[j].sigma && apart > 3.0 * *r.parameters[j].sigma) {
        evidence.second_mode = true;
        evidence.second_mode_text = "another answer explains the data almost as well, with " +
                                    free[j].path.text + " = " +
                                    std::to_string(tidy(free[j], other.values[j]));
        break;
      }
    }
  }
  judge(evidence, r);
  return r;
}

}  // namespace vegard::fit
