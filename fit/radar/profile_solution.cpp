#include "fit/radar/profile_solution.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/number/dense_solvers.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"
#include "sim/light/ionosphere/ionosphere.h"

namespace vegard::fit {
namespace profile_solution {

constexpr int kDraws = 64;
constexpr std::uint64_t kSeed = 1;

struct DrawnChanges {
  Eigen::MatrixXd ln_pairs, ln_recombination;  ///< [altitude, draw]
};

DrawnChanges drawn_changes(const DensityPhysics& physics, const Eigen::VectorXd& flux,
                           const Eigen::VectorXd& electrons) {
  DrawnChanges changes{Eigen::MatrixXd(electrons.size(), kDraws), Eigen::MatrixXd(electrons.size(), kDraws)};
  for (int d = 0; d < kDraws; ++d) {
    const DensityPhysics::Change change =
        physics.drawn(kSeed, static_cast<std::uint32_t>(d), flux, electrons);
    changes.ln_pairs.col(d) = change.ln_pairs / std::sqrt(static_cast<double>(kDraws));
    changes.ln_recombination.col(d) = change.ln_recombination / std::sqrt(static_cast<double>(kDraws));
  }
  return changes;
}

/// Returns the combinations of the draws that vary most, a column each: what is drawn of the numbers of
/// physics is these, times independent standard normal coefficients.
Eigen::MatrixXd draws_in_modes(const DrawnChanges& changes) {
  constexpr double kKeptVariance = 0.995;
  constexpr Eigen::Index kMostModes = 16;
  const sim::SymmetricEigen eigen =
      sim::symmetric_eigen(changes.ln_pairs.transpose() * changes.ln_pairs +
                           changes.ln_recombination.transpose() * changes.ln_recombination);
  const double all = eigen.values.sum();
  Eigen::Index modes = 0;
  double kept = 0.0;
  while (modes < kMostModes && kept < kKeptVariance * all) kept += eigen.values[kDraws - ++modes];
  return eigen.vectors.rightCols(modes);
}

/// Smaller errors are taken as this share of the density. No balance of ions holds better, and so narrow a
/// posterior, bent as it is, cannot be sampled.
constexpr double kLeastRelativeSigma = 0.005;

void put_measurement(const DensityProfile& profile, SpectrumProblem& problem) {
  const auto places = static_cast<Eigen::Index>(profile.density_cm3.size());
  problem.density_cm3.setZero(places);
  problem.one_over_sigma.setZero(places);
  for (Eigen::Index i = 0; i < places; ++i) {
    const double density = profile.density_cm3[static_cast<std::size_t>(i)];
    if (!std::isfinite(density)) continue;
    problem.density_cm3[i] = density;
    problem.one_over_sigma[i] = 1.0 / std::max(profile.sigma_cm3[static_cast<std::size_t>(i)],
                                               kLeastRelativeSigma * std::abs(density));
  }
}

/// Starts with the density that is measured where it is above its errors.
Eigen::VectorXd usable_density(const SpectrumProblem& problem) {
  constexpr double kLeastCm3 = 100.0;
  Eigen::VectorXd density = problem.density_cm3;
  for (Eigen::Index i = 0; i < density.size(); ++i) {
    const double weight = problem.one_over_sigma[i];
    density[i] = std::max({kLeastCm3, density[i], weight > 0.0 ? 1.0 / weight : 0.0});
  }
  return density;
}

void put_recombination(const DensityPhysics& physics, const Eigen::VectorXd& about,
                       SpectrumProblem& problem) {
  problem.about_cm3 = about;
  problem.ln_recombination.resize(about.size());
  problem.recombination_slope.resize(about.size());
  for (Eigen::Index i = 0; i < about.size(); ++i) {
    const sim::Recombination here = physics.recombination(static_cast<std::size_t>(i), about[i]);
    problem.ln_recombination[i] = std::log(here.coefficient_cm3_s);
    problem.recombination_slope[i] = here.slope;
  }
}

/// What is known before the first profile: of the spectrum and of physics nothing but their priors, and of
/// ln(density) before, if it is not steady, the profile's own, not well, and less so where it is noise.
RadarState first_state(const SpectrumProblem& problem, Eigen::Index others) {
  constexpr double kLnSigma = 0.5, kLnSigmaOfNoise = 2.0, kNoise = 3.0;
  const bool is_steady = std::isinf(problem.seconds);
  const Eigen::VectorXd density = usable_density(problem);
  const Eigen::Index places = is_steady ? 0 : density.size(), all = others + places;
  RadarState state{Eigen::VectorXd::Zero(all), Eigen::MatrixXd::Identity(all, all)};
  for (Eigen::Index i = 0; i < places; ++i) {
    state.mean[others + i] = std::log(density[i]);
    state.root(others + i, others + i) =
        density[i] * problem.one_over_sigma[i] > kNoise ? kLnSigma : kLnSigmaOfNoise;
  }
  return state;
}

}  // namespace profile_solution

using namespace profile_solution;

double needed_flux_mw_m2(const DensityPhysics& physics, const DensityProfile& profile) {
  SpectrumProblem problem;
  put_measurement(profile, problem);
  put_recombination(physics, usable_density(problem), problem);
  std::vector<double> watts;
  constexpr double kPerM3 = 1e6, kJoulePerEv = 1.602176634e-19, kMilli = 1e3, kLeastFlux = 1e-3;
  for (Eigen::Index i = 0; i < problem.about_cm3.size(); ++i)
    watts.push_back(kPerM3 * sim::kEvPerIonPair * kJoulePerEv * std::exp(problem.ln_recombination[i]) *
                    problem.about_cm3[i] * problem.about_cm3[i]);
  return std::max(kLeastFlux, kMilli * sim::height_integral(physics.altitudes_km(), watts));
}

SolvedProfile solve_profile(const DensityPhysics& physics, const DensityProfile& profile,
                            const ProfileSettings& settings, const ProfileBefore& before) {
  SolvedProfile solved;
  SpectrumProblem& problem = solved.problem;
  problem.seconds = settings.seconds;
  problem.usual_flux_mw_m2 = settings.usual_flux_mw_m2;
  put_measurement(profile, problem);
  const Eigen::VectorXd first = usable_density(problem);
  put_recombination(physics, first, problem);
  const Eigen::Index places = first.size(), spectrum = spectrum_numbers(physics);
  const bool is_first = before.state.mean.size() == 0;
  const auto put_modes = [&](const Eigen::VectorXd& flux, const Eigen::VectorXd& density) {
    const DrawnChanges changes = drawn_changes(physics, flux, density);
    solved.draws_in_modes = is_first ? draws_in_modes(changes) : before.draws_in_modes;
    problem.modes = {changes.ln_pairs * solved.draws_in_modes,
                     changes.ln_recombination * solved.draws_in_modes};
  };
  problem.modes = {Eigen::MatrixXd(places, 0), Eigen::MatrixXd(places, 0)};
  if (!is_first && settings.has_uncertainty) put_modes(before.flux_mw_m2, first);
  problem.state = is_first ? first_state(problem, spectrum) : before.state;

  constexpr int kRounds = 4;
  const int rounds_of_modes = is_first ? 2 : 1;
  for (int round = 0; round < kRounds; ++round) {
    const SpectrumPosterior posterior(physics, problem);
    solved.peak = posterior.peak(solved.peak.at);
    const SpectrumPosterior::Meaning best = posterior.meaning(solved.peak.at);
    solved.flux_mw_m2 = best.flux_mw_m2;
    if (round + 1 == kRounds || !solved.peak.is_found()) break;
    put_recombination(physics, best.density_cm3, problem);
    if (!settings.has_uncertainty || round >= rounds_of_modes) continue;
    put_modes(best.flux_mw_m2, best.density_cm3);
    if (is_first) problem.state = first_state(problem, spectrum + problem.modes.ln_pairs.cols());
  }
  return solved;
}

ProfileBefore before_next(const DensityPhysics& physics, const SolvedProfile& solved,
                          const Eigen::MatrixXd& samples, double kept) {
  constexpr double kLeastVariance = 1e-6;
  const SpectrumPosterior posterior(physics, solved.problem);
  const Eigen::Index spectrum = spectrum_numbers(physics), modes = solved.problem.modes.ln_pairs.cols();
  Eigen::MatrixXd all(posterior.unknowns(), samples.cols());
  for (Eigen::Index s = 0; s < samples.cols(); ++s) {
    const SpectrumPosterior::Meaning of = posterior.meaning(samples.col(s));
    all.col(s) = of.state;
    all.col(s).tail(of.end_cm3.size()) = of.end_cm3.array().log();
  }
  Eigen::VectorXd mean = all.rowwise().mean();
  const Eigen::MatrixXd away = all.colwise() - mean;
  Eigen::MatrixXd covariance = away * away.transpose() / static_cast<double>(samples.cols() - 1);
  covariance.diagonal().array() += kLeastVariance;
  if (modes > 0) {
    // The prior of the coefficients again, and what else depends on them as before.
    const Eigen::MatrixXd of_modes = covariance.block(spectrum, spectrum, modes, modes);
    const Eigen::MatrixXd by_modes = covariance.middleCols(spectrum, modes) * sim::inverse_of(of_modes);
    mean -= by_modes * mean.segment(spectrum, modes).eval();
    covariance += by_modes * (Eigen::MatrixXd::Identity(modes, modes) - of_modes) * by_modes.transpose();
  }
  mean.head(spectrum) *= kept;
  covariance.topRows(spectrum) *= kept;
  covariance.leftCols(spectrum) *= kept;
  covariance.diagonal().head(spectrum).array() += 1.0 - kept * kept;
  covariance = 0.5 * (covariance + covariance.transpose()).eval();
  const auto root = sim::cholesky_root(covariance);
  if (!root || !root->allFinite() || !mean.allFinite()) return {};
  return {{mean, *root}, solved.flux_mw_m2, solved.draws_in_modes};
}

Eigen::MatrixXd normal_samples(const SpectrumPosterior::Peak& peak, int count, std::uint64_t seed) {
  Eigen::MatrixXd normal(peak.at.size(), count);
  for (Eigen::Index s = 0; s < count; ++s)
    for (Eigen::Index i = 0; i < normal.rows(); ++i)
      normal(i, s) = sim::normal_quantile(sim::uniform(sim::random_words(
          seed, sim::Stream::ensemble, static_cast<std::uint32_t>(s), static_cast<std::uint32_t>(i))[0]));
  return (peak.root * normal).colwise() + peak.at;
}

}  // namespace vegard::fit
