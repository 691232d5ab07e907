#include "fit/radar/spectrum_posterior.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/dense_solvers.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"

namespace vegard::fit {
namespace spectrum_posterior {

struct NormalPrior {
  double mean, sigma;
};
constexpr double kLeastPairs = 1e-9;  // cm^-3 s^-1, for logarithms
constexpr double kLnFluxSigma = 2.5, kLongLength = 0.8, kShortLength = 0.25;
const NormalPrior kLnE0 = {std::log(3.0), 1.2}, kPower = {2.5, 1.5}, kLnLong = {std::log(0.3), 1.2},
                  kLnShort = {std::log(0.1), 1.2};
/// Where the numbers of a spectrum stand: ln Q, ln E0, b, ln s1, ln s2; behind them those of both processes.
constexpr Eigen::Index kFlux = 0, kE0 = 1, kB = 2, kS1 = 3, kS2 = 4, kFirst = 5;

/// Columns whose combinations with independent standard normal coefficients are a Gaussian process of
/// variance 1 over even nodes.
Eigen::MatrixXd process_root(const Eigen::VectorXd& at, double length) {
  constexpr double kLeastVariance = 1e-3;
  Eigen::MatrixXd covariance(at.size(), at.size());
  for (Eigen::Index i = 0; i < at.size(); ++i)
    for (Eigen::Index j = 0; j < at.size(); ++j) {
      const double away = (at[i] - at[j]) / length;
      covariance(i, j) = std::exp(-0.5 * away * away);
    }
  const sim::SymmetricEigen eigen = sim::symmetric_eigen(covariance);
  Eigen::Index first = 0;
  while (eigen.values[first] < kLeastVariance) ++first;
  const Eigen::Index kept = at.size() - first;
  return eigen.vectors.rightCols(kept) * eigen.values.tail(kept).cwiseSqrt().asDiagonal();
}

Eigen::VectorXd ln_energies(const DensityPhysics& physics) {
  Eigen::VectorXd ln_energy(static_cast<Eigen::Index>(physics.bins().count()));
  for (Eigen::Index j = 0; j < ln_energy.size(); ++j)
    ln_energy[j] = std::log(physics.bins().middle_kev(static_cast<std::size_t>(j)));
  return ln_energy;
}

}  // namespace spectrum_posterior

using namespace spectrum_posterior;

Eigen::Index spectrum_numbers(const DensityPhysics& physics) {
  const Eigen::VectorXd ln_energy = ln_energies(physics);
  return kFirst + process_root(ln_energy, kLongLength).cols() + process_root(ln_energy, kShortLength).cols();
}

/// The numbers on the way from a point to the densities.
struct SpectrumPosterior::Forward {
  double e0_kev = 0.0, power = 0.0, long_amplitude = 0.0, short_amplitude = 0.0;
  Eigen::VectorXd shares;  ///< of the energy flux without the processes
  Eigen::VectorXd long_process, short_process, flux, pairs, state, density, end;
  Eigen::VectorXd by_pairs, by_recombination, by_before;  ///< of the densities, by logarithms
};

SpectrumPosterior::SpectrumPosterior(const DensityPhysics& physics, const SpectrumProblem& problem)
    : physics_(physics), problem_(problem) {
  ln_energy_ = ln_energies(physics);
  long_ = process_root(ln_energy_, kLongLength);
  short_ = process_root(ln_energy_, kShortLength);
  unknowns_ = problem.state.mean.size();
}

SpectrumPosterior::Forward SpectrumPosterior::forward(const Eigen::VectorXd& at,
                                                      const Eigen::VectorXd& added_mw_m2) const {
  constexpr double kMostLn = 40.0;
  Forward f;
  f.state = problem_.state.mean + problem_.state.root * at;
  const Eigen::VectorXd& of = f.state;
  const double ln_e0 = kLnE0.mean + kLnE0.sigma * of[kE0];
  f.e0_kev = std::exp(ln_e0);
  f.power = kPower.mean + kPower.sigma * of[kB];
  f.long_amplitude = std::exp(kLnLong.mean + kLnLong.sigma * of[kS1]);
  f.short_amplitude = std::exp(kLnShort.mean + kLnShort.sigma * of[kS2]);
  f.shares = f.power * (ln_energy_.array() - ln_e0) - ln_energy_.array().exp() / f.e0_kev;
  f.shares = (f.shares.array() - f.shares.maxCoeff()).exp();
  f.shares /= f.shares.sum();
  f.long_process = f.long_amplitude * (long_ * of.segment(kFirst, long_.cols()));
  f.short_process = f.short_amplitude * (short_ * of.segment(kFirst + long_.cols(), short_.cols()));
  constexpr double kLeastShare = 1e-200;  // for the logarithm
  f.flux = (std::log(problem_.usual_flux_mw_m2) + kLnFluxSigma * of[kFlux] +
            f.shares.array().max(kLeastShare).log() + f.long_process.array() + f.short_process.array())
               .min(kMostLn)
               .exp();
  if (added_mw_m2.size() > 0) f.flux += added_mw_m2;
  f.pairs = physics_.pairs() * f.flux;
  const Eigen::Index modes = problem_.modes.ln_pairs.cols(), spectrum = kFirst + long_.cols() + short_.cols(),
                     places = f.pairs.size();
  Eigen::VectorXd ln_pairs = f.pairs.array().max(kLeastPairs).log(),
                  ln_recombination = problem_.ln_recombination;
  if (modes > 0) {
    ln_pairs += problem_.modes.ln_pairs * of.segment(spectrum, modes);
    ln_recombination += problem_.modes.ln_recombination * of.segment(spectrum, modes);
  }
  f.density.resize(places);
  f.by_pairs.resize(places);
  f.by_recombination.resize(places);
  f.by_before.setZero(places);
  if (std::isinf(problem_.seconds)) {
    const Eigen::ArrayXd power = 2.0 + problem_.recombination_slope.array();
    f.density = ((ln_pairs.array() - ln_recombination.array() +
                  problem_.recombination_slope.array() * problem_.about_cm3.array().log()) /
                 power)
                    .exp();
    f.by_pairs = f.density.array() / power;
    f.by_recombination = -f.by_pairs;
    f.end = f.density;
    return f;
  }
  f.end.resize(places);
  for (Eigen::Index i = 0; i < places; ++i) {
    const sim::GrownDensity grown = sim::grown_density(std::exp(ln_pairs[i]), std::exp(ln_recombination[i]),
                                                       std::exp(of[spectrum + modes + i]), problem_.seconds);
    f.density[i] = grown.mean.value;
    f.by_pairs[i] = grown.mean.by_pairs;
    f.by_recombination[i] = grown.mean.by_recombination;
    f.by_before[i] = grown.mean.by_before;
    f.end[i] = grown.end.value;
  }
  return f;
}

Eigen::VectorXd SpectrumPosterior::backward(const Forward& f, const Eigen::VectorXd& weight) const {
  const Eigen::VectorXd by_ln_pairs = weight.cwiseProduct(f.by_pairs),
                        by_ln_recombination = weight.cwiseProduct(f.by_recombination);
  const Eigen::VectorXd by_x = f.flux.cwiseProduct(physics_.pairs().transpose() *
                                                   by_ln_pairs.cwiseQuotient(f.pairs.cwiseMax(kLeastPairs)));
  const double ln_e0 = std::log(f.e0_kev);
  const Eigen::VectorXd by_e0 = ln_energy_.array().exp() / f.e0_kev - f.power,
                        by_b = ln_energy_.array() - ln_e0;
  const double sum = by_x.sum();
  Eigen::VectorXd gradient(unknowns_);
  gradient[kFlux] = kLnFluxSigma * sum;
  gradient[kE0] = kLnE0.sigma * (by_x.dot(by_e0) - sum * f.shares.dot(by_e0));
  gradient[kB] = kPower.sigma * (by_x.dot(by_b) - sum * f.shares.dot(by_b));
  gradient[kS1] = kLnLong.sigma * by_x.dot(f.long_process);
  gradient[kS2] = kLnShort.sigma * by_x.dot(f.short_process);
  gradient.segment(kFirst, long_.cols()) = f.long_amplitude * (long_.transpose() * by_x);
  gradient.segment(kFirst + long_.cols(), short_.cols()) = f.short_amplitude * (short_.transpose() * by_x);
  const Eigen::Index modes = problem_.modes.ln_pairs.cols(), spectrum = kFirst + long_.cols() + short_.cols(),
                     others = unknowns_ - spectrum - modes;
  if (modes > 0)
    gradient.segment(spectrum, modes) = problem_.modes.ln_pairs.transpose() * by_ln_pairs +
                                        problem_.modes.ln_recombination.transpose() * by_ln_recombination;
  if (others > 0) gradient.tail(others) = weight.cwiseProduct(f.by_before);
  return gradient;
}

SpectrumPosterior::Meaning SpectrumPosterior::meaning(const Eigen::VectorXd& at) const {
  const Forward f = forward(at);
  return {f.flux, f.density, f.end, f.state, chi2(f)};
}

double SpectrumPosterior::chi2(const Forward& of) const {
  return (of.density - problem_.density_cm3).cwiseProduct(problem_.one_over_sigma).squaredNorm();
}

double SpectrumPosterior::addable_flux_mw_m2(const Eigen::VectorXd& at, const Eigen::VectorXd& shares,
                                             double rise) const {
  constexpr double kLeastMwM2 = 1e-9, kMostMwM2 = 1e9;
  constexpr int kHalvings = 25;  // of ln(flux): to 1e-6
  const double most = chi2(forward(at)) + rise;
  double low = std::log(kLeastMwM2), high = std::log(kMostMwM2);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (chi2(forward(at, std::exp(middle) * shares)) < most ? low : high) = middle;
  }
  return std::exp(high);
}

