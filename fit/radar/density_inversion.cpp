#include "fit/radar/density_inversion.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "fit/radar/profile_solution.h"
#include "sim/base/error.h"
#include "sim/base/number/chain/ensemble_sampler.h"
#include "sim/base/number/chi_squared.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"
#include "sim/base/parallel.h"

namespace vegard::fit {
namespace density_inversion {

constexpr SampledNumber kUnknown = {sim::kNaN, sim::kNaN, sim::kNaN, sim::kNaN, sim::kNaN};

SampledNumber quantiles(std::vector<double> values) {
  constexpr double kLow68 = 0.158655, kLow95 = 0.022750;  // of one and of two standard deviations
  const auto at = [&](double share) { return sim::quantile(values, share); };
  return {at(0.5), at(kLow68), at(1.0 - kLow68), at(kLow95), at(1.0 - kLow95)};
}

DensitySpectrum unknown_spectrum(const DensityPhysics& physics, std::size_t places,
                                 DensityVerdict verdict = DensityVerdict::too_few_altitudes) {
  DensitySpectrum result;
  result.verdict = verdict;
  result.energy_flux_mw_m2 = result.mean_energy_kev = kUnknown;
  result.flux_cm2_s_kev.assign(physics.bins().count(), kUnknown);
  result.density_cm3.assign(places, sim::kNaN);
  result.chi2 = result.degrees_of_freedom = result.chance = sim::kNaN;
  return result;
}

/// Leaves upper ends alone: of samples, and no smaller than what the density allows beside the peak, which
/// the prior alone may make small.
void keep_upper_ends(const SpectrumPosterior& posterior, const SolvedProfile& solved,
                     const Eigen::VectorXd& shares, double per_mw_m2, SampledNumber& number) {
  const double best = per_mw_m2 * solved.flux_mw_m2.cwiseProduct(shares.cwiseSign()).sum();
  const auto most = [&](double rise) {
    return best + per_mw_m2 * posterior.addable_flux_mw_m2(solved.peak.at, shares, rise);
  };
  number.value = number.low68 = number.low95 = sim::kNaN;
  number.high68 = std::max(number.high68, most(1.0));
  number.high95 = std::max(number.high95, most(4.0));
}

/// Whether the density is not that of no electrons, and electrons of the range are among those it shows.
bool sees_electrons(const SolvedProfile& solved, const Eigen::VectorXd& signal, double chi2,
                    const EnergyRange& range) {
  const double of_none = solved.problem.density_cm3.cwiseProduct(solved.problem.one_over_sigma).squaredNorm();
  const int used = std::max(1, static_cast<int>(std::lround(solved.peak.used_freedom)));
  const auto first = static_cast<Eigen::Index>(range.first), count = static_cast<Eigen::Index>(range.count);
  return of_none > chi2 && sim::chi2_tail(of_none - chi2, used) < DensitySpectrum::kLeastChance &&
         signal.segment(first, count).maxCoeff() >= kLeastSignal;
}

/// Whether a chain of samples has gone through the whole posterior.
bool is_mixed(double acceptance, const std::vector<double>& energy_flux,
              const std::vector<double>& mean_energy) {
  const double most_steps =
      std::max(kMostCorrelatedSamples, kMostCorrelatedShare * static_cast<double>(energy_flux.size()));
  const auto steps = [](std::vector<double> series) {
    for (double& one : series) one = std::log(one);
    return sim::autocorrelation_time(series, 1);
  };
  return acceptance >= kLeastAcceptance && steps(energy_flux) <= most_steps &&
         steps(mean_energy) <= most_steps;
}

/// `drawn`: unknowns of the profile's problem.
DensitySpectrum summary(const DensityPhysics& physics, const SolvedProfile& solved,
                        const SpectrumPosterior::Samples& drawn, const EnergyRange& range,
                        const EnergyRange& told) {
  constexpr double kPerErg = 6.241509074e8;  // keV; 1 mW m^-2 is 1 erg cm^-2 s^-1
  const EnergyBins& bins = physics.bins();
  const SpectrumPosterior posterior(physics, solved.problem);
  const Eigen::Index places = solved.problem.density_cm3.size(), count = drawn.at.cols();
  std::vector<std::vector<double>> flux(bins.count());
  std::vector<double> energy_flux, mean_energy;
  for (Eigen::Index s = 0; s < count; ++s) {
    const SpectrumPosterior::Meaning of = posterior.meaning(drawn.at.col(s));
    double sum = 0.0, number = 0.0;
    for (std::size_t j = 0; j < bins.count(); ++j) {
      const double here = of.flux_mw_m2[static_cast<Eigen::Index>(j)],
                   electrons = kPerErg * here / bins.middle_kev(j);
      flux[j].push_back(electrons / (bins.edge_kev[j + 1] - bins.edge_kev[j]));
      if (j < range.first || j >= range.first + range.count) continue;
      sum += here;
      number += here / bins.middle_kev(j);
    }
    energy_flux.push_back(sum);
    mean_energy.push_back(sum / number);
  }
  DensitySpectrum result;
  result.energy_flux_mw_m2 = quantiles(energy_flux);
  result.mean_energy_kev = quantiles(mean_energy);
  const SpectrumPosterior::Meaning best = posterior.meaning(solved.peak.at);
  if (!std::isfinite(best.chi2))
    return unknown_spectrum(physics, static_cast<std::size_t>(places), DensityVerdict::not_found);
  const Eigen::VectorXd signal = posterior.signal(solved.peak.at);
  const bool has_electrons = sees_electrons(solved, signal, best.chi2, range);
  for (std::size_t j = 0; j < bins.count(); ++j) {
    SampledNumber number = kUnknown;
    if (j >= told.first && j < told.first + told.count) {
      number = quantiles(flux[j]);
      const double here = signal[static_cast<Eigen::Index>(j)];
      const bool is_seen = here >= kLeastSignal;
      if (!is_seen) {
        // The prior alone says how small it is: the densities allow what changes them by their errors.
        const double usual = number.value;
        number.high68 = std::max(number.high68, usual + usual / here);
        number.high95 = std::max(number.high95, usual + 2.0 * usual / here);
      }
      if (!is_seen || number.high68 > kKnownFactor * number.low68)
        number.value = number.low68 = number.low95 = sim::kNaN;
    }
    result.flux_cm2_s_kev.push_back(number);
  }
  result.density_cm3.assign(best.density_cm3.data(), best.density_cm3.data() + places);
  result.chi2 = best.chi2;
  const auto measured = static_cast<double>((solved.problem.one_over_sigma.array() > 0.0).count());
  result.degrees_of_freedom = std::max(0.0, measured - solved.peak.used_freedom);
  const int whole = static_cast<int>(std::lround(result.degrees_of_freedom));
  const double physics_chi2 =
      best.state.segment(spectrum_numbers(physics), solved.problem.modes.ln_pairs.cols()).squaredNorm();
  result.chance = std::min(sim::chi2_tail(result.chi2, std::max(1, whole)),
                           sim::chi2_tail(result.chi2 + physics_chi2, static_cast<int>(measured)));
  const bool contradicts = result.chance < DensitySpectrum::kLeastChance;
  const bool mixed = is_mixed(drawn.acceptance, energy_flux, mean_energy);
  result.verdict = contradicts     ? DensityVerdict::contradicted
                   : !mixed        ? DensityVerdict::not_found
                   : has_electrons ? DensityVerdict::explained
                                   : DensityVerdict::no_electrons;
  if (result.verdict == DensityVerdict::no_electrons) {
    result.mean_energy_kev = kUnknown;
    Eigen::VectorXd shares = Eigen::VectorXd::Zero(best.flux_mw_m2.size());
    const auto first = static_cast<Eigen::Index>(range.first), many = static_cast<Eigen::Index>(range.count);
    shares.segment(first, many).setConstant(1.0 / static_cast<double>(many));
    keep_upper_ends(posterior, solved, shares, 1.0, result.energy_flux_mw_m2);
    for (std::size_t j = told.first; j < told.first + told.count; ++j) {
      const double electrons = kPerErg / (bins.middle_kev(j) * (bins.edge_kev[j + 1] - bins.edge_kev[j]));
      if (signal[static_cast<Eigen::Index>(j)] >= kLeastSignal) continue;
      keep_upper_ends(posterior, solved, Eigen::VectorXd::Unit(shares.size(), static_cast<Eigen::Index>(j)),
                      electrons, result.flux_cm2_s_kev[j]);
    }
  }
  if (contradicts || !mixed) {
    result.energy_flux_mw_m2 = result.mean_energy_kev = kUnknown;
    result.flux_cm2_s_kev.assign(bins.count(), kUnknown);
  }
  return result;
}

/// How the profiles of a sequence follow each other.
struct Cadence {
  std::vector<double> seconds;  ///< of each profile
  std::vector<double> since_s;  ///< since the profile before; infinite after a gap
};
Cadence cadence_of(const DensityTable& table) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < table.profiles.size(); ++i)
    steps.push_back(table.profiles[i].time_s - table.profiles[i - 1].time_s);
  std::vector<double> sorted = steps;
  const double usual = sim::quantile(sorted, 0.5), most = kGapOfUsual * usual;
  Cadence cadence;
  for (std::size_t i = 0; i <= steps.size(); ++i) {
    // Integrations follow each other, and change half-way between their middles.
    const bool follows = i > 0 && steps[i - 1] <= most, leads = i < steps.size() && steps[i] <= most;
    const double before = follows ? steps[i - 1]
                          : leads ? steps[i]
                                  : usual,
                 after = leads ? steps[i] : before;
    cadence.seconds.push_back(0.5 * (before + after));
    cadence.since_s.push_back(follows ? steps[i - 1] : std::numeric_limits<double>::infinity());
  }
  return cadence;
}

