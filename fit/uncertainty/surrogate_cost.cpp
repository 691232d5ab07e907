#include "fit/uncertainty/surrogate_cost.h"

#include <Eigen/Core>
#include <optional>

#include "sim/base/number/chain/student_proposal.h"
#include "sim/base/number/dense_solvers.h"

namespace vegard::fit {
namespace {

constexpr int kHalvings = 4;  // of a step on which there are no residuals

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

SurrogateCost::SurrogateCost(const Residuals& residuals, const std::vector<double>& answer,
                             const std::vector<std::vector<double>>& covariance,
                             const std::atomic<bool>* stop)
    : answer_(Eigen::Map<const Eigen::VectorXd>(answer.data(), static_cast<Eigen::Index>(answer.size()))) {
  const Eigen::MatrixXd root = sim::root_of_covariance(covariance);
  inverse_root_ = sim::inverse_of(root);
  const int n = static_cast<int>(answer.size());
  const auto stopped = [&] { return stop != nullptr && stop->load(); };

  std::vector<double> r, j;
  // d residual / d y at answer + by L e_k.
  const auto slopes = [&](int k, double by) -> std::optional<Eigen::MatrixXd> {
    const Eigen::VectorXd at = answer_ + by * root.col(k);
    if (stopped() || !residuals({at.data(), at.data() + n}, r, j)) return {};
    return Eigen::Map<const RowMajorMatrix>(j.data(), static_cast<Eigen::Index>(r.size()), n) * root;
  };
  const std::optional<Eigen::MatrixXd> here = slopes(0, 0.0);
  if (!here) return;
  const Eigen::VectorXd at_answer = Eigen::Map<const Eigen::VectorXd>(r.data(), here->rows());

  std::vector<Eigen::VectorXd> columns;
  const auto add = [&](const Monomial& monomial, const Eigen::VectorXd& column) {
    monomials_.push_back(monomial);
    columns.push_back(column);
  };
  for (int k = 0; k < n; ++k) add({k, -1, -1}, here->col(k));
  // pair_slopes[k].col(l): d²r / dy_k dy_l as the Jacobians along k have it; the mean with that along l is
  // taken.
  std::vector<Eigen::MatrixXd> pair_slopes(static_cast<std::size_t>(n),
                                           Eigen::MatrixXd::Zero(here->rows(), n));
  const bool with_pairs = n <= kMaxForPairs;
  for (int k = 0; k < n && !stopped(); ++k) {
    double step = kStep;
    for (int halving = 0; halving < kHalvings; ++halving, step *= 0.5) {
      const std::optional<Eigen::MatrixXd> before = slopes(k, -step), after = slopes(k, step);
      if (!before || !after) continue;
      pair_slopes[k] = (*after - *before) / (2.0 * step);
      const Eigen::MatrixXd third = (*after - 2.0 * *here + *before) / (step * step);
      for (int l = 0; l < n; ++l)
        if (l == k)
          add({k, k, k}, third.col(k) / 6.0);
        else if (with_pairs)
          add({k, k, l}, kMixedShare / 2.0 * third.col(l));
      break;
    }
  }
  for (int k = 0; k < n; ++k) {
    add({k, k, -1}, 0.5 * pair_slopes[k].col(k));
    for (int l = 0; with_pairs && l < k; ++l)
      add({k, l, -1}, 0.5 * (pair_slopes[k].col(l) + pair_slopes[l].col(k)));
  }

  // |r|² - |r0|², of which r0's own square would only take digits away.
  const auto count = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd all(here->rows(), count + 1);
  all.col(0) = at_answer;
  for (Eigen::Index c = 0; c < count; ++c) all.col(c + 1) = columns[c];
  gram_.noalias() = all.transpose() * all;
  gram_(0, 0) = 0.0;
}

Eigen::VectorXd SurrogateCost::whitened(const std::vector<double>& at) const {
  return inverse_root_ * (Eigen::Map<const Eigen::VectorXd>(at.data(), answer_.size()) - answer_);
}

double SurrogateCost::rise(const std::vector<double>& at) const {
  if (gram_.size() == 0) return 0.0;
  const Eigen::VectorXd y = whitened(at);
  terms_.resize(gram_.rows());
  terms_(0) = 1.0;
  Eigen::Index row = 0;
  for (const Monomial& m : monomials_)
    terms_(++row) = y(m.k) * (m.l < 0 ? 1.0 : y(m.l)) * (m.m < 0 ? 1.0 : y(m.m));
  return terms_.dot(gram_ * terms_);
}

double SurrogateCost::square(const std::vector<double>& at) const { return whitened(at).squaredNorm(); }

}  // namespace vegard::fit
