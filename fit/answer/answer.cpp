#include "fit/answer/answer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "fit/measure/noise_model.h"
#include "fit/parameters/free_parameters.h"
#include "fit/photo/grey_light.h"
#include "fit/uncertainty/trade_off.h"
#include "sim/scene/rows/spline_rates.h"
#include "sim/scene/rows/value_words.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sky/night_sky.h"

namespace vegard::fit {
namespace {

constexpr double kUnmoved = 1e-6;  // of the start, or of one unit where that is more

constexpr std::size_t kMaxSentences = 4;

/// A sentence for each direction in which the data say nothing, in the numbers' own units.
std::vector<std::string> undetermined_words(const std::vector<DescribedNumber>& numbers,
                                            const std::vector<std::vector<double>>& directions) {
  std::vector<std::string> all;
  for (const std::vector<double>& direction : directions) {
    const std::string words = trade_off_text(numbers, direction);
    if (!words.empty() && std::find(all.begin(), all.end(), words) == all.end()) all.push_back(words);
  }
  if (all.size() <= kMaxSentences) return all;
  const std::size_t more = all.size() - kMaxSentences;
  all.resize(kMaxSentences);
  all.push_back(std::to_string(more) + " more " + (more == 1 ? "change" : "changes") +
                " that the data do not constrain");
  return all;
}

}  // namespace

ValueUncertainty put_parameters(const sim::Scene& scene, const std::vector<FreeNumber>& free,
                                const std::vector<double>& values, const Uncertainty& u, bool stopped,
                                FitResult& r) {
  ValueUncertainty known{u.covariance, u.undetermined, u.modes};
  std::vector<double> slopes;
  for (std::size_t j = 0; j < free.size(); ++j) {
    const FreeNumber& n = free[j];
    FittedParameter p;
    p.path = n.label();
    p.photo = n.photo;
    p.unit = n.unit();
    p.meaning = n.meaning();
    p.value = wrapped_angle(n, values[j]);
    p.initial = n.start;
    p.min = n.min;
    p.max = n.max;
    p.at_limit = n.at_limit(values[j]);
    p.relative = n.logarithmic();
    p.of_profile = n.id.role() == sim::ParameterRole::profile_coefficient;
    const double way = wrapped_difference(n, values[j], n.start);
    p.moved = way > kUnmoved * (n.logarithmic() ? std::abs(n.start) : std::max(1.0, std::abs(n.start)));
    const double at = n.coordinate(values[j]);
    slopes.push_back(n.slope(at));
    const double sigma = u.sigma[j] * slopes[j];
    if (std::isfinite(sigma)) {
      p.sigma = sigma;
      if (!u.by_bands.empty()) p.by_bands = u.by_bands[j];
      p.moved_sigma = way / sigma;
      const double shift = p.value - values[j];
      p.interval68 = {n.value(at - u.sigma[j]) + shift, n.value(at + u.sigma[j]) + shift};
    } else {
      p.why_no_sigma = stopped ? "the fit was interrupted" : why_undetermined(scene, free, values, u, j);
    }
    r.parameters.push_back(p);
  }
  r.correlation = u.correlation;
  for (std::size_t j = 0; j < free.size(); ++j)
    for (std::size_t k = 0; k < free.size(); ++k) known.covariance[j][k] *= slopes[j] * slopes[k];
  for (std::vector<double>& direction : known.undetermined)
    for (std::size_t j = 0; j < free.size(); ++j) direction[j] *= slopes[j];
  for (ModeShift& mode : known.modes)
    for (std::size_t j = 0; j < free.size(); ++j) {
      mode.shift[j] *= slopes[j];
      r.parameters[j].by_mode.push_back(mode.shift[j]);
    }
  const std::vector<DescribedNumber> described = described_numbers(scene, free, values);
  std::vector<double> sigma;
  for (std::size_t j = 0; j < free.size(); ++j) sigma.push_back(u.sigma[j] * slopes[j]);
  r.trade_offs = strong_correlations(described, sigma, u.correlation);
  r.undetermined = undetermined_words(described, known.undetermined);
  return known;
}

std::vector<TiedNumber> tied_numbers(const ParameterMap& map, const std::vector<double>& values,
                                     const sim::Scene& scene, const ValueUncertainty& known) {
  std::vector<TiedNumber> result;
  for (const ParameterMap::Dependent& d : map.dependents(values, scene)) {
    TiedNumber tied{sim::path_of(scene, d.id), d.id.row->unit, d.id.row->meaning, d.equals, 0.0, {}};
    tied.value = *sim::number_at(scene, d.id);
    tied.sigma = combined_sigma(d.slopes, known);
    result.push_back(tied);
  }
  return result;
}

namespace {

/// Writes the gains and the sky that a photograph's fit has solved for.
class SolvedNumbers {
 public:
  SolvedNumbers(const Comparison& comparison, const Comparison::Point& point, const ValueUncertainty& known,
                double error_inflation, std::size_t photo, FittedPhoto& r)
      : linear_(comparison.linear()),
        gains_(comparison.gains()),
        solution_(point.solution),
        variance_(linear_.coefficient_variance(point.aurora, solution_, error_inflation, known.covariance)),
        grey_(is_grey(r.best)),
        r_(r) {
    consider_modes(point.aurora, known.modes, photo);
  }

