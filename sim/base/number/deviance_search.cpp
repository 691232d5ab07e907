#include "sim/base/number/deviance_search.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "sim/base/number/dense_solvers.h"

namespace vegard::sim {
namespace {

constexpr double kFirstStep = 0.1, kSearchMinStep = 0.01, kMaxStep = 0.25;
constexpr double kMaxWay = 0.5;              // of one round
constexpr double kSearchCloseEnough = 0.35;  // of the step between places: a third of a standard deviation
constexpr double kWideLook = 2.0;            // standard deviations: a parabola is not to be trusted that far
constexpr int kMaxRounds = 8, kSearchMaxHalvings = 2;
constexpr double kLeftOpen = 0.25;  // of the variance inside the limits, as of any parameter

class Minimum {
 public:
  Minimum(const std::vector<double>& start, double limit, const EvaluateDeviance& evaluate)
      : n_(static_cast<int>(start.size())), limit_(limit), evaluate_(evaluate) {
    centre_ = Eigen::Map<const Eigen::VectorXd>(start.data(), n_);
    step_ = Eigen::VectorXd::Constant(n_, kFirstStep);
  }

  DevianceMinimum run() {
    for (int round = 0; round < kMaxRounds; ++round) {
      for (int k = 0; k < n_; ++k) centre_(k) = std::clamp(centre_(k), step_(k) - limit_, limit_ - step_(k));
      if (!look_around()) break;
      const Eigen::VectorXd bottom = bottom_of_parabola();
      const Eigen::VectorXd way = bottom - centre_;
      const bool is_near = ((way.cwiseAbs() - kSearchCloseEnough * step_).array() <= 0.0).all();
      if ((is_near && is_close_look()) || at_edge(way)) {
        found_.converged = true;
        finish(bottom);
        return found_;
      }
      for (int k = 0; k < n_; ++k) {
        const double curvature = hessian_(k, k);
        step_(k) =
            curvature > 0.0 ? std::clamp(std::sqrt(2.0 / curvature), kSearchMinStep, kMaxStep) : kMaxStep;
      }
      if (!go_to(bottom)) break;
    }
    if (hessian_.size() == 0) {
      hessian_ = Eigen::MatrixXd::Zero(n_, n_);
      gradient_ = Eigen::VectorXd::Zero(n_);
    }
    finish(centre_);
    return found_;
  }

 private:
  static std::vector<double> plain(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

  /// The trial at a place, made if there is none yet; null when it came to nothing.
  const DevianceTrial* at(const Eigen::VectorXd& place) {
    const auto distance = [&](const DevianceTrial& trial) {
      return (Eigen::Map<const Eigen::VectorXd>(trial.at.data(), n_) - place).norm();
    };
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < found_.trials.size(); ++i)
      if (distance(found_.trials[i]) < distance(found_.trials[nearest])) nearest = i;
    if (!found_.trials.empty() && distance(found_.trials[nearest]) < 1e-12) return &found_.trials[nearest];
    DevianceTrial trial = evaluate_(plain(place), found_.trials.empty() ? nullptr : &found_.trials[nearest]);
    if (!std::isfinite(trial.value)) return nullptr;
    trial.at = plain(place);
    found_.trials.push_back(std::move(trial));
    return &found_.trials.back();
  }

  /// Gradient, curvature and the solutions' slopes at the centre, by differences.
  bool look_around() {
    const DevianceTrial* here = at(centre_);
    if (here == nullptr) return false;
    found_.centre = *here;
    const double correlated = here->correlated, value = here->value;
    Eigen::VectorXd gradient(n_), up(n_);
    Eigen::MatrixXd hessian(n_, n_);
    std::vector<std::vector<double>> slopes;
    for (int k = 0; k < n_; ++k) {
      const Eigen::VectorXd aside = step_(k) * Eigen::VectorXd::Unit(n_, k);
      const DevianceTrial* more = at(centre_ + aside);
      if (more == nullptr) return false;
      const DevianceTrial above = *more;
      const DevianceTrial* below = at(centre_ - aside);
      if (below == nullptr) return false;
      up(k) = above.value;
      gradient(k) = (above.value - below->value) / (2.0 * step_(k) * correlated);
      hessian(k, k) = (above.value + below->value - 2.0 * value) / (step_(k) * step_(k) * correlated);
      std::vector<double> slope;
      for (std::size_t j = 0; j < above.solution.size(); ++j)
        slope.push_back((above.solution[j] - below->solution[j]) / (2.0 * step_(k)));
      slopes.push_back(slope);
    }
    for (int k = 0; k < n_; ++k)
      for (int l = 0; l < k; ++l) {
        const DevianceTrial* corner =
            at(centre_ + step_(k) * Eigen::VectorXd::Unit(n_, k) + step_(l) * Eigen::VectorXd::Unit(n_, l));
        if (corner == nullptr) return false;
        // For a parabola: f(k, l) - f(k) - f(l) + f = H_kl s_k s_l.
        hessian(k, l) = hessian(l, k) =
            (corner->value - up(k) - up(l) + value) / (step_(k) * step_(l) * correlated);
      }
    gradient_ = gradient, hessian_ = hessian;
    found_.slopes = slopes;
    return true;
  }

