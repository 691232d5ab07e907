#include "fit/photo/rayleigh/factor_fit.h"

#include <algorithm>
#include <cmath>

#include "sim/base/number/quantile.h"

namespace vegard::fit {
namespace {

/// The start of a fit: the depth of the air at sea level on a clear night.
constexpr double kUsualDepth = 0.2;
constexpr double kOutlier = 4.0, kSigmaOfMedian = 1.4826;

class FactorSolver {
 public:
  FactorSolver(const std::vector<FactorDatum>& stars, std::optional<double> depth)
      : stars_(stars),
        is_depth_held_(depth.has_value()),
        depth_(depth.value_or(kUsualDepth)),
        used_(stars.size(), 1) {}

  std::optional<FactorFit> run() {
    begin();
    if (freedom() < 3) return std::nullopt;
    constexpr int kMaxRounds = 20;
    for (int round = 0; round < kMaxRounds; ++round) {
      find_scatter();
      if (!leave_out()) break;
      if (freedom() < 3) return std::nullopt;
    }
    FactorFit fit;
    fit.ln_factor = -a_;
    fit.ln_factor_error = std::sqrt(variance_a_);
    fit.depth = depth_;
    fit.depth_error = is_depth_held_ ? 0.0 : std::sqrt(variance_depth_);
    // ln factor is -a.
    fit.correlation = is_depth_held_ ? 0.0 : -covariance_ / std::sqrt(variance_a_ * variance_depth_);
    fit.scatter = scatter_;
    fit.degrees_of_freedom = freedom();
    fit.used = used_;
    return fit;
  }

 private:
  double model(std::size_t i) const { return std::exp(a_ - depth_ * stars_[i].airmass); }
  double variance(std::size_t i, double scatter) const {
    const double own = scatter * model(i);
    return stars_[i].sigma * stars_[i].sigma + own * own;
  }
  int freedom() const {
    return static_cast<int>(std::count(used_.begin(), used_.end(), 1)) - (is_depth_held_ ? 1 : 2);
  }

  /// The median of the bright half at a usual extinction, and what lies far off it.
  void begin() {
    std::vector<double> signal;
    for (const FactorDatum& star : stars_)
      signal.push_back(star.sigma > 0.0 ? star.rate_per_rayleigh / star.sigma : 0.0);
    std::vector<double> reordered = signal;
    const double bright = std::min(sim::median(reordered), 20.0);
    std::vector<double> logs;
    for (std::size_t i = 0; i < stars_.size(); ++i)
      if (stars_[i].rate_per_rayleigh > 0.0 && signal[i] >= bright)
        logs.push_back(std::log(stars_[i].rate_per_rayleigh) + depth_ * stars_[i].airmass);
    if (logs.empty()) {
      std::fill(used_.begin(), used_.end(), 0);
      return;
    }
    a_ = sim::median(logs);
    for (double& value : logs) value = std::abs(value - a_);
    constexpr double kMinScatter = 0.05;
    scatter_ = std::max(kSigmaOfMedian * sim::median(logs), kMinScatter);
    for (std::size_t i = 0; i < stars_.size(); ++i) used_[i] = is_near(i) ? 1 : 0;
  }

  bool is_near(std::size_t i) const {
    return std::abs(stars_[i].rate_per_rayleigh - model(i)) <= kOutlier * std::sqrt(variance(i, scatter_));
  }

  /// Rejects outliers; returns whether the set of used stars has changed.
  bool leave_out() {
    bool has_changed = false;
    for (std::size_t i = 0; i < stars_.size(); ++i) {
      const char used = is_near(i) ? 1 : 0;
      has_changed = has_changed || used != used_[i];
      used_[i] = used;
    }
    return has_changed;
  }

  /// Gauss-Newton with weights by the model; chi^2 of the answer.
  double solve(double scatter) {
    constexpr int kMaxSteps = 50;
    double chi2 = 0.0;
    for (int step = 0; step < kMaxSteps; ++step) {
      double aa = 0.0, at = 0.0, tt = 0.0, ga = 0.0, gt = 0.0;
      chi2 = 0.0;
      for (std::size_t i = 0; i < stars_.size(); ++i) {
        if (used_[i] == 0) continue;
        const double m = model(i), v = std::max(variance(i, scatter), 1e-12 * m * m);
        const double off = stars_[i].rate_per_rayleigh - m, by_a = m, by_depth = -m * stars_[i].airmass;
        aa += by_a * by_a / v;
        at += by_a * by_depth / v;
        tt += by_depth * by_depth / v;
        ga += by_a * off / v;
        gt += by_depth * off / v;
        chi2 += off * off / v;
      }
      double move_a = ga / aa, move_depth = 0.0;
      variance_a_ = 1.0 / aa;
      if (!is_depth_held_) {
        const double det = aa * tt - at * at;
        move_a = (tt * ga - at * gt) / det;
        move_depth = (aa * gt - at * ga) / det;
        variance_a_ = tt / det;
        variance_depth_ = aa / det;
        covariance_ = -at / det;
      }
      if (!std::isfinite(move_a) || !std::isfinite(move_depth)) break;
      a_ += std::clamp(move_a, -1.0, 1.0);
      depth_ += std::clamp(move_depth, -1.0, 1.0);
      if (std::abs(move_a) + std::abs(move_depth) < 1e-10) break;
    }
    return chi2;
  }

  void find_scatter() {
    const double wanted = freedom();
    scatter_ = 0.0;
    if (solve(0.0) <= wanted) return;
    double low = 0.0, high = 2.0;
    constexpr int kHalvings = 40;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (solve(middle) > wanted ? low : high) = middle;
    }
    scatter_ = high;
    solve(scatter_);
  }

  const std::vector<FactorDatum>& stars_;
  bool is_depth_held_;
  double depth_, a_ = 0.0, scatter_ = 0.0;
  double variance_a_ = 0.0, variance_depth_ = 0.0, covariance_ = 0.0;
  std::vector<char> used_;
};

}  // namespace

std::optional<FactorFit> fit_factor(const std::vector<FactorDatum>& stars, std::optional<double> depth) {
  return FactorSolver(stars, depth).run();
}

double student_68(int degrees_of_freedom) {
  // 1.142, 1.111, 1.091, 1.053 and 1.026 for 4, 5, 6, 10 and 20 degrees of freedom (tables of t at 0.8413).
  const double share = 1.0 / std::max(degrees_of_freedom, 1);
  return 1.0 + 0.5 * share + 0.28 * share * share;
}

}  // namespace vegard::fit