Eigen::VectorXd SpectrumPosterior::signal(const Eigen::VectorXd& at) const {
  const Forward f = forward(at);
  const Eigen::VectorXd by_pairs =
      f.by_pairs.cwiseProduct(problem_.one_over_sigma).cwiseQuotient(f.pairs.cwiseMax(kLeastPairs));
  return (by_pairs.asDiagonal() * physics_.pairs() * f.flux.asDiagonal()).colwise().norm().transpose();
}

double SpectrumPosterior::energy(const Eigen::VectorXd& at, Eigen::VectorXd& gradient) const {
  const Forward f = forward(at);
  const Eigen::VectorXd residual = (f.density - problem_.density_cm3).cwiseProduct(problem_.one_over_sigma);
  gradient =
      at + problem_.state.root.transpose() * backward(f, residual.cwiseProduct(problem_.one_over_sigma));
  return 0.5 * (residual.squaredNorm() + at.squaredNorm());
}

Eigen::MatrixXd SpectrumPosterior::jacobian(const Forward& from) const {
  Eigen::MatrixXd rows(problem_.density_cm3.size(), unknowns_);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(rows.rows());
    weight[i] = problem_.one_over_sigma[i];
    rows.row(i) = backward(from, weight).transpose();
  }
  return rows * problem_.state.root;
}

