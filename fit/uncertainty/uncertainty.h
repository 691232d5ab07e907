// Error bars of a fit from the Jacobian at its answer.
#pragma once

#include <functional>
#include <vector>

namespace vegard::fit {

/// What a mode of the emission tables' uncertainty (sim/light/tables/light_modes.h) does to an answer, by one
/// standard deviation of its coefficient and to first order.
struct ModeShift {
  int mode = 0;               ///< from 0
  std::vector<double> shift;  ///< of every coordinate; its squares are part of the covariance
  /// Changes of each photograph's gains and sky at fixed coordinates, [photograph][coefficient].
  std::vector<std::vector<double>> coefficients;
};

struct Uncertainty {
  std::vector<double> sigma;  ///< of every coordinate; NaN where the data do not determine it
  std::vector<std::vector<double>> correlation;  ///< zeros for coordinates without an error bar
  /// Covariance of the coordinates, with the information of their limits; for derived numbers
  /// (delta_method.h).
  std::vector<std::vector<double>> covariance;
  /// Directions that the data do not determine, each with a largest component of 1.
  std::vector<std::vector<double>> undetermined;
  double inflation = 1.0;  ///< already applied to sigma
  /// By how much more the scatter of the bands widens the error bar of every coordinate (band_scatter.h); not
  /// applied yet.
  std::vector<double> by_bands{};
  std::vector<ModeShift> modes{};  ///< of physics_uncertainty.h
};

/// Share of the variance inside a coordinate's limits above which it is undetermined.
inline constexpr double kLeftOpen = 0.25;

/// Knowledge of the coordinates from other sources than the data.
struct PriorKnowledge {
  std::vector<double> information;  ///< information matrix of priors, row-major [coordinate][coordinate]
  /// Variance of each coordinate for a uniform distribution between its limits; infinity without limits.
  std::vector<double> limit_variance;
  std::vector<bool> has_prior;  ///< [coordinate] a prior bounds it, whatever the data are
};

/// Returns the absence of prior knowledge for this number of coordinates.
PriorKnowledge no_prior_knowledge(std::size_t coordinates);

/// Computes the covariance from the Jacobians of independent samplings of one scene, each row-major
/// [residual][coordinate]. The data's information is the mean of the products of *different* samplings, so
/// that a Jacobian's Monte-Carlo noise, whose square would look like information, cancels. The information in
/// a direction is set to 0 if it is within two standard errors of 0, by the scatter of the products, or below
/// 1e-12 of the largest. Then the information of priors and of limits is added.
///
/// A direction is undetermined if its variance is more than a quarter of the variance that the limits allow.
/// A coordinate that is affected by an undetermined direction and has no prior has no error bar.
Uncertainty uncertainty(const std::vector<std::vector<double>>& jacobians, int residuals, int coordinates,
                        const PriorKnowledge& prior, double inflation);

// Tests whether chi2 is a parabola about the answer, as error bars from its curvature assume, and corrects
// the error bars where it is not.

/// Chi2 at the answer plus a step, in coordinates, less chi2 at the answer, divided by the inflation squared;
/// and half of its gradient there, which may be left out, or be empty where it is not known.
struct ChiSquareRise {
  std::function<double(const std::vector<double>& step)> rise;
  std::function<std::vector<double>(const std::vector<double>& step)> half_gradient = nullptr;
};

/// Evaluates chi2 three standard deviations to either side of the answer along every principal axis of the
/// covariance. If on either side chi2 rises by less than a quarter of the parabola's rise, chi2 is not a
/// parabola. If it rises by much more or less than the parabola, the axis may miss the bottom of a valley:
/// with the coordinate that it changes most held, the others go down by the gradient, and chi2 is asked
/// there. If chi2 rises enough twice, four or eight times as far out, the axis' standard deviation is
/// multiplied by this factor. If it does not, the data do not bound the parameters in this direction (for
/// example a sheet's end at the edge of the picture: moving it outwards raises chi2, moving it inwards does
/// not). Then the axis is removed from the covariance and added to the undetermined directions, and
/// coordinates whose error bar is due to it by more than half lose their error bar.
///
/// `bounded` marks coordinates that are bounded by other knowledge than the data: an axis that consists
/// almost only of these is not tested.
void drop_flat_directions(const ChiSquareRise& rise, const std::vector<bool>& bounded, Uncertainty& u);

}  // namespace vegard::fit
