#include "fit/compare/linear_part.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/view/sky/night_sky.h"

namespace vegard::fit {
namespace {

/// Of the night sky's known lights.
double offset_at(const ModelProfile& aurora, std::size_t i) {
  return aurora.offset.empty() ? 0.0 : aurora.offset[i];
}
double offset_slope(const ModelProfile& aurora, std::size_t i, int parameter) {
  return aurora.offset_derivative.empty() ? 0.0 : aurora.offset_derivative[i * aurora.free + parameter];
}

}  // namespace

/// The normal equations, factorised, with held coefficients taken out.
struct LinearPart::Normal {
  Eigen::LDLT<Eigen::MatrixXd> factors;
};

LinearPart::LinearPart(LinearBins bins, const GainLayout& gains, int sky_terms)
    : bins_(std::move(bins)), gains_(gains), sky_terms_(sky_terms) {
  for (std::size_t i = 0; i < bins_.sigma.size(); ++i) {
    if (bins_.sigma[i] <= 0.0) continue;
    const int c = static_cast<int>(i % 3);
    used_.push_back(i);
    where_.push_back({gains_.column(bins_.band[i / 3], c), sky(0, c, sky_of(i / 3)), sky_basis(i / 3)});
  }
}

LinearPart::LinearPart(const Profile& data, const std::vector<double>& sigma, const GainLayout& gains,
                       int sky_terms, int picture_height)
    : LinearPart(
          [&] {
            LinearBins bins;
            bins.append(data, sigma, picture_height);
            return bins;
          }(),
          gains, sky_terms) {}

std::vector<bool> LinearPart::seen() const {
  std::vector<bool> seen(coefficients(), false);
  for (const Where& w : where_) {
    seen[w.gain] = true;
    for (int t = 0; t < sky_terms_; ++t) seen[w.level + 3 * t] = true;
  }
  return seen;
}

int LinearPart::coefficients_in_use() const {
  // Gains without light are counted as held, where they are.
  const std::vector<bool> some = seen();
  return gains_.count() + static_cast<int>(std::count(some.begin() + gains_.count(), some.end(), true));
}

std::array<double, 3> LinearPart::sky_basis(std::size_t bin) const {
  return sim::sky_basis(bins_.place[bin]);
}

LinearPart::Normal LinearPart::normal_matrix(const ModelProfile& aurora,
                                             const std::vector<bool>& held) const {
  const int n = coefficients(), first_sky = gains_.count();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t k = 0; k < used_.size(); ++k) {
    const std::size_t i = used_[k];
    const Where& w = where_[k];
    const double weight = 1.0 / (bins_.sigma[i] * bins_.sigma[i]), light = aurora.value[i];
    normal(w.gain, w.gain) += weight * light * light;
    for (int t = 0; t < sky_terms_; ++t) {
      normal(w.level + 3 * t, w.gain) += weight * light * w.sky[t];
      for (int u = 0; u <= t; ++u) normal(w.level + 3 * t, w.level + 3 * u) += weight * w.sky[t] * w.sky[u];
    }
  }
  normal = normal.selfadjointView<Eigen::Lower>();
  for (int j = 0; j < n; ++j) {
    if (j < first_sky && held[j]) {
      normal.row(j).setZero();
      normal.col(j).setZero();
      normal(j, j) = 1.0;
    } else if (normal(j, j) <= 0.0) {
      normal(j, j) = 1.0;  // no data in this channel: the coefficient stays 0
    }
  }
  return {Eigen::LDLT<Eigen::MatrixXd>(normal)};
}

