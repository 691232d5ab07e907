// The error of the physics in the error bars of a fit: what the uncertainty of the emission tables
// (sim/light/tables/light_modes.h) does to the answer.
//
// The coefficients of the modes are not estimated, but considered (Schmidt 1966, "Application of state-space
// methods to navigation problems", Advances in Control Systems 3): had they been a_k instead of 0, the answer
// would be another one, by -C (g(a) - g(0)) in the solver's coordinates, C the covariance of the answer
// before its inflation and g half the gradient of the data's chi2 there. The squares of these shifts for a_k
// of one standard deviation are added to the covariance. So error bars contain the error of the tables even
// where the shape of the light, which a picture shows to a per cent, is not spanned by the modes; but nothing
// is learnt of the modes.
#pragma once

#include <vector>

#include "fit/compare/observation.h"
#include "fit/uncertainty/uncertainty.h"

namespace vegard::fit {

/// Adds to the covariance of `u`, in coordinates without anchors of phases, the shifts by each mode of the
/// scene's tables whose coefficient is not among the free numbers. Does nothing where the scene takes its
/// tables as exact (emission.uncertainty), they have no modes, or nothing shines by them. Evaluates the cost,
/// at the answer's values, with derivatives, once for each mode. A coordinate for which a shift is no number
/// loses its error bar; the other sigmas and the correlation become those of the covariance.
void add_physics(const ProfileCost& cost, const std::vector<double>& values, Uncertainty& u);

}  // namespace vegard::fit
