#include "fit/columns/column_chi2.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace vegard::fit {
namespace {

constexpr double kFluxScanStep = 0.25;  // of ln(Q), between which the light per flux is taken to be linear
constexpr int kFluxRounds = 3;          // the light per flux changes by a few per cent per factor of flux
constexpr int kMaxDescentSteps = 100;
constexpr double kSettledStep = 1e-9, kSettledFall = 1e-11;
constexpr double kFirstDamping = 1e-4, kMaxDamping = 1e10;
constexpr ColumnPoint kLongestStep = {0.7, 2.0, 0.5};
constexpr double kSameValley = 0.02;     // of ln(energy) and ln(oxygen)
constexpr double kAtColumnLimit = 1e-9;  // of an unknown, where it counts as being at its limit

struct ColumnGradient {
  double chi2 = 0.0;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();  ///< half of chi2's
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
};

constexpr auto kMostLines = static_cast<int>(kMaxColumnLines);
using LineMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostLines, kMostLines>;
using LineVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostLines, 1>;
using ModeMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostLines, sim::kMaxLightModes>;
using ModeVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, sim::kMaxLightModes, 1>;
using LineSlopes = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, kMostLines, 3>;

/// The brightnesses at a point with the modes at the coefficients that make chi2 least.
class BestModes {
 public:
  BestModes(const ColumnModel& model, const ColumnData& data, const ColumnPoint& point)
      : lines_(static_cast<int>(model.lines())),
        changes_(lines_, model.modes()),
        changes_by_energy_(lines_, model.modes()),
        slopes_(lines_, 3),
        usual_(lines_),
        wanted_(lines_),
        variance_(lines_) {
    for (int l = 0; l < lines_; ++l) {
      const auto line = static_cast<std::size_t>(l);
      const ColumnLight light = model.at(line, point);
      const ColumnModes modes = model.modes_at(line, point);
      usual_(l) = std::exp(light.ln_rayleigh);
      slopes_.row(l) << light.slope[0], light.slope[1], light.slope[2];
      for (int k = 0; k < model.modes(); ++k) {
        changes_(l, k) = modes.value[static_cast<std::size_t>(k)];
        changes_by_energy_(l, k) = modes.slope[static_cast<std::size_t>(k)];
      }
      wanted_(l) = data.rayleigh[line];
      variance_(l) = data.sigma[line] * data.sigma[line];
    }
    solve();
  }

  ColumnGradient gradient() const {
    ColumnGradient g;
    const LineVector residual = rayleigh_ - wanted_;
    const LineSlopes slopes = slopes_of_rayleigh();
    // Where the coefficients are best, chi2 does not change with them.
    g.chi2 = residual.cwiseAbs2().cwiseQuotient(variance_).sum() + coefficients_.squaredNorm();
    g.slope = slopes.transpose() * residual.cwiseQuotient(variance_);
    g.information = slopes.transpose() * covariance().ldlt().solve(slopes);
    return g;
  }

  std::vector<LineCorrection> corrections(const ColumnFreedom& is_free) const {
    const LineVector logs = changes_ * coefficients_;
    const ModeMatrix response = rayleigh_.asDiagonal() * changes_;
    const LineVector weight = variance_.cwiseInverse();
    Eigen::MatrixXd information = response.transpose() * weight.asDiagonal() * response;
    information.diagonal().array() += 1.0;
    LineSlopes slopes = slopes_of_rayleigh();
    Eigen::Matrix3d of_unknowns = slopes.transpose() * weight.asDiagonal() * slopes;
    for (int i = 0; i < 3; ++i) {
      if (is_free[static_cast<std::size_t>(i)]) continue;
      of_unknowns.row(i).setZero();
      of_unknowns.col(i).setZero();
      of_unknowns(i, i) = 1.0;
      slopes.col(i).setZero();
    }
    const Eigen::MatrixXd both = response.transpose() * weight.asDiagonal() * slopes;
    information -= both * of_unknowns.ldlt().solve(both.transpose());
    const Eigen::MatrixXd left = changes_ * information.ldlt().solve(Eigen::MatrixXd(changes_.transpose()));
    std::vector<LineCorrection> result;
    for (int l = 0; l < lines_; ++l)
      result.push_back({std::exp(logs(l)), changes_.row(l).norm(), std::sqrt(std::max(0.0, left(l, l)))});
    return result;
  }

 private:
  static constexpr int kMostRounds = 12;
  static constexpr double kSettled = 1e-9, kMostOfLogarithm = 2.0;

