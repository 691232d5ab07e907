#include "sim/base/number/chain/ensemble_sampler.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>

#include <fmt/format.h>

#include "sim/base/number/random.h"

namespace vegard::sim {
namespace {

constexpr double kSamplerNowhere = -std::numeric_limits<double>::infinity();
constexpr int kAttempts = 60;          // to place a walker
constexpr double kShrink = 0.8;        // of the spread, from one attempt to the next
constexpr double kJumpShare = 0.1;     // of the differential moves: whole differences, from mode to mode
constexpr double kWindow = 5.0;        // Sokal's c
constexpr double kLongEnough = 50.0;   // autocorrelation times
constexpr int kStepsOfCoordinate = 8;  // on the surrogate, and no fewer than
constexpr int kMinSurrogateSteps = 64;
constexpr double kSpreadOfStart = 2.0;  // in standard deviations, of walkers that have a surrogate
constexpr double kShortShare = 0.1;     // of the surrogate's moves: one step, which leads nearby
constexpr const char* kFormat = "ensemble-2";

/// The third index of a random number: what it is for.
enum Purpose : std::uint32_t { kMove = 0, kAccept = 1, kStart = 16, kIndependent = 1u << 20 };

int walkers_of(const EnsembleOptions& options, std::size_t coordinates) {
  const int d = static_cast<int>(coordinates);
  const int few = options.surrogate ? 4 : 2 * (d + 1);
  const int wanted = options.walkers > 0 ? options.walkers : options.surrogate ? few : 4 * d;
  const int least = std::max(wanted, few);
  return least + least % 2;
}

std::uint32_t random_below(std::uint32_t word, std::uint32_t count) {
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(word) * count >> 32);
}

/// One run's walkers, in two halves: a walker moves by the places of the half that it does not belong to.
class Ensemble {
 public:
  Ensemble(const LogDensity& log_density, const std::vector<double>& centre, const Eigen::MatrixXd& root,
           const EnsembleOptions& options, EnsembleState& state)
      : log_density_(log_density),
        student_(centre, root),
        transition_(options.surrogate, student_, options.seed),
        options_(options),
        state_(state),
        walkers_(walkers_of(options, state.coordinates)),
        half_(walkers_ / 2) {}

  bool stopped() const { return options_.stop != nullptr && options_.stop->load(); }
  bool placed() const { return static_cast<int>(state_.density.size()) == walkers_; }

  bool place_next() {
    const auto walker = static_cast<std::uint32_t>(state_.density.size());
    const std::size_t d = state_.coordinates;
    double spread = options_.surrogate ? kSpreadOfStart : 1.0;
    for (std::uint32_t attempt = 0; attempt < kAttempts; ++attempt, spread *= kShrink) {
      if (stopped()) return true;
      const std::vector<double> at =
          student_.about_centre(spread * normal_numbers(options_.seed, attempt, walker, kStart, d));
      const double density = finite_or_minus_infinity(log_density_(at));
      if (density == kSamplerNowhere) continue;
      state_.place.insert(state_.place.end(), at.begin(), at.end());
      state_.density.push_back(density);
      return true;
    }
    return false;
  }

  void move_next() {
    const int walker = state_.next_walker;
    const bool counts = state_.step >= options_.burn_in;
    const Words accept =
        random_words(options_.seed, Stream::ensemble, static_cast<std::uint32_t>(state_.step),
                     static_cast<std::uint32_t>(walker), kAccept);
    double log_factor = 0.0;
    const std::vector<double> at = proposal(walker, accept, log_factor);
    const bool goes = !std::equal(at.begin(), at.end(), place_of(walker));
    const double density = goes ? finite_or_minus_infinity(log_density_(at)) : state_.density[walker];
    const double log_ratio = log_factor + density - state_.density[walker];
    state_.proposed += counts;
    if (goes && density > kSamplerNowhere && std::log(fine_uniform(accept[0], accept[1])) < log_ratio) {
      std::copy(at.begin(), at.end(), state_.place.begin() + begin_of(walker));
      state_.density[walker] = density;
      state_.accepted += counts;
    }
    if (++state_.next_walker < walkers_) return;
    state_.next_walker = 0;
    ++state_.step;
    if (counts) state_.chain.insert(state_.chain.end(), state_.place.begin(), state_.place.end());
    if (options_.progress)
      options_.progress(static_cast<double>(state_.step) / (options_.burn_in + options_.steps));
  }

 private:
  std::ptrdiff_t begin_of(int walker) const {
    return static_cast<std::ptrdiff_t>(walker) * static_cast<std::ptrdiff_t>(state_.coordinates);
  }
  const double* place_of(int walker) const { return state_.place.data() + begin_of(walker); }