  /// Makes a lower place on the way to a parabola's bottom the centre, the lowest one so far. A parabola may
  /// lead astray: then half of the way, and so on.
  bool go_to(const Eigen::VectorXd& bottom) {
    Eigen::VectorXd place = bottom;
    for (int halving = 0; halving <= kSearchMaxHalvings; ++halving) {
      const DevianceTrial* trial = at(place);
      if (trial == nullptr) return false;
      if (trial->value < found_.centre.value) break;
      place = 0.5 * (place + centre_);
    }
    const auto lowest =
        std::min_element(found_.trials.begin(), found_.trials.end(),
                         [](const DevianceTrial& a, const DevianceTrial& b) { return a.value < b.value; });
    const Eigen::VectorXd next = Eigen::Map<const Eigen::VectorXd>(lowest->at.data(), n_);
    if ((next - centre_).norm() < 1e-12) step_ = (0.5 * step_).cwiseMax(kSearchMinStep);
    centre_ = next;
    return true;
  }

  /// Returns the step to the parabola's minimum; along directions without curvature it goes downhill to the
  /// limit.
  Eigen::VectorXd bottom_of_parabola() const {
    const SymmetricEigen eigen = symmetric_eigen(hessian_);
    Eigen::VectorXd way = Eigen::VectorXd::Zero(n_);
    for (int i = 0; i < n_; ++i) {
      const double slope = eigen.vectors.col(i).dot(gradient_), curvature = eigen.values(i);
      double along = slope > 0.0 ? -kMaxWay : kMaxWay;
      if (curvature > 0.0) along = std::clamp(-slope / curvature, -kMaxWay, kMaxWay);
      way += along * eigen.vectors.col(i);
    }
    return (centre_ + way).cwiseMax(-limit_).cwiseMin(limit_);
  }

  /// The places were not much more than a standard deviation apart, or what is flat is known to be.
  bool is_close_look() const {
    for (int k = 0; k < n_; ++k)
      if (hessian_(k, k) > 0.0 &&
          step_(k) > std::max(kSearchMinStep, kWideLook * std::sqrt(2.0 / hessian_(k, k))))
        return false;
    return true;
  }

  /// The centre is as near a limit as it can be, and the way leads there.
  bool at_edge(const Eigen::VectorXd& way) const {
    bool any = false;
    for (int k = 0; k < n_; ++k) {
      const double left = way(k) > 0.0 ? limit_ - centre_(k) : limit_ + centre_(k);
      const bool at_this = left <= 1.001 * step_(k) && way(k) != 0.0;
      any = any || (at_this && std::abs(way(k)) > kSearchCloseEnough * step_(k));
      if (!at_this && std::abs(way(k)) > kSearchCloseEnough * step_(k)) return false;
    }
    return any;
  }

  void finish(const Eigen::VectorXd& place) {
    found_.at = plain(place);
    const double of_limits = 4.0 * limit_ * limit_ / 12.0;
    const SymmetricEigen eigen = symmetric_eigen(hessian_);
    // Half the curvature of -2 ln likelihood is the information.
    Eigen::VectorXd information = 0.5 * eigen.values.cwiseMax(0.0);
    information.array() += 1.0 / of_limits;
    const Eigen::MatrixXd covariance =
        eigen.vectors * information.cwiseInverse().asDiagonal() * eigen.vectors.transpose();
    found_.covariance.assign(n_, std::vector<double>(n_));
    for (int k = 0; k < n_; ++k) {
      for (int l = 0; l < n_; ++l) found_.covariance[k][l] = covariance(k, l);
      found_.undetermined.push_back(covariance(k, k) > kLeftOpen * of_limits);
      found_.at_limit.push_back(std::abs(place(k)) > limit_ * (1.0 - 1e-3));
    }
  }

  const int n_;
  const double limit_;
  const EvaluateDeviance& evaluate_;
  Eigen::VectorXd centre_, step_, gradient_;
  Eigen::MatrixXd hessian_;
  DevianceMinimum found_;
};

}  // namespace

DevianceMinimum deviance_minimum(const std::vector<double>& start, double limit,
                                 const EvaluateDeviance& evaluate) {
  return Minimum(start, limit, evaluate).run();
}

}  // namespace vegard::sim