/// Solves the profiles in turn, with spectra that are remembered for a time. `use` gets each and returns
/// samples of it, or none for the next to begin anew.
template <class Use>
void follow(const DensityPhysics& physics, const DensityTable& table, std::size_t count,
            const DensityInversionOptions& options, double memory_s, double usual_flux, const Use& use) {
  const Cadence cadence = cadence_of(table);
  ProfileBefore before;
  for (std::size_t i = 0; i < count; ++i) {
    const DensityProfile& profile = table.profiles[i];
    if (profile.measured() < kLeastAltitudes) {
      before = {};
      continue;
    }
    if (std::isinf(cadence.since_s[i])) before = {};
    const SolvedProfile solved =
        solve_profile(physics, profile, {cadence.seconds[i], usual_flux, options.has_uncertainty}, before);
    const Eigen::MatrixXd samples = use(i, solved);
    before = {};
    if (i + 1 < count && samples.cols() > 0)
      before = before_next(physics, solved, samples, std::exp(-cadence.since_s[i + 1] / memory_s));
  }
}

/// How long spectra may be alike, in usual times between profiles.
constexpr std::array<double, 4> kSteps = {0.5, 2.0, 8.0, 32.0};
std::size_t profiles_for_memory(const DensityTable& table) {
  return std::min<std::size_t>(100, table.profiles.size());
}