double SpectrumPosterior::descend(Eigen::VectorXd& at) const {
  constexpr int kMostSteps = 60;
  constexpr double kLeastGain = 1e-7, kLessDamped = 0.3, kMoreDamped = 5.0, kMostDamping = 1e8;
  double damping = 1.0;
  Eigen::VectorXd gradient;
  double least = energy(at, gradient);
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::MatrixXd rows = jacobian(forward(at));
    const Eigen::MatrixXd normal = rows.transpose() * rows + Eigen::MatrixXd::Identity(unknowns_, unknowns_);
    const double before = least;
    while (damping < kMostDamping) {
      const Eigen::MatrixXd damped = normal + damping * Eigen::MatrixXd::Identity(unknowns_, unknowns_);
      const Eigen::VectorXd tried = at - sim::solve_symmetric(damped, gradient);
      Eigen::VectorXd there;
      const double value = energy(tried, there);
      if (value < least) {
        at = tried;
        gradient = there;
        least = value;
        damping *= kLessDamped;
        break;
      }
      damping *= kMoreDamped;
    }
    if (before - least < kLeastGain * (1.0 + least)) break;
  }
  return least;
}

SpectrumPosterior::Peak SpectrumPosterior::peak(const Eigen::VectorXd& start) const {
  std::vector<Eigen::VectorXd> starts;
  if (start.size() > 0) {
    const Eigen::Index common = start.size() == unknowns_ ? unknowns_ : kFirst + long_.cols() + short_.cols();
    starts.emplace_back(Eigen::VectorXd::Zero(unknowns_));
    starts.front().head(common) = start.head(common);
  } else {
    for (const double e0 : {-1.0, 0.3, 1.5}) {
      starts.emplace_back(Eigen::VectorXd::Zero(unknowns_));
      starts.back()[kE0] = e0;
    }
  }
  Peak best;
  double least = 0.0;
  for (Eigen::VectorXd& at : starts) {
    const double value = descend(at);
    if (best.at.size() > 0 && value >= least) continue;
    best.at = at;
    least = value;
  }
  const Eigen::MatrixXd rows = jacobian(forward(best.at));
  // By the root of the inverse covariance, which rounding leaves positive whatever the errors are.
  const auto inverse_root =
      sim::cholesky_root(rows.transpose() * rows + Eigen::MatrixXd::Identity(unknowns_, unknowns_));
  if (!std::isfinite(least) || !inverse_root) return best;
  const Eigen::MatrixXd root = sim::inverse_of(*inverse_root).transpose();
  if (!root.allFinite()) return best;
  best.root = root;
  best.used_freedom = (rows * root).squaredNorm();
  best.ln_evidence = -inverse_root->diagonal().array().log().sum() - least;
  return best;
}

