// Spectra of electrons from profiles of electron density: each in a steady state, or one after another in
// time.
//
// In time the posterior of one profile is the prior of the next, of the density as the model of Virtanen et
// al. 2018 has it (spectrum_posterior.h), and of the spectrum, which is remembered for as long as makes the
// densities most probable (profile_solution.h). The first profile, and one after a gap, begins anew. Numbers
// are medians of samples and quantiles of them, which contain the errors of the density, the smoothness and
// the numbers of physics.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "fit/radar/density_table.h"
#include "fit/radar/spectrum_posterior.h"

namespace vegard::fit {

/// All NaN: unknown.
struct SampledNumber {
  double value, low68, high68, low95, high95;
};

struct DensityInversionOptions {
  bool is_steady = true;
  bool has_uncertainty = true;             ///< of physics
  double least_kev = 0.0, most_kev = 1e3;  ///< of Q and mean energy, within what the altitudes tell
  int samples = 1200;  ///< more make the ends of intervals less random: 3 % of an interval's width
  int threads = 0;
  std::function<void(double share)> progress;  ///< from any thread; a share may be smaller than one before
};

/// What is known of a profile's electrons.
enum class DensityVerdict {
  explained,
  contradicted,       ///< no electrons explain the density: no numbers
  no_electrons,       ///< the density does not show electrons of these energies: upper ends only
  too_few_altitudes,  ///< fewer than kLeastAltitudes: no numbers, no chi2
  not_found,          ///< there is no finite chi2, or the samples are not of the whole posterior: no numbers
};

struct DensitySpectrum {
  /// Number flux cm^-2 s^-1 keV^-1 by bin. NaN where no altitude tells of a bin; where the interval of 68 %
  /// is wider than kKnownFactor only its upper ends are known.
  std::vector<SampledNumber> flux_cm2_s_kev;
  SampledNumber energy_flux_mw_m2, mean_energy_kev;  ///< of the energies of EnergyRange
  std::vector<double> density_cm3;                   ///< of the largest posterior, by altitude
  double chi2 = 0.0, degrees_of_freedom = 0.0;
  /// The smaller of the probabilities of a larger chi2 by chance, and of a larger sum of it and the squares
  /// of the coefficients of physics, so that no unlikely physics explains a density.
  double chance = 1.0;
  DensityVerdict verdict = DensityVerdict::too_few_altitudes;
  bool contradicts() const { return verdict == DensityVerdict::contradicted; }
  bool has_numbers() const { return verdict == DensityVerdict::explained; }
  static constexpr double kLeastChance = 0.0027;
};

/// The ends of the 68 % interval of a known flux differ by no more; it is known from its neighbours too, so
/// that less than one error will do.
inline constexpr double kKnownFactor = 10.0, kLeastSignal = 0.3;
/// Samples are of the whole posterior if so large a share of steps is accepted, and if the samples' energy
/// flux and mean energy are not correlated over more of them: a share, or this many.
inline constexpr double kLeastAcceptance = 0.4, kMostCorrelatedShare = 0.03, kMostCorrelatedSamples = 20.0;

/// The bins whose electrons ionise most inside the altitudes and between the options' energies.
struct EnergyRange {
  std::size_t first = 0, count = 0;
  double least_kev = 0.0, most_kev = 0.0;
};
/// Throws Error(usage), key --energies-kev, if there is none.
EnergyRange known_energies(const DensityPhysics& physics, const DensityInversionOptions& options);

/// Profiles farther apart than so many median steps do not follow each other in time.
inline constexpr double kGapOfUsual = 3.0;

/// A spectrum a profile; in time at least two profiles. Does not depend on the number of threads.
std::vector<DensitySpectrum> invert_densities(const DensityPhysics& physics, const DensityTable& table,
                                              const DensityInversionOptions& options);

}  // namespace vegard::fit