/// Tells how many of all solutions are done.
class Done {
 public:
  Done(const std::function<void(double share)>& progress, std::size_t all) : progress_(progress), all_(all) {}
  void next() {
    const std::size_t done = ++done_;
    if (progress_) progress_(static_cast<double>(done) / static_cast<double>(all_));
  }

 private:
  const std::function<void(double share)>& progress_;
  std::size_t all_;
  std::atomic<std::size_t> done_{0};
};

/// Returns how long spectra are alike, s, by which the densities are most probable. Physics, which is the
/// same at all times, is taken as exact.
double likely_memory_s(const DensityPhysics& physics, const DensityTable& table,
                       const DensityInversionOptions& options, double usual_flux, Done& done) {
  constexpr int kNormalSamples = 300;
  const Cadence cadence = cadence_of(table);
  std::vector<double> seconds = cadence.seconds;
  const double usual_s = sim::quantile(seconds, 0.5);
  DensityInversionOptions exact = options;
  exact.has_uncertainty = false;
  std::array<double, kSteps.size()> evidence{};
  sim::parallel_for(kSteps.size(), options.threads, [&](std::size_t k, int) {
    follow(physics, table, profiles_for_memory(table), exact, kSteps[k] * usual_s, usual_flux,
           [&](std::size_t i, const SolvedProfile& solved) {
             done.next();
             if (!solved.peak.is_found()) {
               evidence[k] = -std::numeric_limits<double>::infinity();
               return Eigen::MatrixXd();
             }
             evidence[k] += solved.peak.ln_evidence;
             return normal_samples(solved.peak, kNormalSamples, i);
           });
  });
  const auto best = std::max_element(evidence.begin(), evidence.end()) - evidence.begin();
  return usual_s * kSteps[static_cast<std::size_t>(best)];
}

}  // namespace density_inversion

