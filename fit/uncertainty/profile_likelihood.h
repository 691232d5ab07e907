// Intervals from the profile likelihood: chi2 as a function of one coordinate, with all others fitted anew.
// If chi2 is not a parabola, such an interval is correctly asymmetric or open; if it is, the interval agrees
// with the covariance.
//
// Source: S. S. Wilks, "The large-sample distribution of the likelihood ratio for testing composite
// hypotheses", Annals of Mathematical Statistics 9 (1938) 60, doi:10.1214/aoms/1177732360: a rise of chi2 by
// 1 bounds 68.3 %, by 4 bounds 95.4 %.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

namespace vegard::fit {

/// Returns the smallest chi2 with coordinate j fixed at `fixed`. If there are priors, it must return the
/// data's chi2 over the inflation squared plus the priors' terms, with `inflation` left at 1, which is the
/// weighting of the covariance. `point` has all coordinates: on entry a guess with point[j] == fixed, on
/// return the position of the minimum.
using MinimisedChi2 = std::function<double(std::size_t j, double fixed, std::vector<double>& point)>;

struct ProfileLikelihoodOptions {
  double inflation = 1.0;             ///< rises of chi2 are in units of its square (see uncertainty.h)
  double first_step = 1.0;            ///< about a standard deviation of the coordinate, inflated
  std::optional<double> least, most;  ///< limits of the walk
  double max_steps = 20.0;  ///< limit of the walk in first_steps; an interval that is not closed here is open
  double tolerance = 0.01;  ///< of the square root of the rise at an end of an interval
  int max_minimisations = 30;  ///< on each side
  const std::atomic<bool>* stop = nullptr;
};

/// The result of one minimisation.
struct ProfilePoint {
  double fixed = 0.0;
  double rise = 0.0;          ///< of chi2, in units of the inflation squared
  std::vector<double> point;  ///< all coordinates; the change of the others shows the trade-off
};

struct OpenInterval {
  std::optional<double> lower, upper;  ///< none: chi2 does not rise that far within the limits of the walk
};

struct LikelihoodProfile {
  std::size_t coordinate = 0;
  OpenInterval interval68, interval95;  ///< rises of 1 and of 4
  std::vector<ProfilePoint> path;       ///< ordered by `fixed`, the answer among them
  /// A point whose chi2 is below the answer's by more than 0.01 (in units of the inflation squared): the
  /// answer was not the minimum. The walk on this side ends here, and the fit should be continued from this
  /// point.
  std::optional<ProfilePoint> better;
  bool whole = true;  ///< false: stopped, or `max_minimisations` were not enough
};

/// Walks from `answer`, where chi2 is `min_chi2`, to both sides. The walk does not go beyond a point at which
/// the minimisation returns no finite number.
LikelihoodProfile profile_likelihood(std::size_t j, const std::vector<double>& answer, double min_chi2,
                                     const MinimisedChi2& minimised, const ProfileLikelihoodOptions& options);

}  // namespace vegard::fit
