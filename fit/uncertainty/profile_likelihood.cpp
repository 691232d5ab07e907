#include "fit/uncertainty/profile_likelihood.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vegard::fit {
namespace {

constexpr double kRises[2] = {1.0, 4.0};
constexpr double kBetter = -0.01;  // a rise below it is no noise of the minimiser
constexpr double kMinGrowth = 1.15,
                 kMaxGrowth = 2.0;   // of the distance, from one step outwards to the next
constexpr double kOvershoot = 1.03;  // a step is to land beyond its target

/// The walk to one side. Distances from the answer count as positive on either side.
class Walk {
 public:
  Walk(std::size_t j, double sign, const std::vector<double>& answer, double min_chi2,
       const MinimisedChi2& minimised, const ProfileLikelihoodOptions& options, LikelihoodProfile& profile)
      : j_(j), sign_(sign), min_chi2_(min_chi2), minimised_(minimised), options_(options), profile_(profile) {
    seen_.push_back({answer[j], 0.0, answer});
    end_ = options.max_steps * options.first_step;
    const std::optional<double>& limit = sign < 0.0 ? options.least : options.most;
    if (limit) end_ = std::min(end_, std::max(0.0, sign * (*limit - answer[j])));
  }

  void go(std::optional<double> (&bounds)[2]) {
    for (int level = 0; level < 2; ++level) {
      if (!outwards_to(kRises[level])) return;
      bounds[level] = root(kRises[level]);
      if (!bounds[level]) return;
    }
  }

  const std::vector<ProfilePoint>& seen() const { return seen_; }  ///< ordered by distance

 private:
  double distance(const ProfilePoint& p) const { return sign_ * (p.fixed - seen_.front().fixed); }
  static double height(const ProfilePoint& p) { return std::sqrt(std::max(0.0, p.rise)); }

  /// The others where they are on the line through the two known points nearest to `away`.
  std::vector<double> guess(double away, double fixed) const {
    std::vector<double> point = seen_.back().point;
    if (seen_.size() > 1) {
      std::size_t upper = 1;
      while (upper + 1 < seen_.size() && distance(seen_[upper]) < away) ++upper;
      const ProfilePoint &a = seen_[upper - 1], &b = seen_[upper];
      const double t = (away - distance(a)) / (distance(b) - distance(a));
      for (std::size_t k = 0; k < point.size(); ++k) point[k] = a.point[k] + t * (b.point[k] - a.point[k]);
    }
    point[j_] = fixed;
    return point;
  }

  /// False: there is nothing more to be learnt on this side.
  bool look(double away) {
    if (options_.stop != nullptr && options_.stop->load()) return profile_.whole = false;
    if (minimisations_++ >= options_.max_minimisations) return profile_.whole = false;
    ProfilePoint p;
    p.fixed = seen_.front().fixed + sign_ * away;
    p.point = guess(away, p.fixed);
    const double chi2 = minimised_(j_, p.fixed, p.point);
    p.rise = (chi2 - min_chi2_) / (options_.inflation * options_.inflation);
    if (!std::isfinite(p.rise)) return false;
    if (p.rise < kBetter) {
      if (!profile_.better || p.rise < profile_.better->rise) profile_.better = p;
      return false;
    }
    seen_.insert(std::find_if(seen_.begin(), seen_.end(),
                              [&](const ProfilePoint& other) { return distance(other) > away; }),
                 std::move(p));
    return true;
  }

  /// Until the outermost point is as high as `rise`.
  bool outwards_to(double rise) {
    const double target = std::sqrt(rise);
    while (height(seen_.back()) < target) {
      const double at = distance(seen_.back());
      if (at >= end_) return false;
      double next = options_.first_step * target;
      if (seen_.size() > 1) {
        const double h = height(seen_.back());
        const double growth = h > 0.0 ? kOvershoot * target / h : kMaxGrowth;
        next = at * std::clamp(growth, kMinGrowth, kMaxGrowth);
      }
      if (!look(std::min(next, end_))) return false;
    }
    return true;
  }

  /// Where the rise is `rise`: by secants of its square root, a straight line for a parabola, between the two
  /// points that embrace it; halved where those do not close in.
  std::optional<double> root(double rise) {
    const double target = std::sqrt(rise);
    double width = std::numeric_limits<double>::infinity();
    for (;;) {
      std::size_t upper = 1;
      while (height(seen_[upper]) < target) ++upper;
      const ProfilePoint &a = seen_[upper - 1], &b = seen_[upper];
      const double low = distance(a), high = distance(b), ha = height(a), hb = height(b);
      const double at = low + (high - low) * (target - ha) / (hb - ha);
      const double near = options_.tolerance * target;
      if (hb - target < near) return b.fixed + sign_ * (at - high);
      if (target - ha < near) return a.fixed + sign_ * (at - low);
      const bool slow = high - low > 0.5 * width;
      width = high - low;
      if (width < 1e-9 * std::max(high, std::abs(b.fixed))) return b.fixed;  // a step, not a slope
      if (!look(slow ? 0.5 * (low + high) : at)) return {};
    }
  }

  const std::size_t j_;
  const double sign_, min_chi2_;
  const MinimisedChi2& minimised_;
  const ProfileLikelihoodOptions& options_;
  LikelihoodProfile& profile_;
  std::vector<ProfilePoint> seen_;
  double end_ = 0.0;
  int minimisations_ = 0;
};

}  // namespace

LikelihoodProfile profile_likelihood(std::size_t j, const std::vector<double>& answer, double min_chi2,
                                     const MinimisedChi2& minimised,
                                     const ProfileLikelihoodOptions& options) {
  LikelihoodProfile profile;
  profile.coordinate = j;
  std::optional<double> lower[2], upper[2];
  Walk down(j, -1.0, answer, min_chi2, minimised, options, profile);
  down.go(lower);
  Walk up(j, 1.0, answer, min_chi2, minimised, options, profile);
  up.go(upper);
  profile.interval68 = {lower[0], upper[0]};
  profile.interval95 = {lower[1], upper[1]};
  profile.path.assign(down.seen().rbegin(), down.seen().rend());
  profile.path.insert(profile.path.end(), up.seen().begin() + 1, up.seen().end());
  return profile;
}

}  // namespace vegard::fit