EnergyRange known_energies(const DensityPhysics& physics, const DensityInversionOptions& options) {
  const std::vector<double>& altitudes = physics.altitudes_km();
  EnergyRange range;
  for (std::size_t j = 0; j < physics.bins().count(); ++j) {
    const double peak_km = physics.peak_km(j), energy_kev = physics.bins().middle_kev(j);
    const bool is_inside = peak_km >= altitudes.front() && peak_km <= altitudes.back();
    if (!is_inside || energy_kev < options.least_kev || energy_kev > options.most_kev) continue;
    if (range.count == 0) range.first = j;
    range.count = j + 1 - range.first;
  }
  if (range.count == 0)
    throw sim::Error(sim::ErrorKind::usage,
                     fmt::format("electrons of these energies ionise most outside of {:g} to {:g} km",
                                 altitudes.front(), altitudes.back()))
        .key("--energies-kev")
        .expected("energies that the altitudes tell of");
  range.least_kev = physics.bins().edge_kev[range.first];
  range.most_kev = physics.bins().edge_kev[range.first + range.count];
  return range;
}

std::vector<DensitySpectrum> invert_densities(const DensityPhysics& physics, const DensityTable& table,
                                              const DensityInversionOptions& options) {
  using namespace density_inversion;
  std::vector<DensitySpectrum> results(table.profiles.size());
  const EnergyRange range = known_energies(physics, options), told = known_energies(physics, {});
  for (std::size_t i = 0; i < results.size(); ++i)
    results[i] = unknown_spectrum(physics, table.altitude_km.size());
  Done done(options.progress,
            results.size() + (options.is_steady ? 0 : kSteps.size() * profiles_for_memory(table)));
  const auto samples_of = [&](std::size_t i, const SolvedProfile& solved) {
    done.next();
    if (!solved.peak.is_found()) {
      results[i] = unknown_spectrum(physics, table.altitude_km.size(), DensityVerdict::not_found);
      return Eigen::MatrixXd();
    }
    constexpr int kLongStride = 6;
    const SpectrumPosterior posterior(physics, solved.problem);
    SpectrumPosterior::Samples samples = posterior.samples(solved.peak, options.samples, i);
    results[i] = summary(physics, solved, samples, range, told);
    if (results[i].verdict == DensityVerdict::not_found) {
      samples = posterior.samples(solved.peak, options.samples, i, kLongStride);
      results[i] = summary(physics, solved, samples, range, told);
    }
    if (results[i].verdict == DensityVerdict::not_found)
      return normal_samples(solved.peak, options.samples,
                            i);  // good enough for what is known before the next
    return results[i].contradicts() ? Eigen::MatrixXd() : samples.at;
  };
  if (options.is_steady) {
    sim::parallel_for(results.size(), options.threads, [&](std::size_t i, int) {
      const DensityProfile& profile = table.profiles[i];
      if (profile.measured() < kLeastAltitudes) return;
      const double forever = std::numeric_limits<double>::infinity();
      samples_of(i,
                 solve_profile(physics, profile,
                               {forever, needed_flux_mw_m2(physics, profile), options.has_uncertainty}, {}));
    });
    return results;
  }
  double ln_flux = 0.0;
  for (const DensityProfile& profile : table.profiles)
    ln_flux += std::log(needed_flux_mw_m2(physics, profile)) / static_cast<double>(results.size());
  const double usual_flux = std::exp(ln_flux);
  follow(physics, table, results.size(), options, likely_memory_s(physics, table, options, usual_flux, done),
         usual_flux, samples_of);
  return results;
}

}  // namespace vegard::fit
