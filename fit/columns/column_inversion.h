// The column-ratio inversion: from the brightnesses of two or more lines, each with its error, to the energy
// flux and the characteristic energy of the electrons and, where the tables have several, the factor of
// atomic oxygen.
//
// The method goes back to Rees and Luckey 1974 (J. Geophys. Res. 79, 5181, doi:10.1029/JA079i034p05181):
// 427.8 nm measures the energy flux, 630.0 nm over 427.8 nm falls with the energy, and lines of atomic oxygen
// (844.6 nm) measure the density of atomic oxygen.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fit/columns/column_chi2.h"
#include "fit/uncertainty/profile_likelihood.h"
#include "sim/base/number/chi_squared.h"

namespace vegard::fit {

enum class ColumnVerdict {
  well_constrained,
  loosely_constrained,  ///< closed intervals, but wide ones
  one_sided,            ///< an interval ends at an end of the tables
  two_solutions,
  contradiction,  ///< no electrons in the tables give these brightnesses
  no_light,       ///< for maps: no line exceeds its error
  not_measured,   ///< for maps: a brightness, or its error, is missing
  other_spectrum  ///< electrons of another spectrum give these brightnesses better
};
/// "well constrained".
const char* column_verdict_name(ColumnVerdict verdict);

/// Estimate of one unknown: energy in keV, flux in mW m^-2, or the factor of oxygen.
struct ColumnEstimate {
  double value = 0.0;
  bool is_free = false;
  double sigma_ln = 0.0;        ///< standard deviation of its logarithm, by the covariance; NaN at an edge
  double sigma_ln_alone = 0.0;  ///< standard deviation for known other unknowns
  OpenInterval interval68, interval95;  ///< by the likelihood; a missing end lies beyond the tables
};

struct ColumnSolution {
  std::array<ColumnEstimate, kColumnUnknowns> of;
  double chi2 = 0.0;
  ColumnMatrix correlation = ColumnMatrix::Identity();  ///< of the logarithms
  std::vector<double> rayleigh;                         ///< of the model, by line, with the corrections
  /// What the data ask of the tables' light, by line; empty for exact tables.
  std::vector<LineCorrection> corrections;
};

/// What another spectrum of the electrons makes of the lines.
struct SpectrumTrial {
  std::string words;  ///< "a Gaussian, spread 0.25"
  double chi2 = 0.0;
  double energy_kev = 0.0, energy_flux_mw_m2 = 0.0;
  std::optional<double> soft_ratio;  ///< where a soft component is free
  bool contradicts = false;
};

struct ColumnInversion {
  std::vector<double> lines_nm;
  ColumnData data;
  std::vector<ColumnSolution> solutions;  ///< the best first, then those not excluded at 95 %
  int degrees_of_freedom = 0;
  double p_value = 1.0;  ///< probability of such a large chi2 by chance; 1 without degrees of freedom
  ColumnVerdict verdict = ColumnVerdict::well_constrained;
  std::string reason;                     ///< in one sentence
  std::vector<std::string> degeneracies;  ///< a sentence each
  std::vector<SpectrumTrial> spectra;  ///< other spectra that were tried, the best first (spectrum_trials.h)
};

/// Inverts line brightnesses, of which there must be at least as many as free unknowns. An unknown's interval
/// reaches to where chi2, minimised over the other unknowns, rises by 1 (68 %) or by 4 (95 %).
ColumnInversion invert_columns(const ColumnChi2& chi2, const ColumnData& data);

/// Returns the number of lines minus that of free unknowns.
int degrees_of_freedom(const ColumnChi2& chi2);

using sim::chi2_tail;

/// True if a chi2 is too large for these tables, by kMaxColumnChi2 or kMinChance.
bool contradicts_tables(double chi2, int degrees_of_freedom);

/// A second minimum is reported as a solution if its chi2 exceeds that of the best by at most
/// kEquivalentChi2, and the barrier between them is at least kMinBarrier.
inline constexpr double kEquivalentChi2 = 4.0, kMinBarrier = 0.5;
/// Lines contradict the tables if their chi2 exceeds kMaxColumnChi2 (without degrees of freedom), or if its
/// probability is below kMinChance (with some).
inline constexpr double kMaxColumnChi2 = 9.0, kMinChance = 0.0027;
/// An interval is wide if the ratio of the ends at 95 % exceeds this factor.
inline constexpr double kWideFactor = 4.0;

}  // namespace vegard::fit