  void put_gains() {
    for (int b = 0; b < (gains_.per_band ? gains_.bands : 1); ++b)
      for (int c = 0; c < (gains_.per_channel ? 3 : 1); ++c) {
        if (gains_.per_channel && !has_channel(r_.best, c)) continue;
        put(std::string("gain") + (gains_.per_band ? ".band_" + std::to_string(b) : "") +
                (gains_.per_channel ? std::string(".") + kChannel[c] : ""),
            gains_.column(b, c));
      }
    const double mean = mean_gain();
    if (!(mean > 0.0)) return;
    // The night sky's lights keep the brightness that they had in the fit.
    if (sim::has_night_sky(r_.best)) r_.best.sky.lights_gain *= sim::gain_per_kilorayleigh(r_.best) / mean;
    r_.best.sensor.exposure = sim::ExposureRule::gain;  // found, in place of what the camera's settings say
    r_.best.sensor.gain_per_kilorayleigh = mean;
  }

  void put_sky() {
    static const char* const kTerm[3] = {"level", "gradient", "curvature"};
    sim::Sky& sky = r_.best.sky;
    std::array<double, 3>* const terms[3] = {&sky.level, &sky.gradient, &sky.curvature};
    // Skies of bands run along their profiles, which the picture's does not: it has their mean level.
    const int skies = linear_.skies();
    for (int t = 0; t < 3; ++t)
      for (int c = 0; c < 3; ++c) {
        const bool is_solved = t < linear_.sky_terms();
        (*terms[t])[c] = is_solved && skies == 1 ? solution_.coefficients[linear_.sky(t, c)] : 0.0;
        double levels = 0.0;
        int seen = 0;
        for (int b = 0; b < skies && is_solved && has_channel(r_.best, c); ++b) {
          if (skies > 1 && variance_[linear_.sky(t, c, b)] <= 0.0) continue;  // unconstrained
          levels += solution_.coefficients[linear_.sky(t, c, b)];
          ++seen;
          put(std::string("sky.") + (skies > 1 ? "band_" + std::to_string(b) + "." : "") + kTerm[t] + "." +
                  kChannel[c],
              linear_.sky(t, c, b));
        }
        if (skies > 1 && t == 0 && seen > 0) (*terms[t])[c] = levels / seen;
      }
    // A grey sensor's channels are one, which was solved for.
    if (grey_)
      for (std::array<double, 3>* term : terms) term->fill((*term)[kGreyChannel]);
  }

 private:
  static constexpr const char* kChannel[3] = {"red", "green", "blue"};

  /// The variances contain what the modes of the emission tables do by way of the answer: instead, all that
  /// they do.
  void consider_modes(const ModelProfile& aurora, const std::vector<ModeShift>& modes, std::size_t photo) {
    std::vector<std::vector<double>> shifts;
    for (const ModeShift& mode : modes) shifts.push_back(mode.shift);
    by_mode_ = linear_.coefficient_shifts(aurora, solution_, shifts);
    for (std::size_t j = 0; j < variance_.size(); ++j) {
      if (variance_[j] <= 0.0) continue;
      double by_answer = 0.0, by_all = 0.0;
      for (std::size_t m = 0; m < modes.size(); ++m) {
        double& change = by_mode_[m][j];
        by_answer += change * change;
        change += modes[m].coefficients[photo][j];
        by_all += change * change;
      }
      if (!modes.empty()) variance_[j] = std::max(0.0, variance_[j] - by_answer) + by_all;
    }
  }