SpectrumPosterior::Samples SpectrumPosterior::samples(const Peak& peak, int count, std::uint64_t seed,
                                                      int stride) const {
  constexpr int kWarmUp = 300, kFastWarmUp = 100, kLeastLeaps = 10, kMostLeaps = 60;
  constexpr double kWantedAcceptance = 0.8, kFastAdaptation = 0.2, kAdaptation = 0.05, kLeastStep = 1e-4,
                   kMostStep = 0.6, kLeastPath = 1.0;
  Samples all{Eigen::MatrixXd(unknowns_, count)};
  Eigen::VectorXd here = Eigen::VectorXd::Zero(unknowns_), slope;
  const auto energy_at = [&](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {
    Eigen::VectorXd raw;
    const double value = energy(peak.at + peak.root * at, raw);
    gradient = peak.root.transpose() * raw;
    return value;
  };
  double value = energy_at(here, slope), step = 0.25;
  const int steps = kWarmUp + stride * count;
  for (int s = 0; s < steps; ++s) {
    Eigen::VectorXd momentum(unknowns_);
    for (Eigen::Index i = 0; i < unknowns_; ++i)
      momentum[i] = sim::normal_quantile(sim::uniform(sim::random_words(
          seed, sim::Stream::ensemble, static_cast<std::uint32_t>(s), static_cast<std::uint32_t>(i))[0]));
    const sim::Words words = sim::random_words(seed, sim::Stream::ensemble, static_cast<std::uint32_t>(s),
                                               static_cast<std::uint32_t>(unknowns_));
    const double length = step * (0.7 + 0.6 * sim::uniform(words[1]));  // so that no path closes on itself
    const double before = value + 0.5 * momentum.squaredNorm();
    Eigen::VectorXd tried = here, tried_slope = slope;
    double tried_value = value;
    const int leaps = std::clamp(static_cast<int>(std::ceil(kLeastPath / step)), kLeastLeaps, kMostLeaps);
    for (int leap = 0; leap < leaps; ++leap) {
      momentum -= 0.5 * length * tried_slope;
      tried += length * momentum;
      tried_value = energy_at(tried, tried_slope);
      momentum -= 0.5 * length * tried_slope;
    }
    const double rise = tried_value + 0.5 * momentum.squaredNorm() - before;
    const double chance = std::isfinite(rise) ? std::exp(std::min(0.0, -rise)) : 0.0;
    if (sim::uniform(words[0]) < chance) {
      here = tried;
      slope = tried_slope;
      value = tried_value;
    }
    if (s < kWarmUp) {
      const double adaptation = s < kFastWarmUp ? kFastAdaptation : kAdaptation;
      step = std::clamp(step * std::exp(adaptation * (chance - kWantedAcceptance)), kLeastStep, kMostStep);
    } else {
      const int kept = (s - kWarmUp) / stride;
      if ((s - kWarmUp) % stride == stride - 1) all.at.col(kept) = peak.at + peak.root * here;
      all.acceptance += chance / (steps - kWarmUp);
    }
  }
  return all;
}

}  // namespace vegard::fit