  /// Gauss-Newton steps: with the light linear in the coefficients each would be the last.
  void solve() {
    coefficients_ = ModeVector::Zero(changes_.cols());
    for (int round = 0; round < kMostRounds; ++round) {
      take();
      const LineVector towards = wanted_ - rayleigh_ + rayleigh_.cwiseProduct(changes_ * coefficients_);
      const ModeVector next =
          changes_.transpose() * rayleigh_.cwiseProduct(LineVector(covariance().ldlt().solve(towards)));
      const double moved = (next - coefficients_).cwiseAbs().maxCoeff();
      coefficients_ = next;
      const double most = (changes_ * coefficients_).cwiseAbs().maxCoeff();
      if (most > kMostOfLogarithm) coefficients_ *= kMostOfLogarithm / most;
      if (moved < kSettled) break;
    }
    take();
  }

  void take() { rayleigh_ = usual_.cwiseProduct((changes_ * coefficients_).array().exp().matrix()); }

  LineMatrix covariance() const {
    const ModeMatrix response = rayleigh_.asDiagonal() * changes_;
    LineMatrix matrix = response * response.transpose();
    matrix.diagonal() += variance_;
    return matrix;
  }

  LineSlopes slopes_of_rayleigh() const {
    LineSlopes slopes = slopes_;
    slopes.col(kLnEnergy) += changes_by_energy_ * coefficients_;
    return rayleigh_.asDiagonal() * slopes;
  }

  int lines_;
  ModeMatrix changes_, changes_by_energy_;
  LineSlopes slopes_;
  LineVector usual_, wanted_, variance_, rayleigh_;
  ModeVector coefficients_;
};

ColumnGradient column_gradient(const ColumnModel& model, const ColumnData& data, const ColumnPoint& point) {
  if (model.modes() > 0) return BestModes(model, data, point).gradient();
  ColumnGradient g;
  for (std::size_t l = 0; l < model.lines(); ++l) {
    const ColumnLight light = model.at(l, point);
    const double rayleigh = std::exp(light.ln_rayleigh);
    const double residual = (rayleigh - data.rayleigh[l]) / data.sigma[l];
    const Eigen::Vector3d row =
        rayleigh / data.sigma[l] * Eigen::Vector3d(light.slope[0], light.slope[1], light.slope[2]);
    g.chi2 += residual * residual;
    g.slope += residual * row;
    g.information += row * row.transpose();
  }
  return g;
}

/// Returns which unknowns cannot move: they are not free, or chi2 falls across their limit.
ColumnFreedom held_unknowns(const ColumnModel& model, const ColumnPoint& point, const ColumnFreedom& free,
                            const Eigen::Vector3d& slope) {
  ColumnFreedom is_held{};
  for (std::size_t k = 0; k < kColumnUnknowns; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    is_held[k] = !free[k] || (point[k] <= model.least(k) + kAtColumnLimit && slope(i) >= 0.0) ||
                 (point[k] >= model.most(k) - kAtColumnLimit && slope(i) <= 0.0);
  }
  return is_held;
}

/// Returns the damped step, which leaves the held unknowns where they are and is shortened as a whole where
/// it is too long.
Eigen::Vector3d damped_step(const ColumnGradient& g, const ColumnFreedom& is_held, double damping) {
  Eigen::Matrix3d matrix = g.information;
  Eigen::Vector3d towards = -g.slope;
  for (Eigen::Index i = 0; i < 3; ++i) {
    matrix(i, i) = matrix(i, i) * (1.0 + damping) + 1e-12;
    if (!is_held[static_cast<std::size_t>(i)]) continue;
    matrix.row(i).setZero();
    matrix.col(i).setZero();
    matrix(i, i) = 1.0;
    towards(i) = 0.0;
  }
  Eigen::Vector3d step = matrix.ldlt().solve(towards);
  double shorter = 1.0;
  for (Eigen::Index i = 0; i < 3; ++i)
    shorter = std::max(shorter, std::abs(step(i)) / kLongestStep[static_cast<std::size_t>(i)]);
  return step / shorter;
}

}  // namespace