  /// Returns the place proposed to a walker, which is its own if a step on the surrogate has not moved it.
  /// log_factor is the logarithm of the factor of the densities' ratio.
  std::vector<double> proposal(int walker, const Words& accept, double& log_factor) const {
    const auto step = static_cast<std::uint32_t>(state_.step);
    const auto index = static_cast<std::uint32_t>(walker);
    double kind = uniform(accept[2]);
    if (options_.surrogate) {
      if (kind < options_.surrogate_share) {
        std::vector<double> at(place_of(walker), place_of(walker) + state_.coordinates);
        const int many = std::max(kMinSurrogateSteps, kStepsOfCoordinate * static_cast<int>(at.size()));
        log_factor = transition_.walk(at, uniform(accept[3]) < kShortShare ? 1 : many, step, index);
        return at;
      }
      kind = (kind - options_.surrogate_share) / (1.0 - options_.surrogate_share);
    }
    if (kind >= 1.0 - options_.independent_share) {
      std::vector<double> at = student_.draw(options_.seed, step, index, kIndependent);
      const std::vector<double> from(place_of(walker), place_of(walker) + state_.coordinates);
      log_factor = student_.log_density(from) - student_.log_density(at);
      return at;
    }
    const Words w = random_words(options_.seed, Stream::ensemble, step, index, kMove);
    const int other_half = walker < half_ ? half_ : 0;
    const auto half = static_cast<std::uint32_t>(half_);
    const std::uint32_t first = random_below(w[0], half);
    const double* const own = place_of(walker);
    const double* const a = place_of(other_half + static_cast<int>(first));
    std::vector<double> at(state_.coordinates);
    const double d = static_cast<double>(state_.coordinates);
    if (kind >= options_.differential_share) {
      // z with density ∝ 1/√z on [1/a, a], by the inverse of its distribution; the factor z^(d − 1) is the
      // volume that the move spreads over.
      const double u = fine_uniform(w[2], w[3]);
      const double z = std::pow(1.0 + (options_.stretch - 1.0) * u, 2) / options_.stretch;
      for (std::size_t j = 0; j < at.size(); ++j) at[j] = a[j] + z * (own[j] - a[j]);
      log_factor = (d - 1.0) * std::log(z);
      return at;
    }
    // ter Braak's 2.38 / √(2 d), and now and then 1. The factor is drawn about it, so that a proposal does
    // not come from a few places only; the pair may be drawn either way round, so that the move is its own
    // way back.
    const std::uint32_t second = (first + 1 + random_below(w[1], half - 1)) % half;
    const double* const b = place_of(other_half + static_cast<int>(second));
    const bool jump = uniform(w[2]) < kJumpShare;
    const double factor = jump ? 1.0 : 2.38 / std::sqrt(2.0 * d) * (0.5 + uniform(w[3]));
    for (std::size_t j = 0; j < at.size(); ++j) at[j] = own[j] + factor * (a[j] - b[j]);
    return at;
  }

  const LogDensity& log_density_;
  const StudentProposal student_;
  const SurrogateTransition transition_;
  const EnsembleOptions& options_;
  EnsembleState& state_;
  const int walkers_, half_;
};

std::string words_of(const std::vector<double>& numbers) {
  std::string text = fmt::format(" {}", numbers.size());
  for (const double x : numbers) text += fmt::format(" {:a}", x);
  return text + "\n";
}

bool read_numbers(std::istringstream& in, std::vector<double>& numbers) {
  std::size_t count = 0;
  if (!(in >> count)) return false;
  numbers.clear();
  std::string word;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(in >> word)) return false;
    char* end = nullptr;
    numbers.push_back(std::strtod(word.c_str(), &end));
    if (end == word.c_str() || *end != '\0') return false;
  }
  return true;
}

}  // namespace

void run_ensemble(const LogDensity& log_density, const std::vector<double>& centre,
                  const std::vector<std::vector<double>>& covariance, const EnsembleOptions& options,
                  EnsembleState& state) {
  state.coordinates = centre.size();
  if (centre.empty() || state.no_start) return;
  Ensemble ensemble(log_density, centre, root_of_covariance(covariance), options, state);
  while (!ensemble.placed() && !ensemble.stopped())
    if (!ensemble.place_next()) {
      state.no_start = true;
      return;
    }
  while (!ensemble.stopped() && state.step < options.burn_in + options.steps) ensemble.move_next();
}

std::string state_text(const EnsembleState& s) {
  return fmt::format("{} {} {} {} {} {} {}\n", kFormat, s.coordinates, s.step, s.next_walker, s.proposed,
                     s.accepted, s.no_start ? 1 : 0) +
         words_of(s.place) + words_of(s.density) + words_of(s.chain);
}

