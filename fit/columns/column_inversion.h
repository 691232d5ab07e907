// The column-ratio inversion: brightnesses of two or more lines, each with its error, to the energy flux and
// the characteristic energy of the electrons and, where the tables know several, the factor of atomic oxygen.
//
// Of the kind that Rees and Luckey 1974 (J. Geophys. Res. 79, 5181, doi:10.1029/JA079i034p05181) began:
// 427.8 nm counts the energy, 630.0 nm over 427.8 nm falls with it, and lines of atomic oxygen (844.6 nm) say
// how much of that there is.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fit/columns/column_chi2.h"
#include "fit/uncertainty/profile_likelihood.h"

namespace vegard::fit {

enum class ColumnVerdict {
  well_constrained,
  loosely_constrained,  ///< closed intervals, but wide ones
  one_sided,            ///< an end of an interval is the end of the tables
  two_solutions,
  contradiction,  ///< no electrons of the tables make these lines
  no_light,       ///< of maps: no line stands out of its error
  not_measured,   ///< of maps: a brightness, or its error, is missing
};
/// "well constrained".
const char* column_verdict_name(ColumnVerdict verdict);

/// Energy in keV, flux in mW m^-2, the factor of oxygen.
struct ColumnEstimate {
  double value = 0.0;
  bool is_free = false;
  double sigma_ln = 0.0;        ///< standard deviation of its logarithm by the covariance; NaN at an edge
  double sigma_ln_alone = 0.0;  ///< the same if the others were known
  OpenInterval interval68, interval95;  ///< by the likelihood; an end that is missing lies beyond the tables
};

struct ColumnSolution {
  std::array<ColumnEstimate, kColumnUnknowns> of;
  double chi2 = 0.0;
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Identity();  ///< of the logarithms
  std::vector<double> rayleigh;                               ///< of the model, by line
};

struct ColumnInversion {
  std::vector<double> lines_nm;
  ColumnData data;
  std::vector<ColumnSolution>
      solutions;  ///< the best first; others that chi2 cannot distinguish from it at 95 %
  int degrees_of_freedom = 0;
  double p_value = 1.0;  ///< of so large a chi2 by chance; 1 without degrees of freedom
  ColumnVerdict verdict = ColumnVerdict::well_constrained;
  std::string reason;                     ///< in one sentence
  std::vector<std::string> degeneracies;  ///< a sentence each
};

/// At least as many lines as unknowns are free. Each unknown's interval is where chi2, the others at their
/// best, rises by 1 and by 4.
ColumnInversion invert_columns(const ColumnChi2& chi2, const ColumnData& data);

/// Of more than so much by chance, for whole degrees of freedom of 1 or more.
double chi2_tail(double chi2, int degrees_of_freedom);

/// A second valley counts if chi2 rises by less than this from the best to it, and by more than
/// kMinBarrier on the way back.
inline constexpr double kEquivalentChi2 = 4.0, kMinBarrier = 0.5;
/// chi2 that lines without a degree of freedom may be off, and the chance below which those with some are.
inline constexpr double kMaxColumnChi2 = 9.0, kMinChance = 0.0027;
/// Wide: the ends of a 95 % interval are more than this factor apart.
inline constexpr double kWideFactor = 4.0;

}  // namespace vegard::fit