ColumnChi2::ColumnChi2(const ColumnModel& model, const ColumnFreedom& free, const ColumnPoint& fixed,
                       std::size_t energy_stride)
    : model_(model), free_(free), fixed_(fixed) {
  for (double ln_flux = model.least(kLnFlux); ln_flux < model.most(kLnFlux) + kFluxScanStep;
       ln_flux += kFluxScanStep)
    ln_fluxes_.push_back(std::min(ln_flux, model.most(kLnFlux)));
  if (free[kLnEnergy]) {
    const std::vector<double>& all = model.ln_energies();
    for (std::size_t e = 0; e + 1 < all.size(); e += energy_stride) ln_energies_.push_back(all[e]);
    ln_energies_.push_back(all.back());
  } else {
    ln_energies_ = {fixed[kLnEnergy]};
  }
  const std::vector<double> ln_oxygens =
      free[kLnOxygen] ? model.ln_oxygens() : std::vector<double>{fixed[kLnOxygen]};
  for (std::size_t e = 0; e < ln_energies_.size(); ++e)
    for (const double ln_oxygen : ln_oxygens) {
      ScanPlace place;
      place.at = {ln_energies_[e], fixed[kLnFlux], ln_oxygen};
      place.energy = e;
      for (std::size_t l = 0; l < model.lines(); ++l)
        for (const double ln_flux : ln_fluxes_)
          place.rayleigh_per_flux.push_back(
              std::exp(model.at(l, {ln_energies_[e], ln_flux, ln_oxygen}).ln_rayleigh - ln_flux));
      if (model.modes() > 0) {
        std::vector<ColumnModes> modes;
        for (std::size_t l = 0; l < model.lines(); ++l) modes.push_back(model.modes_at(l, place.at));
        for (const ColumnModes& one : modes)
          for (const ColumnModes& other : modes)
            place.ln_covariance.push_back(
                std::inner_product(one.value.begin(), one.value.end(), other.value.begin(), 0.0));
      }
      places_.push_back(std::move(place));
    }
}

double ColumnChi2::at(const ColumnData& data, const ColumnPoint& point) const {
  return column_gradient(model_, data, point).chi2;
}

std::vector<LineCorrection> ColumnChi2::corrections(const ColumnData& data,
                                                    const ColumnValley& valley) const {
  if (model_.modes() == 0) return {};
  ColumnFreedom is_free = free_;
  for (std::size_t k = 0; k < kColumnUnknowns; ++k) is_free[k] = free_[k] && !valley.at_edge[k];
  return BestModes(model_, data, valley.at).corrections(is_free);
}

double ColumnChi2::best_flux(const ColumnData& data, const ScanPlace& place, double& ln_flux) const {
  std::array<double, kMaxColumnLines> per_flux{};
  const auto take = [&](double at) {
    const double along = (at - ln_fluxes_.front()) / kFluxScanStep;
    const auto piece =
        static_cast<std::size_t>(std::clamp(along, 0.0, static_cast<double>(ln_fluxes_.size() - 2)));
    const double t = std::clamp(along - static_cast<double>(piece), 0.0, 1.0);
    for (std::size_t l = 0; l < model_.lines(); ++l) {
      const double* row = place.rayleigh_per_flux.data() + l * ln_fluxes_.size() + piece;
      per_flux[l] = row[0] + t * (row[1] - row[0]);
    }
  };
  ln_flux = free_[kLnFlux] ? 0.0 : fixed_[kLnFlux];
  take(ln_flux);
  const auto lines = static_cast<Eigen::Index>(model_.lines());
  // The inverse of the covariance of the lines, with the modes linear about the tables' light.
  LineMatrix weight = LineMatrix::Zero(lines, lines);
  const auto weigh = [&] {
    for (Eigen::Index l = 0; l < lines; ++l) {
      const double sigma = data.sigma[static_cast<std::size_t>(l)];
      weight(l, l) = 1.0 / (sigma * sigma);
    }
    if (place.ln_covariance.empty()) return;
    const Eigen::Map<const LineVector> light(per_flux.data(), lines);
    const Eigen::Map<const LineMatrix> ln_covariance(place.ln_covariance.data(), lines, lines);
    LineMatrix covariance =
        std::exp(2.0 * ln_flux) * (light.asDiagonal() * ln_covariance * light.asDiagonal());
    for (Eigen::Index l = 0; l < lines; ++l) covariance(l, l) += 1.0 / weight(l, l);
    weight = covariance.inverse();
  };
  const Eigen::Map<const LineVector> wanted(data.rayleigh.data(), lines), of_flux(per_flux.data(), lines);
  for (int round = 0; free_[kLnFlux] && round < kFluxRounds; ++round) {
    weigh();
    const LineVector weighted = weight * of_flux;
    const double above = weighted.dot(wanted), below = weighted.dot(of_flux);
    const double flux = above > 0.0 ? std::clamp(above / below, ColumnModel::kMinFlux, ColumnModel::kMaxFlux)
                                    : ColumnModel::kMinFlux;
    const double before = ln_flux;
    ln_flux = std::log(flux);
    take(ln_flux);
    if (std::abs(ln_flux - before) < 1e-4) break;
  }
  weigh();
  const LineVector residual = std::exp(ln_flux) * of_flux - wanted;
  return residual.dot(weight * residual);
}