LinearSolution LinearPart::solve(const ModelProfile& aurora) const {
  const int n = coefficients(), first_sky = gains_.count();
  LinearSolution solution;
  solution.held.assign(first_sky, false);
  // A band with next to no light cannot have its brightness asked for.
  std::vector<double> light2(first_sky, 0.0);
  double brightest = 0.0;
  for (std::size_t k = 0; k < used_.size(); ++k) {
    const double light = aurora.value[used_[k]];
    light2[where_[k].gain] += light * light;
  }
  for (double x : light2) brightest = std::max(brightest, x);
  for (int g = 0; g < first_sky; ++g) solution.held[g] = !(light2[g] > 1e-10 * brightest);

  Eigen::VectorXd right(n);
  for (int round = 0; round <= first_sky; ++round) {
    right.setZero();
    for (std::size_t k = 0; k < used_.size(); ++k) {
      const std::size_t i = used_[k];
      const Where& w = where_[k];
      const double weighted = (bins_.mean[i] - offset_at(aurora, i)) / (bins_.sigma[i] * bins_.sigma[i]);
      if (!solution.held[w.gain]) right(w.gain) += weighted * aurora.value[i];
      for (int t = 0; t < sky_terms_; ++t) right(w.level + 3 * t) += weighted * w.sky[t];
    }
    const Eigen::VectorXd c = normal_matrix(aurora, solution.held).factors.solve(right);
    solution.coefficients.assign(c.data(), c.data() + n);
    int negative = 0;
    for (int g = 0; g < first_sky; ++g) {
      if (!solution.held[g] && c(g) < 0.0) {
        solution.held[g] = true;
        ++negative;
      }
    }
    if (negative == 0) break;
  }
  for (int g = 0; g < first_sky; ++g)
    if (solution.held[g]) solution.coefficients[g] = 0.0;

  solution.residual.resize(used_.size());
  const std::vector<double> all = model(aurora, solution);
  for (std::size_t k = 0; k < used_.size(); ++k) {
    const std::size_t i = used_[k];
    solution.residual[k] = (bins_.mean[i] - all[i]) / bins_.sigma[i];
    solution.chi2 += solution.residual[k] * solution.residual[k];
  }
  return solution;
}

/// d coefficient / d parameter.
Eigen::MatrixXd LinearPart::coefficient_slopes(const ModelProfile& aurora, const LinearSolution& solution,
                                               const Normal& normal) const {
  const int n = coefficients(), p = aurora.free;
  // With A(θ) c + o(θ) = model: dc = (AᵀWA)⁻¹ (dAᵀ W r − Aᵀ W (dA c + do)), and the residual falls by
  // dA c + do + A dc.
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, p);
  if (p == 0) return right;  // for which Eigen's solver takes the address of its first number
  for (std::size_t k = 0; k < used_.size(); ++k) {
    const std::size_t i = used_[k];
    const Where& w = where_[k];
    const bool held = solution.held[w.gain];
    const double gain = solution.coefficients[w.gain];
    const double weight = 1.0 / (bins_.sigma[i] * bins_.sigma[i]), light = aurora.value[i];
    const double left_over = solution.residual[k] * bins_.sigma[i];
    const double* grow = aurora.derivative.data() + i * p;
    for (int j = 0; j < p; ++j) {
      const double change = weight * gain * grow[j] + weight * offset_slope(aurora, i, j);
      if (!held) right(w.gain, j) += weight * grow[j] * left_over - light * change;
      for (int t = 0; t < sky_terms_; ++t) right(w.level + 3 * t, j) -= w.sky[t] * change;
    }
  }
  return normal.factors.solve(right);
}

void LinearPart::jacobian(const ModelProfile& aurora, const LinearSolution& solution,
                          std::vector<double>& out) const {
  const int p = aurora.free;
  const Eigen::MatrixXd dc = coefficient_slopes(aurora, solution, normal_matrix(aurora, solution.held));
  out.resize(used_.size() * p);
  for (std::size_t k = 0; k < used_.size(); ++k) {
    const std::size_t i = used_[k];
    const Where& w = where_[k];
    const bool held = solution.held[w.gain];
    const double gain = solution.coefficients[w.gain], light = aurora.value[i];
    const double* grow = aurora.derivative.data() + i * p;
    for (int j = 0; j < p; ++j) {
      double change = offset_slope(aurora, i, j);
      for (int t = 0; t < sky_terms_; ++t) change += dc(w.level + 3 * t, j) * w.sky[t];
      if (!held) change += gain * grow[j] + light * dc(w.gain, j);
      out[k * p + j] = -change / bins_.sigma[i];
    }
  }
}

std::vector<double> LinearPart::model(const ModelProfile& aurora, const LinearSolution& solution) const {
  std::vector<double> all(aurora.value.size());
  for (std::size_t bin = 0; bin < bins_.band.size(); ++bin) {
    const std::array<double, 3> basis = sky_basis(bin);
    const int which = sky_of(bin);
    for (int c = 0; c < 3; ++c) {
      const std::size_t i = bin * 3 + c;
      all[i] =
          offset_at(aurora, i) + solution.coefficients[gains_.column(bins_.band[bin], c)] * aurora.value[i];
      for (int t = 0; t < sky_terms_; ++t) all[i] += solution.coefficients[sky(t, c, which)] * basis[t];
    }
  }
  return all;
}

