// The error of the physics in the error bars of a fit: what the uncertainty of the emission tables
// (sim/light/tables/light_modes.h) does to the answer, and what the data say of it.
//
// The coefficients of the modes are not estimated, but considered (Schmidt 1966, "Application of state-space
// methods to navigation problems", Advances in Control Systems 3): had they been a_k instead of 0, the answer
// would be another one, by -C (g(a) - g(0)) in the solver's coordinates, C the covariance of the answer
// before its inflation and g half the gradient of the data's chi2 there. The squares of these shifts for a_k
// of one standard deviation are added to the covariance. So error bars contain the error of the tables even
// where the shape of the light, which a picture shows to a per cent, is not spanned by the modes; but nothing
// is learnt of the modes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fit/compare/observation.h"
#include "fit/uncertainty/mode_information.h"
#include "fit/uncertainty/uncertainty.h"

namespace vegard::fit {

/// A cost about an answer, linear in its coordinates (without anchors of phases) and in the coefficients of
/// the modes that are to be considered. Derivatives by a coefficient are differences over a tenth of a
/// standard deviation to one side: the second order, at one standard deviation up to a quarter of the first,
/// is then some per cent of it. A second side would double the time, for a frame of a sequence to that of its
/// descent.
struct ModeEffects {
  std::vector<int> modes;           ///< from 0; those whose coefficient is not among the free numbers
  Eigen::VectorXd residual;         ///< of the data
  Eigen::MatrixXd jacobian;         ///< d residual / d coordinate
  Eigen::MatrixXd by_mode;          ///< d residual / d coefficient of each mode
  Eigen::MatrixXd gradient_change;  ///< d (half the gradient of the data's chi2) / d coefficient
  /// d (gain or sky) / d coefficient, at the answer: [mode][photograph][coefficient].
  std::vector<std::vector<std::vector<double>>> linear_part;
  Eigen::MatrixXd prior;               ///< information of the free numbers' priors and limits
  std::vector<double> limit_variance;  ///< of each coordinate; infinity where it has a prior
};

/// Evaluates the cost at the answer's values, with derivatives, once and once for each mode. No modes are
/// returned, without any evaluation, where the scene takes its tables as exact (emission.uncertainty), they
/// have no modes, or nothing shines by them.
ModeEffects mode_effects(const ProfileCost& cost, const std::vector<double>& values);

/// Adds the shifts by each mode to the covariance of `u`, in coordinates without anchors, and to `u.modes`. A
/// coordinate for which a shift is no number loses its error bar. So does one whose variance now is more than
/// kLeftOpen of that inside its limits, and what goes with it is one more undetermined direction. The other
/// sigmas and the correlation become those of the covariance.
void add_physics(const ModeEffects& effects, Uncertainty& u);

/// Returns what the data say of the coefficients by themselves, the data's errors times `inflation`, the
/// answer a minimum that follows the modes (Schur's complement); nothing if an effect is no number.
ModeInformation mode_information(const ModeEffects& effects, double inflation);

/// What the data and the modes' priors say of the considered modes.
struct LearntModes {
  std::vector<int> modes;      ///< from 0
  Eigen::VectorXd value;       ///< coefficients, from those of the scene
  Eigen::MatrixXd covariance;  ///< of these; the unit matrix before the data
};

/// Returns the step of Gauss and Newton that an answer and the modes would take together, the modes with
/// priors of mean 0 and standard deviation 1.
LearntModes learnt_modes(const ModeInformation& told);

}  // namespace vegard::fit