std::optional<EnsembleState> state_from_text(const std::string& text) {
  std::istringstream in(text);
  std::string format;
  EnsembleState s;
  int no_start = 0;
  if (!(in >> format >> s.coordinates >> s.step >> s.next_walker >> s.proposed >> s.accepted >> no_start) ||
      format != kFormat)
    return {};
  s.no_start = no_start != 0;
  if (!read_numbers(in, s.place) || !read_numbers(in, s.density) || !read_numbers(in, s.chain)) return {};
  const std::size_t all = s.density.size() * s.coordinates;
  const bool whole = s.place.size() == all && s.step >= 0 && s.next_walker >= 0 &&
                     (all == 0 ? s.chain.empty() : s.chain.size() % all == 0);
  if (!whole) return {};
  return s;
}

double autocorrelation_time(const std::vector<double>& series, int walkers) {
  const auto w = static_cast<std::size_t>(walkers);
  const std::size_t steps = w > 0 ? series.size() / w : 0;
  double mean = 0.0;
  for (const double x : series) mean += x;
  mean /= static_cast<double>(std::max<std::size_t>(1, series.size()));
  const auto covariance = [&](std::size_t lag) {
    double sum = 0.0;
    for (std::size_t i = 0; i + lag * w < steps * w; ++i)
      sum += (series[i] - mean) * (series[i + lag * w] - mean);
    return sum / static_cast<double>((steps - lag) * w);
  };
  if (steps < 2) return 1.0;
  const double variance = covariance(0);
  if (!(variance > 0.0)) return 1.0;
  double time = 1.0;
  for (std::size_t lag = 1; lag < steps && static_cast<double>(lag) <= kWindow * time; ++lag)
    time += 2.0 * covariance(lag) / variance;
  return std::max(1.0, time);
}

double split_r_hat(const std::vector<double>& series, int walkers) {
  const auto w = static_cast<std::size_t>(walkers);
  const std::size_t half = w > 0 ? series.size() / w / 2 : 0;
  if (half < 2) return 1.0;
  double within = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t chain = 0; chain < 2 * w; ++chain) {
    const std::size_t first = (chain / w) * half * w + chain % w;
    double mean = 0.0, variance = 0.0;
    for (std::size_t i = 0; i < half; ++i) mean += series[first + i * w] / static_cast<double>(half);
    for (std::size_t i = 0; i < half; ++i)
      variance += std::pow(series[first + i * w] - mean, 2) / static_cast<double>(half - 1);
    within += variance / static_cast<double>(2 * w);
    sum += mean;
    squares += mean * mean;
  }
  const auto chains = static_cast<double>(2 * w);
  const double between = std::max(0.0, squares - sum * sum / chains) / (chains - 1.0);  // of the means
  if (!(within > 0.0)) return between > 0.0 ? std::numeric_limits<double>::infinity() : 1.0;
  return std::sqrt((static_cast<double>(half - 1) / static_cast<double>(half) * within + between) / within);
}

EnsembleSummary summary_of(const EnsembleState& state) {
  EnsembleSummary s;
  const std::size_t d = state.coordinates;
  s.walkers = static_cast<int>(state.density.size());
  if (d == 0 || s.walkers == 0) return s;
  s.samples = state.chain.size() / d;
  s.steps = static_cast<int>(s.samples) / s.walkers;
  s.acceptance =
      state.proposed > 0 ? static_cast<double>(state.accepted) / static_cast<double>(state.proposed) : 0.0;
  if (s.samples < 2) return s;
  const auto n = static_cast<double>(s.samples);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> chain(state.chain.data(), static_cast<Eigen::Index>(s.samples),
                                         static_cast<Eigen::Index>(d));
  const Eigen::RowVectorXd mean = chain.colwise().mean();
  const RowMajor about = chain.rowwise() - mean;
  const Eigen::MatrixXd covariance = about.transpose() * about / (n - 1.0);
  s.mean.assign(mean.data(), mean.data() + d);
  s.correlation.assign(d, std::vector<double>(d, 0.0));
  s.long_enough = true;
  for (std::size_t j = 0; j < d; ++j) {
    const auto jj = static_cast<Eigen::Index>(j);
    s.sigma.push_back(std::sqrt(covariance(jj, jj)));
    std::vector<double> series(s.samples);
    for (std::size_t i = 0; i < s.samples; ++i) series[i] = about(static_cast<Eigen::Index>(i), jj);
    s.autocorrelation_steps.push_back(autocorrelation_time(series, s.walkers));
    s.effective.push_back(n / s.autocorrelation_steps.back());
    s.r_hat.push_back(split_r_hat(series, s.walkers));
    if (s.steps < kLongEnough * s.autocorrelation_steps.back()) s.long_enough = false;
    for (std::size_t k = 0; k < d; ++k) {
      const auto kk = static_cast<Eigen::Index>(k);
      const double both = std::sqrt(covariance(jj, jj) * covariance(kk, kk));
      s.correlation[j][k] = both > 0.0 ? covariance(jj, kk) / both : 0.0;
    }
  }
  return s;
}

}  // namespace vegard::sim
