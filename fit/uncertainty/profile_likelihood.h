// Intervals from the profile likelihood: what chi2 says of one coordinate when all others give way as best
// they can. Where chi2 is no parabola, such an interval is lopsided or open, as it should be; where it is
// one, the interval is the covariance's.
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

/// chi2, the least that it can be with coordinate j held at `fixed`. Where priors share in it, give chi2 of
/// the data over the inflation squared plus the priors' terms, and leave `inflation` at 1: so the covariance
/// weighs them. `point` is all coordinates, a guess with
/// point[j] == fixed on the way in, and where the least was found on the way out.
using MinimisedChi2 = std::function<double(std::size_t j, double fixed, std::vector<double>& point)>;

struct ProfileLikelihoodOptions {
  double inflation = 1.0;             ///< rises are counted in units of its square (see uncertainty.h)
  double first_step = 1.0;            ///< about a standard deviation of the coordinate, inflated
  std::optional<double> least, most;  ///< the walk ends there
  double max_steps = 20.0;     ///< and so many first_steps from the answer: beyond, the data bound nothing
  double tolerance = 0.01;     ///< of the square root of the rise at an end of an interval
  int max_minimisations = 30;  ///< on each side
  const std::atomic<bool>* stop = nullptr;
};

/// One minimisation on the way outwards.
struct ProfilePoint {
  double fixed = 0.0;
  double rise = 0.0;          ///< of chi2, in units of the inflation squared
  std::vector<double> point;  ///< all coordinates: how the others give way is the trade-off
};

struct OpenInterval {
  std::optional<double> lower, upper;  ///< none: chi2 does not rise that far within the limits of the walk
};

struct LikelihoodProfile {
  std::size_t coordinate = 0;
  OpenInterval interval68, interval95;  ///< rises of 1 and of 4
  std::vector<ProfilePoint> path;       ///< ordered by `fixed`, the answer among them
  /// A point with less chi2 than the answer, by more than a hundredth of the unit: the answer was none. The
  /// walk on that side ends there, and the fit should be taken up again from this point.
  std::optional<ProfilePoint> better;
  bool whole = true;  ///< false: stopped, or `max_minimisations` did not do
};

/// Walks from `answer`, where chi2 is `min_chi2`, to both sides. A minimisation that gives no finite number
/// counts as a wall: the walk does not go beyond it.
LikelihoodProfile profile_likelihood(std::size_t j, const std::vector<double>& answer, double min_chi2,
                                     const MinimisedChi2& minimised, const ProfileLikelihoodOptions& options);

}  // namespace vegard::fit
