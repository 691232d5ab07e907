#include "fit/uncertainty/uncertainty.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/number/dense_solvers.h"

namespace vegard::fit {
namespace {

constexpr double kUncertaintyRankTolerance = 1e-12;
constexpr double kStandardErrors = 2.0;
constexpr double kLeans = 0.1;  // of the largest part of an undetermined direction: what belongs to it
constexpr double kAsGoodAsNoLimit = 1e5;  // standard deviations

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Standard error of the mean, over the pairs of samplings, of the information along each direction, a column
/// of `directions`; 0 for one sampling.
std::vector<double> standard_errors(const std::vector<std::vector<double>>& jacobians, int residuals,
                                    int coordinates, const Eigen::MatrixXd& directions) {
  constexpr Eigen::Index kAtOnce = 16;  // directions: memory
  std::vector<double> errors;
  for (Eigen::Index first = 0; first < directions.cols(); first += kAtOnce) {
    const Eigen::Index some = std::min(kAtOnce, directions.cols() - first);
    std::vector<Eigen::MatrixXd> along;
    for (const std::vector<double>& jacobian : jacobians)
      along.emplace_back(Eigen::Map<const RowMajor>(jacobian.data(), residuals, coordinates) *
                         directions.middleCols(first, some));
    for (Eigen::Index d = 0; d < some; ++d) {
      double sum = 0.0, square = 0.0;
      int pairs = 0;
      for (std::size_t a = 0; a < along.size(); ++a)
        for (std::size_t b = a + 1; b < along.size(); ++b, ++pairs) {
          const double product = along[a].col(d).dot(along[b].col(d));
          sum += product;
          square += product * product;
        }
      const double variance = pairs < 2 ? 0.0 : std::max(0.0, (square - sum * sum / pairs) / (pairs - 1));
      errors.push_back(pairs < 2 ? 0.0 : std::sqrt(variance / pairs));
    }
  }
  return errors;
}

}  // namespace

PriorKnowledge no_prior_knowledge(std::size_t coordinates) {
  return {std::vector<double>(coordinates * coordinates, 0.0),
          std::vector<double>(coordinates, std::numeric_limits<double>::infinity()),
          std::vector<bool>(coordinates, false)};
}

Uncertainty uncertainty(const std::vector<std::vector<double>>& jacobians, int residuals, int coordinates,
                        const PriorKnowledge& prior, double inflation) {
  const auto samplings = static_cast<double>(jacobians.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(residuals, coordinates);
  Eigen::MatrixXd own = Eigen::MatrixXd::Zero(coordinates, coordinates);
  for (const std::vector<double>& jacobian : jacobians) {
    const Eigen::Map<const RowMajor> j(jacobian.data(), residuals, coordinates);
    sum += j;
    own += j.transpose() * j;
  }
  // (Σ J)ᵀ(Σ J) − Σ JᵀJ holds the products of different samplings only. One sampling alone has to do with its
  // own.
  const Eigen::MatrixXd all = sum.transpose() * sum;
  const double believed = 1.0 / (inflation * inflation);
  const Eigen::MatrixXd data_information =
      believed * (samplings > 1 ? Eigen::MatrixXd((all - own) / (samplings * (samplings - 1.0))) : own);
  const Eigen::MatrixXd prior_information =
      Eigen::Map<const RowMajor>(prior.information.data(), coordinates, coordinates);

  // Scaled to a unit diagonal, so that units do not matter.
  Eigen::VectorXd length = (data_information + prior_information).diagonal().cwiseMax(0.0).cwiseSqrt();
  for (int i = 0; i < coordinates; ++i)
    if (!(length(i) > 0.0)) length(i) = 1.0;
  const Eigen::MatrixXd scale = length.cwiseInverse().asDiagonal();
  const sim::SymmetricEigen eigen = sim::symmetric_eigen(scale * data_information * scale);
  const Eigen::VectorXd& value = eigen.values;
  const Eigen::MatrixXd& v = eigen.vectors;
  const double largest = coordinates > 0 ? value(coordinates - 1) : 0.0;
  const std::vector<double> errors = standard_errors(jacobians, residuals, coordinates, scale * v);
  Eigen::MatrixXd information = scale * prior_information * scale;
  for (int k = 0; k < coordinates; ++k)
    if (value(k) > std::max(kUncertaintyRankTolerance * largest, kStandardErrors * believed * errors[k]))
      information += value(k) * v.col(k) * v.col(k).transpose();
  Eigen::VectorXd limit(coordinates);  // standard deviations, scaled
  for (int i = 0; i < coordinates; ++i) {
    limit(i) = std::min(kAsGoodAsNoLimit, std::sqrt(prior.limit_variance[i]) * length(i));
    information(i, i) += 1.0 / (limit(i) * limit(i));
  }
  const Eigen::MatrixXd covariance =
      sim::solve_symmetric(information, Eigen::MatrixXd(Eigen::MatrixXd::Identity(coordinates, coordinates)));

  Uncertainty result;
  result.inflation = inflation;
  const Eigen::MatrixXd shrink = limit.cwiseInverse().asDiagonal();
  const sim::SymmetricEigen left = sim::symmetric_eigen(shrink * covariance * shrink);
  for (int k = 0; k < coordinates; ++k) {
    if (left.values(k) < kLeftOpen) continue;
    const Eigen::VectorXd leaning = limit.cwiseProduct(left.vectors.col(k));
    Eigen::VectorXd direction = leaning.cwiseQuotient(length);
    const double most = leaning.cwiseAbs().maxCoeff();
    for (int i = 0; i < coordinates; ++i)
      if (std::abs(leaning(i)) < kLeans * most) direction(i) = 0.0;
    direction /= direction.cwiseAbs().maxCoeff();
    result.undetermined.emplace_back(direction.data(), direction.data() + coordinates);
  }
  result.covariance.assign(coordinates, std::vector<double>(coordinates));
  for (int i = 0; i < coordinates; ++i)
    for (int k = 0; k < coordinates; ++k)
      result.covariance[i][k] = covariance(i, k) / (length(i) * length(k));
  result.sigma.resize(coordinates);
  result.correlation.assign(coordinates, std::vector<double>(coordinates, 0.0));
  const auto known = [&](int i) {
    return std::isfinite(covariance(i, i)) &&
           (prior.has_prior[i] || covariance(i, i) < kLeftOpen * limit(i) * limit(i));
  };
  for (int i = 0; i < coordinates; ++i) {
    result.sigma[i] =
        known(i) ? std::sqrt(covariance(i, i)) / length(i) : std::numeric_limits<double>::quiet_NaN();
    for (int k = 0; k < coordinates; ++k) {
      const double both = std::sqrt(covariance(i, i) * covariance(k, k));
      if (known(i) && known(k) && both > 0.0) result.correlation[i][k] = covariance(i, k) / both;
    }
  }
  return result;
}

namespace {

constexpr double kProbe = 3.0;            // standard deviations
constexpr double kMinRise = 0.25;         // of the parabola's
constexpr double kFarthest = 8.0;         // times as far out
constexpr double kOwes = 0.5;             // of a variance
constexpr double kProbed = 0.1;           // of a normalised axis' square
constexpr double kPartOfDirection = 0.5;  // of a standard deviation
// Of the parabola's rise: what a straight probe finds where chi2 is one.
constexpr double kStraightLeast = 0.6, kStraightMost = 1.6;
constexpr int kFollowed = 4;           // steps down to the bottom of a valley
constexpr double kFollowedFall = 0.1;  // of what is left, by a step that is worth another

/// Chi2 about an answer.
class Surroundings {
 public:
  Surroundings(const ChiSquareRise& rise, const Uncertainty& u) : rise_(rise) {
    const auto n = static_cast<Eigen::Index>(u.sigma.size());
    covariance_.resize(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index k = 0; k < n; ++k) covariance_(i, k) = u.covariance[i][k];
  }

  double rise(const Eigen::VectorXd& step) const {
    return rise_.rise({step.data(), step.data() + step.size()});
  }
  bool can_follow() const { return static_cast<bool>(rise_.half_gradient); }

  /// The coordinate that a step changes most, in standard deviations.
  Eigen::Index held(const Eigen::VectorXd& step) const {
    Eigen::Index most = 0;
    for (Eigen::Index i = 0; i < step.size(); ++i)
      if (sigmas(step, i) > sigmas(step, most)) most = i;
    return most;
  }
  /// How much a parabola rises if one coordinate steps so far and the others follow.
  double parabola(const Eigen::VectorXd& step, Eigen::Index held) const {
    return std::pow(sigmas(step, held), 2);
  }

  /// Goes from a step down to the bottom of the valley, with one coordinate held.
  Eigen::VectorXd follow(Eigen::VectorXd step, Eigen::Index held) const {
    if (!(covariance_(held, held) > 0.0)) return step;
    const Eigen::VectorXd column = covariance_.col(held) / std::sqrt(covariance_(held, held));
    const Eigen::MatrixXd others = covariance_ - column * column.transpose();
    double high = rise(step);
    for (int i = 0; i < kFollowed; ++i) {
      const std::vector<double> gradient = rise_.half_gradient({step.data(), step.data() + step.size()});
      if (gradient.empty()) return step;
      const Eigen::VectorXd lower =
          step - others * Eigen::Map<const Eigen::VectorXd>(gradient.data(), step.size());
      const double low = rise(lower);
      if (!(low < high)) return step;
      const bool is_worth = high - low > kFollowedFall * high;
      step = lower;
      high = low;
      if (!is_worth) break;
    }
    return step;
  }

 private:
  double sigmas(const Eigen::VectorXd& step, Eigen::Index i) const {
    return covariance_(i, i) > 0.0 ? std::abs(step(i)) / std::sqrt(covariance_(i, i)) : 0.0;
  }

  const ChiSquareRise& rise_;
  Eigen::MatrixXd covariance_;
};

}  // namespace

void drop_flat_directions(const ChiSquareRise& rise, const std::vector<bool>& bounded, Uncertainty& u) {
  const Surroundings around(rise, u);
  const auto n = static_cast<Eigen::Index>(u.sigma.size());
  Eigen::VectorXd sigma(n);
  for (Eigen::Index i = 0; i < n; ++i) sigma(i) = std::sqrt(std::max(0.0, u.covariance[i][i]));
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k)
      if (sigma(i) > 0.0 && sigma(k) > 0.0) correlation(i, k) = u.covariance[i][k] / (sigma(i) * sigma(k));
  const sim::SymmetricEigen axes = sim::symmetric_eigen(correlation);

  std::vector<double> variance(n);
  for (Eigen::Index i = 0; i < n; ++i) variance[i] = u.covariance[i][i];
  for (Eigen::Index a = 0; a < n; ++a) {
    if (axes.values(a) <= 0.0) continue;
    const Eigen::VectorXd axis = sigma.cwiseProduct(axes.vectors.col(a)) * std::sqrt(axes.values(a));
    double probed = 0.0;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!bounded[i]) probed += axes.vectors(i, a) * axes.vectors(i, a);
    if (probed < kProbed) continue;
    const double rose[] = {around.rise(-kProbe * axis), around.rise(kProbe * axis)};
    // Where chi2 is no parabola along the axis, this may be no valley's bottom.
    const bool is_bent =
        around.can_follow() && axes.values(a) > 1.0 &&
        std::any_of(std::begin(rose), std::end(rose), [](double r) {
          return !(r > kStraightLeast * kProbe * kProbe && r < kStraightMost * kProbe * kProbe);
        });
    const Eigen::Index held = around.held(axis);
    double longer = 1.0;
    Eigen::VectorXd along = axis;
    for (const int side : {0, 1}) {
      Eigen::VectorXd at = (side == 0 ? -kProbe : kProbe) * axis;
      double far = 1.0, high = rose[side], parabola = kProbe * kProbe;
      const auto is_flat = [&] { return std::isfinite(high) && high < kMinRise * parabola; };
      while (far <= kFarthest) {
        if (is_bent && !is_flat()) {
          // A parabola's bottom is lower as well.
          parabola = around.parabola(kProbe * axis, held);
          at = around.follow(at, held);
          high = around.rise(at);
        }
        if (!is_flat()) break;
        far *= 2.0;
        if (far > kFarthest) break;
        at *= 2.0;
        high = around.rise(at);
      }
      if (far <= longer) continue;
      longer = far;
      along = at / (kProbe * std::min(far, kFarthest));
    }
    if (longer == 1.0) continue;
    if (longer <= kFarthest) {
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index k = 0; k < n; ++k)
          u.covariance[i][k] += (longer * longer - 1.0) * along(i) * along(k);
      continue;
    }
    std::vector<double> direction(n, 0.0);
    double largest = 0.0;
    for (Eigen::Index i = 0; i < n; ++i)
      if (sigma(i) > 0.0 && std::abs(along(i)) > kPartOfDirection * sigma(i)) {
        direction[i] = along(i);
        largest = std::max(largest, std::abs(along(i)));
      }
    for (double& part : direction) part /= largest;
    u.undetermined.push_back(direction);
    // The covariance is the sum of its own axes: what is left stays one.
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index k = 0; k < n; ++k) u.covariance[i][k] -= axis(i) * axis(k);
      if (std::max(axis(i) * axis(i), along(i) * along(i)) > kOwes * variance[i])
        u.sigma[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  for (Eigen::Index i = 0; i < n; ++i)
    if (!std::isnan(u.sigma[i])) u.sigma[i] = std::sqrt(std::max(0.0, u.covariance[i][i]));
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k) {
      const bool has_both = u.sigma[i] > 0.0 && u.sigma[k] > 0.0;
      u.correlation[i][k] = i == k && has_both ? 1.0
                            : has_both         ? u.covariance[i][k] / (u.sigma[i] * u.sigma[k])
                                               : 0.0;
    }
}

}  // namespace vegard::fit
