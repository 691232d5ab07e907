#include "fit/columns/column_chi2.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
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

ColumnGradient column_gradient(const ColumnModel& model, const ColumnData& data, const ColumnPoint& point) {
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
      places_.push_back(std::move(place));
    }
}

double ColumnChi2::at(const ColumnData& data, const ColumnPoint& point) const {
  return column_gradient(model_, data, point).chi2;
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
  for (int round = 0; free_[kLnFlux] && round < kFluxRounds; ++round) {
    double above = 0.0, below = 0.0;
    for (std::size_t l = 0; l < model_.lines(); ++l) {
      const double weight = per_flux[l] / (data.sigma[l] * data.sigma[l]);
      above += weight * data.rayleigh[l];
      below += weight * per_flux[l];
    }
    const double flux = above > 0.0 ? std::clamp(above / below, ColumnModel::kMinFlux, ColumnModel::kMaxFlux)
                                    : ColumnModel::kMinFlux;
    const double before = ln_flux;
    ln_flux = std::log(flux);
    take(ln_flux);
    if (std::abs(ln_flux - before) < 1e-4) break;
  }
  const double flux = std::exp(ln_flux);
  double chi2 = 0.0;
  for (std::size_t l = 0; l < model_.lines(); ++l) {
    const double residual = (flux * per_flux[l] - data.rayleigh[l]) / data.sigma[l];
    chi2 += residual * residual;
  }
  return chi2;
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