  void put(const std::string& name, int j) {
    SolvedNumber s{name, solution_.coefficients[j], {}};
    if (variance_[j] > 0.0) {
      s.sigma = std::sqrt(variance_[j]);
      for (const std::vector<double>& mode : by_mode_) s.by_mode.push_back(mode[static_cast<std::size_t>(j)]);
    }
    r_.solved.push_back(s);
  }

  /// Fills the gain of each band and channel. Returns the mean of those that count; 0 if none does.
  double mean_gain() {
    r_.gain.assign(r_.data.bands, std::vector<double>(3));
    std::vector<std::vector<bool>> constrained(r_.data.bands, std::vector<bool>(3));
    bool any_constrained = false;
    for (int b = 0; b < r_.data.bands; ++b)
      for (int c = 0; c < 3; ++c) {
        // A grey sensor's other channels hold nothing.
        const int column = gains_.column(b, grey_ ? kGreyChannel : c);
        r_.gain[b][c] = solution_.coefficients[column];
        constrained[b][c] = is_constrained(r_.gain[b][c], std::sqrt(std::max(0.0, variance_[column])));
        any_constrained = any_constrained || constrained[b][c];
      }
    // Where bands have skies of their own, one that has next to no light may have any gain, and does not
    // count.
    const bool constrained_only = linear_.skies() > 1 && any_constrained;
    double sum = 0.0, lit = 0.0;
    for (int b = 0; b < r_.data.bands; ++b)
      for (int c = 0; c < 3; ++c)
        if (constrained_only ? constrained[b][c] : r_.gain[b][c] > 0.0) {
          sum += r_.gain[b][c];
          lit += 1.0;
        }
    return lit > 0.0 ? sum / lit : 0.0;
  }

  const LinearPart& linear_;
  const GainLayout& gains_;
  const LinearSolution& solution_;
  std::vector<double> variance_;              ///< of each coefficient
  std::vector<std::vector<double>> by_mode_;  ///< changes, [mode][coefficient]
  bool grey_;
  FittedPhoto& r_;
};

}  // namespace

void put_solution(const Comparison& comparison, const Comparison::Point& point, const ValueUncertainty& known,
                  double error_inflation, std::size_t photo, FittedPhoto& r) {
  SolvedNumbers solved(comparison, point, known, error_inflation, photo, r);
  solved.put_gains();
  solved.put_sky();
  for (const Statistic::Solved& s : comparison.solved_by_statistics(r.best)) {
    r.solved.push_back({s.name, s.value, {}});
    if (s.sigma > 0.0) r.solved.back().sigma = s.sigma;
  }
}

sim::PhotoEntry entry_of_best(const sim::PhotoEntry& entry, const FittedPhoto& fitted,
                              const std::vector<FreeNumber>& free,
                              const std::vector<FittedParameter>& parameters) {
  sim::PhotoEntry best = entry;
  const auto set = [&](const std::string& path, const std::string& value) {
    const auto has_path = [&](const auto& pair) { return pair.first == path; };
    best.set.erase(std::remove_if(best.set.begin(), best.set.end(), has_path), best.set.end());
    best.set.emplace_back(path, value);
  };
  for (std::size_t j = 0; j < free.size(); ++j) {
    const auto set_at = [&](const sim::ParameterId& id, const std::string& photo) {
      if (photo == entry.name) set(sim::path_of(fitted.best, id), sim::real_text(parameters[j].value));
    };
    set_at(free[j].id, free[j].photo);
    for (const FreePlace& place : free[j].also) set_at(place.id, place.photo);
  }
  for (const char* key : {"sensor.exposure", "sensor.gain_per_kilorayleigh", "sky.level", "sky.gradient",
                          "sky.curvature", "sky.lights_gain"})
    for (const sim::ParameterPath& path : sim::resolve(fitted.best, key))
      set(path.text, sim::value_text(fitted.best, path));
  return best;
}

namespace {

/// The most light that the model has before its bands' skies, in bands of which the gain is constrained.
double peak_before_skies(const FittedPhoto& r) {
  double peak = 0.0;
  const std::vector<std::vector<bool>> constrained = constrained_gains(r);
  for (int b = 0; b < r.data.bands; ++b)
    for (int row = 0; row < r.data.rows; ++row)
      for (int c = 0; c < 3; ++c) {
        const std::size_t i = r.data.index(b, row, c);
        if (r.sigma[i] > 0.0 && constrained[b][c]) peak = std::max(peak, r.model[i] - r.behind[i]);
      }
  return peak;
}

}  // namespace

double rms_over_peak(const FittedPhoto& r) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < r.model.size(); ++i) {
    if (r.sigma[i] <= 0.0) continue;
    sum += std::pow(r.data.mean[i] - r.model[i], 2);
    ++count;
  }
  if (count == 0) return 0.0;
  const double rms = std::sqrt(sum / static_cast<double>(count));
  if (r.best.fit.band_sky) {
    const double peak = peak_before_skies(r);
    return peak > 0.0 ? rms / peak : std::numeric_limits<double>::infinity();
  }
  const double peak = profile_peak(r.data);
  return peak > 0.0 ? rms / peak : 0.0;
}