SolvedLight LinearPart::light(const ModelProfile& aurora, const LinearSolution& solution,
                              std::size_t values) const {
  const int p = aurora.derivative.empty() ? 0 : aurora.free;
  SolvedLight light;
  light.free = p;
  light.aurora.resize(values);
  light.behind.resize(values);
  Eigen::MatrixXd dc;
  if (p > 0) {
    dc = coefficient_slopes(aurora, solution, normal_matrix(aurora, solution.held));
    light.aurora_slope.resize(values * p);
    light.behind_slope.resize(values * p);
  }
  for (std::size_t i = 0; i < values; ++i) {
    const int c = static_cast<int>(i % 3), g = gains_.column(bins_.band[i / 3], c);
    const std::array<double, 3> basis = sky_basis(i / 3);
    const int which = sky_of(i / 3);
    const double gain = solution.coefficients[g];
    light.aurora[i] = gain * aurora.value[i];
    light.behind[i] = offset_at(aurora, i);
    for (int t = 0; t < sky_terms_; ++t)
      light.behind[i] += solution.coefficients[sky(t, c, which)] * basis[t];
    for (int j = 0; j < p; ++j) {
      double grow = gain * aurora.derivative[i * p + j];
      if (!solution.held[g]) grow += aurora.value[i] * dc(g, j);
      light.aurora_slope[i * p + j] = grow;
      double behind = offset_slope(aurora, i, j);
      for (int t = 0; t < sky_terms_; ++t) behind += dc(sky(t, c, which), j) * basis[t];
      light.behind_slope[i * p + j] = behind;
    }
  }
  return light;
}

std::vector<double> LinearPart::coefficient_variance(
    const ModelProfile& aurora, const LinearSolution& solution, double inflation,
    const std::vector<std::vector<double>>& covariance) const {
  const int n = coefficients();
  const Normal normal = normal_matrix(aurora, solution.held);
  const Eigen::MatrixXd own = normal.factors.solve(Eigen::MatrixXd::Identity(n, n));
  const Eigen::MatrixXd slopes = coefficient_slopes(aurora, solution, normal);
  const std::vector<bool> seen = this->seen();
  std::vector<double> variance(n, 0.0);
  for (int j = 0; j < n; ++j) {
    if (!seen[j] || (j < gains_.count() && solution.held[j])) continue;
    variance[j] = inflation * inflation * own(j, j);
    for (std::size_t a = 0; a < covariance.size(); ++a)
      for (std::size_t b = 0; b < covariance.size(); ++b)
        variance[j] += slopes(j, static_cast<int>(a)) * covariance[a][b] * slopes(j, static_cast<int>(b));
  }
  return variance;
}

std::vector<std::vector<double>> LinearPart::coefficient_shifts(
    const ModelProfile& aurora, const LinearSolution& solution,
    const std::vector<std::vector<double>>& shifts) const {
  if (shifts.empty()) return {};
  const Eigen::MatrixXd slopes = coefficient_slopes(aurora, solution, normal_matrix(aurora, solution.held));
  std::vector<std::vector<double>> changes;
  for (const std::vector<double>& shift : shifts) {
    const Eigen::VectorXd change =
        slopes * Eigen::Map<const Eigen::VectorXd>(shift.data(), static_cast<Eigen::Index>(shift.size()));
    changes.emplace_back(change.data(), change.data() + change.size());
  }
  return changes;
}

void LinearBins::append(const Profile& data, const std::vector<double>& sigma_of_data, int picture_height) {
  mean.insert(mean.end(), data.mean.begin(), data.mean.end());
  sigma.insert(sigma.end(), sigma_of_data.begin(), sigma_of_data.end());
  for (int b = 0; b < data.bands; ++b)
    for (int r = 0; r < data.rows; ++r) {
      const std::size_t bin = data.index(b, r, 0) / 3;
      const double row = data.grid != nullptr ? data.grid->row[bin] : r;
      band.push_back(data.grid != nullptr ? data.grid->band[bin] : b);
      place.push_back((data.region.y + row + 0.5) / picture_height);
    }
}

void LinearBins::append_with_skies(const Profile& data, const std::vector<double>& sigma_of_data) {
  append(data, sigma_of_data, 1);
  skies = data.bands;
  for (std::size_t bin = 0; bin < place.size(); ++bin)
    place[bin] = (static_cast<double>(bin % data.rows) + 0.5) / data.rows;
}

}  // namespace vegard::fit