ColumnValley ColumnChi2::descend(const ColumnData& data, ColumnPoint start, const ColumnFreedom& free) const {
  ColumnGradient g = column_gradient(model_, data, start);
  double damping = 0.0;
  for (int i = 0; i < kMaxDescentSteps && damping < kMaxDamping; ++i) {
    const ColumnFreedom is_held = held_unknowns(model_, start, free, g.slope);
    const Eigen::Vector3d step = damped_step(g, is_held, damping);
    ColumnPoint next = start;
    double moved = 0.0;
    for (std::size_t k = 0; k < kColumnUnknowns; ++k) {
      if (is_held[k]) continue;
      next[k] = std::clamp(start[k] + step(static_cast<Eigen::Index>(k)), model_.least(k), model_.most(k));
      moved = std::max(moved, std::abs(next[k] - start[k]));
    }
    if (moved < kSettledStep) break;
    const ColumnGradient there = column_gradient(model_, data, next);
    if (!(there.chi2 <= g.chi2)) {
      damping = std::max(kFirstDamping, 10.0 * damping);
      continue;
    }
    const double fall = g.chi2 - there.chi2;
    start = next;
    g = there;
    damping = damping <= kFirstDamping ? 0.0 : 0.1 * damping;
    if (fall < kSettledFall * (1.0 + g.chi2)) break;
  }
  ColumnValley valley{start, g.chi2, g.information, held_unknowns(model_, start, free, g.slope), 0.0};
  for (std::size_t k = 0; k < kColumnUnknowns; ++k)
    valley.at_edge[k] = valley.at_edge[k] && free[k] && model_.knows(k);
  return valley;
}

std::vector<ColumnValley> ColumnChi2::valleys(const ColumnData& data) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<double> least(ln_energies_.size(), kFar);
  std::vector<ColumnPoint> where(ln_energies_.size());
  for (const ScanPlace& place : places_) where[place.energy] = place.at;  // where chi2 is no number
  for (const ScanPlace& place : places_) {
    double ln_flux = 0.0;
    const double chi2 = best_flux(data, place, ln_flux);
    if (!(chi2 < least[place.energy])) continue;
    least[place.energy] = chi2;
    where[place.energy] = {place.at[kLnEnergy], ln_flux, place.at[kLnOxygen]};
  }
  std::vector<ColumnValley> found;
  for (std::size_t e = 0; e < least.size(); ++e) {
    const bool falls = e == 0 || least[e] < least[e - 1];
    const bool rises = e + 1 == least.size() || least[e] <= least[e + 1];
    if (!falls || !rises) continue;
    const ColumnValley valley = descend(data, where[e], free_);
    const auto same = std::find_if(found.begin(), found.end(), [&](const ColumnValley& other) {
      return std::abs(other.at[kLnEnergy] - valley.at[kLnEnergy]) < kSameValley &&
             std::abs(other.at[kLnOxygen] - valley.at[kLnOxygen]) < kSameValley;
    });
    if (same == found.end())
      found.push_back(valley);
    else if (valley.chi2 < same->chi2)
      *same = valley;
  }
  if (found.empty()) found.push_back(descend(data, where[0], free_));  // chi2 is nowhere a number
  std::stable_sort(found.begin(), found.end(),
                   [](const ColumnValley& a, const ColumnValley& b) { return a.chi2 < b.chi2; });
  for (std::size_t v = 1; v < found.size(); ++v) {
    const double low = std::min(found[v].at[kLnEnergy], found[0].at[kLnEnergy]);
    const double high = std::max(found[v].at[kLnEnergy], found[0].at[kLnEnergy]);
    double pass = found[v].chi2;
    for (std::size_t e = 0; e < least.size(); ++e)
      if (ln_energies_[e] > low && ln_energies_[e] < high) pass = std::max(pass, least[e]);
    found[v].barrier = pass - found[v].chi2;
  }
  return found;
}

Eigen::Matrix3d column_covariance(const ColumnValley& valley, const ColumnFreedom& free) {
  Eigen::Matrix3d matrix = valley.information;
  std::array<bool, kColumnUnknowns> counts{};
  for (std::size_t k = 0; k < kColumnUnknowns; ++k) {
    counts[k] = free[k] && !valley.at_edge[k];
    if (counts[k]) continue;
    const auto i = static_cast<Eigen::Index>(k);
    matrix.row(i).setZero();
    matrix.col(i).setZero();
    matrix(i, i) = 1.0;
  }
  Eigen::Matrix3d covariance = matrix.inverse();
  for (std::size_t k = 0; k < kColumnUnknowns; ++k)
    if (!counts[k]) covariance(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)) = 0.0;
  return covariance;
}

}  // namespace vegard::fit