std::vector<std::vector<double>> gain_sigmas(const FittedPhoto& fitted) {
  static const char* const kChannel[3] = {"red", "green", "blue"};
  std::map<std::string, double> known;
  for (const SolvedNumber& s : fitted.solved) known[s.name] = s.sigma.value_or(0.0);
  const bool per_band = fitted.best.fit.band_brightness, per_channel = !fitted.best.fit.white_balance_known;
  std::vector<std::vector<double>> sigmas;
  for (std::size_t b = 0; b < fitted.gain.size(); ++b) {
    sigmas.emplace_back();
    for (int c = 0; c < 3; ++c) {
      const int channel = is_grey(fitted.best) ? kGreyChannel : c;
      const auto found = known.find(std::string("gain") + (per_band ? ".band_" + std::to_string(b) : "") +
                                    (per_channel ? std::string(".") + kChannel[channel] : ""));
      sigmas.back().push_back(found == known.end() ? 0.0 : found->second);
    }
  }
  return sigmas;
}

bool is_constrained(double gain, double sigma) { return gain > 0.0 && sigma < gain; }

std::vector<std::vector<bool>> constrained_gains(const FittedPhoto& fitted) {
  const std::vector<std::vector<double>> sigmas = gain_sigmas(fitted);
  std::vector<std::vector<bool>> constrained;
  for (std::size_t b = 0; b < sigmas.size(); ++b) {
    constrained.emplace_back();
    for (std::size_t c = 0; c < sigmas[b].size(); ++c)
      constrained.back().push_back(is_constrained(fitted.gain[b][c], sigmas[b][c]));
  }
  return constrained;
}

namespace {

constexpr double kFreeStepKm = 1.0;

}  // namespace

std::vector<FreeProfile> free_profiles(const sim::Scene& best, const SplinePrior& prior,
                                       const ValueUncertainty& known) {
  std::vector<FreeProfile> profiles;
  for (const SplineLine& line : prior.lines) {
    const sim::Sheet& sheet = best.sheets.at(line.sheet);
    const sim::AltitudeSpline spline = sim::altitude_spline(sheet);
    FreeProfile profile;
    profile.sheet = sheet.name;
    profile.wavelength_nm = best.emission.lines.at(line.line);
    const int steps = static_cast<int>((sheet.spline_top_km - sheet.spline_bottom_km) / kFreeStepKm);
    for (int i = 1; i < steps; ++i) {
      const double altitude = sheet.spline_bottom_km + i * kFreeStepKm;
      double rate = 0.0, variance = 0.0;
      for (int k = 0; k < spline.count(); ++k)
        rate += sheet.spline_rate[sim::spline_rate_index(sheet, line.line, k)] * spline.basis(k, altitude);
      for (std::size_t a = 0; a < line.numbers.size(); ++a) {
        const double weight = spline.basis(line.knots[a], altitude);
        if (weight == 0.0) continue;
        for (std::size_t b = 0; b < line.numbers.size(); ++b)
          variance += weight * spline.basis(line.knots[b], altitude) *
                      known.covariance[line.numbers[a]][line.numbers[b]];
      }
      if (!(rate > 0.0)) continue;
      const double factor = std::exp(std::sqrt(std::max(0.0, variance)) / rate);
      profile.altitude_km.push_back(altitude);
      profile.rate.push_back(rate);
      profile.lower.push_back(rate / factor);
      profile.upper.push_back(rate * factor);
    }
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

}  // namespace vegard::fit
