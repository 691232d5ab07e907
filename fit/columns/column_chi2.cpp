#include "fit/columns/column_chi2.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "fit/columns/column_linearisation.h"

namespace vegard::fit {
namespace {

constexpr double kFluxScanStep = 0.25;  // of ln(Q), between which the light per flux is taken to be linear
constexpr int kFluxRounds = 3;          // the light per flux changes by a few per cent per factor of flux
constexpr double kSettledFlux = 1e-4;
constexpr int kMaxDescentSteps = 100;
constexpr double kSettledFall = 1e-7;  // 3e-4 of a standard deviation
constexpr double kFirstDamping = 1e-4, kMaxDamping = 1e10;
constexpr double kSettledDamping = 1.0;  // a short step that hardly lowers chi2 is no end
constexpr double kLeastShare = 1e-6;     // of a step
constexpr ColumnPoint kLongestStep = {0.7, 2.0, 0.5, 1.0};
constexpr double kSameValley = 0.02;     // of ln(energy) and ln(oxygen)
constexpr double kFarAbove = 12.0;       // of chi2: three times what makes a minimum a solution
constexpr double kSameSoft = 0.2;        // of ln(ratio), which is known less well
constexpr double kAtColumnLimit = 1e-9;  // of an unknown, where it counts as being at its limit

/// Calls `work` with the number of lines as a constant, for loops that the compiler unrolls: a map has
/// hundreds of them a pixel.
template <class Work>
auto with_lines(std::size_t lines, const Work& work) {
  static_assert(kMaxColumnLines == 8);
  switch (lines) {
    case 1:
      return work(std::integral_constant<std::size_t, 1>());
    case 2:
      return work(std::integral_constant<std::size_t, 2>());
    case 3:
      return work(std::integral_constant<std::size_t, 3>());
    case 4:
      return work(std::integral_constant<std::size_t, 4>());
    case 5:
      return work(std::integral_constant<std::size_t, 5>());
    case 6:
      return work(std::integral_constant<std::size_t, 6>());
    case 7:
      return work(std::integral_constant<std::size_t, 7>());
    default:
      return work(std::integral_constant<std::size_t, 8>());
  }
}

/// Returns which unknowns cannot move: they are not free, or chi2 falls across their limit.
ColumnFreedom held_unknowns(const ColumnModel& model, const ColumnPoint& point, const ColumnFreedom& free,
                            const ColumnVector& slope) {
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
ColumnVector damped_step(const ColumnGradient& g, const ColumnFreedom& is_held, double damping) {
  ColumnMatrix matrix = g.information;
  ColumnVector towards = -g.slope;
  for (Eigen::Index i = 0; i < towards.size(); ++i) {
    matrix(i, i) = matrix(i, i) * (1.0 + damping) + 1e-12;
    if (!is_held[static_cast<std::size_t>(i)]) continue;
    matrix.row(i).setZero();
    matrix.col(i).setZero();
    matrix(i, i) = 1.0;
    towards(i) = 0.0;
  }
  ColumnVector step = matrix.ldlt().solve(towards);
  double shorter = 1.0;
  for (Eigen::Index i = 0; i < step.size(); ++i)
    shorter = std::max(shorter, std::abs(step(i)) / kLongestStep[static_cast<std::size_t>(i)]);
  return step / shorter;
}

/// Gauss-Newton steps of the changes alone, to the least chi2 at a point.
template <std::size_t kLines>
void settle_changes(const ColumnModel& model, const ColumnData& data, const ColumnPoint& point,
                    ColumnLinearisation<kLines>& here) {
  double share = 1.0;
  for (int i = 0; i < kMaxDescentSteps && share > kLeastShare; ++i) {
    here.gradient();
    const ColumnLinearisation<kLines> there(model, data, point,
                                            here.weight_after(ColumnVector::Zero(), share));
    if (!(there.chi2() <= here.chi2())) {
      share *= 0.25;
      continue;
    }
    const double fall = here.chi2() - there.chi2();
    here = there;
    share = std::min(1.0, 2.0 * share);
    if (fall < kSettledFall * (1.0 + here.chi2())) return;
  }
}

/// Damped Gauss-Newton steps from a point, which then is that of the least chi2, and of the changes by the
/// modes, from none. Both move at once; where that does not lower chi2, the changes are settled first, since
/// only at their best chi2's slope by the unknowns is that of the linearisation.
template <std::size_t kLines>
ColumnLinearisation<kLines> descended(const ColumnModel& model, const ColumnData& data, ColumnPoint& point,
                                      const ColumnFreedom& free) {
  ColumnLinearisation<kLines> here(model, data, point, LineVector{});
  ColumnGradient g = here.gradient();
  double damping = 0.0;
  bool is_settled = model.modes() == 0;
  for (int i = 0; i < kMaxDescentSteps && damping < kMaxDamping; ++i) {
    const ColumnFreedom is_held = held_unknowns(model, point, free, g.slope);
    const ColumnVector step = damped_step(g, is_held, damping);
    if (!step.allFinite()) break;
    ColumnPoint next = point;
    ColumnVector moved = ColumnVector::Zero();
    for (std::size_t k = 0; k < kColumnUnknowns; ++k) {
      if (is_held[k]) continue;
      const auto row = static_cast<Eigen::Index>(k);
      next[k] = std::clamp(point[k] + step(row), model.least(k), model.most(k));
      moved(row) = next[k] - point[k];
    }
    ColumnLinearisation<kLines> there(model, data, next, here.weight_after(moved, 1.0 / (1.0 + damping)));
    if (!(there.chi2() <= here.chi2())) {
      if (is_settled) {
        damping = std::max(kFirstDamping, 10.0 * damping);
      } else {
        settle_changes(model, data, point, here);
        g = here.gradient();
        is_settled = true;
      }
      continue;
    }
    const double fall = here.chi2() - there.chi2();
    point = next;
    here = there;
    if (fall < kSettledFall * (1.0 + here.chi2()) && damping < kSettledDamping) break;
    g = here.gradient();
    is_settled = model.modes() == 0;
    damping = damping <= kFirstDamping ? 0.0 : 0.1 * damping;
  }
  return here;
}

}  // namespace

ColumnChi2::ColumnChi2(const ColumnModel& model, const ColumnFreedom& free, const ColumnPoint& fixed,
                       std::size_t energy_stride)
    : model_(&model), free_(free), fixed_(fixed) {
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
  const auto nodes = [&](std::size_t unknown, const std::vector<double>& all) {
    return free[unknown] ? all : std::vector<double>{fixed[unknown]};
  };
  LineCovariance covariance;
  for (std::size_t e = 0; e < ln_energies_.size(); ++e)
    for (const double ln_oxygen : nodes(kLnOxygen, model.ln_oxygens()))
      for (const double ln_soft : nodes(kLnSoft, model.ln_softs())) {
        ScanPlace place;
        place.at = {ln_energies_[e], fixed[kLnFlux], ln_oxygen, ln_soft};
        place.energy = e;
        ColumnLights lights;
        for (const double ln_flux : ln_fluxes_) {
          model.at({ln_energies_[e], ln_flux, ln_oxygen, ln_soft}, lights);
          for (std::size_t l = 0; l < model.lines(); ++l)
            place.rayleigh_per_flux.push_back(std::exp(lights[l].ln_rayleigh - ln_flux));
        }
        if (model.modes() > 0) {
          model.at(place.at, lights);
          model.ln_covariance(place.at, lights, covariance);
          place.ln_covariance = covariance.value;
        }
        places_.push_back(std::move(place));
      }
}

double ColumnChi2::at(const ColumnData& data, const ColumnPoint& point) const {
  return descend(data, point, {}).chi2;
}

std::vector<LineCorrection> ColumnChi2::corrections(const ColumnData& data,
                                                    const ColumnValley& valley) const {
  if (model_->modes() == 0) return {};
  ColumnFreedom is_free = free_;
  for (std::size_t k = 0; k < kColumnUnknowns; ++k) is_free[k] = free_[k] && !valley.at_edge[k];
  return with_lines(model_->lines(), [&](auto lines) {
    constexpr std::size_t kLines = decltype(lines)::value;
    ColumnPoint point = valley.at;
    ColumnLinearisation<kLines> best = descended<kLines>(*model_, data, point, {});
    best.gradient();
    return best.corrections(is_free);
  });
}

template <std::size_t kLines>
double ColumnChi2::best_flux(const ColumnData& data, const ScanPlace& place, double& ln_flux) const {
  LineVector of_flux{};
  const auto take = [&](double at) {
    const double along = (at - ln_fluxes_.front()) / kFluxScanStep;
    const auto piece =
        static_cast<std::size_t>(std::clamp(along, 0.0, static_cast<double>(ln_fluxes_.size() - 2)));
    const double t = std::clamp(along - static_cast<double>(piece), 0.0, 1.0);
    const double* row = place.rayleigh_per_flux.data() + piece * kLines;
    for (std::size_t l = 0; l < kLines; ++l) of_flux[l] = row[l] + t * (row[kLines + l] - row[l]);
  };
  // The covariance of the lines, with the modes linear about the measured light.
  LineCholesky<kLines> covariance;
  if (model_->modes() > 0) {
    LineMatrix matrix;
    for (std::size_t l = 0; l < kLines; ++l) {
      const double light = std::max(data.rayleigh[l], data.sigma[l]);
      for (std::size_t m = 0; m <= l; ++m)
        matrix[l * kMaxColumnLines + m] =
            light * std::max(data.rayleigh[m], data.sigma[m]) * place.ln_covariance[l * kMaxColumnLines + m];
      matrix[l * kMaxColumnLines + l] += data.sigma[l] * data.sigma[l];
    }
    covariance.factor(matrix);
  }
  const auto weighted = [&](LineVector values) {
    if (model_->modes() > 0) return covariance.solve(values);
    for (std::size_t l = 0; l < kLines; ++l) values[l] /= data.sigma[l] * data.sigma[l];
    return values;
  };
  ln_flux = free_[kLnFlux] ? 0.0 : fixed_[kLnFlux];
  take(ln_flux);
  double flux = std::exp(ln_flux);
  for (int round = 0; free_[kLnFlux] && round < kFluxRounds; ++round) {
    const LineVector row = weighted(of_flux);
    double above = 0.0, below = 0.0;
    for (std::size_t l = 0; l < kLines; ++l) {
      above += row[l] * data.rayleigh[l];
      below += row[l] * of_flux[l];
    }
    const double before = flux;
    flux = above > 0.0 ? std::clamp(above / below, ColumnModel::kMinFlux, ColumnModel::kMaxFlux)
                       : ColumnModel::kMinFlux;
    ln_flux = std::log(flux);
    take(ln_flux);
    if (std::abs(flux - before) < kSettledFlux * flux) break;
  }
  LineVector residual{};
  for (std::size_t l = 0; l < kLines; ++l) residual[l] = flux * of_flux[l] - data.rayleigh[l];
  const LineVector of_residual = weighted(residual);
  double chi2 = 0.0;
  for (std::size_t l = 0; l < kLines; ++l) chi2 += residual[l] * of_residual[l];
  return chi2;
}

ColumnValley ColumnChi2::descend(const ColumnData& data, ColumnPoint start, const ColumnFreedom& free) const {
  return with_lines(model_->lines(), [&](auto lines) {
    ColumnLinearisation<decltype(lines)::value> best =
        descended<decltype(lines)::value>(*model_, data, start, free);
    const ColumnGradient g = best.gradient();
    ColumnValley valley{start, best.chi2(), g.information, held_unknowns(*model_, start, free, g.slope), 0.0};
    for (std::size_t k = 0; k < kColumnUnknowns; ++k)
      valley.at_edge[k] = valley.at_edge[k] && free[k] && model_->knows(k);
    return valley;
  });
}

double ColumnChi2::lowest_near(const std::vector<double>& least, std::size_t minimum) const {
  if (free_[kLnOxygen] || free_[kLnSoft]) return 0.0;
  double higher = least[minimum];
  if (minimum > 0) higher = std::max(higher, least[minimum - 1]);
  if (minimum + 1 < least.size()) higher = std::max(higher, least[minimum + 1]);
  return least[minimum] - 0.5 * (higher - least[minimum]);
}

std::vector<ColumnValley> ColumnChi2::valleys(const ColumnData& data) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<double> least(ln_energies_.size(), kFar);
  std::vector<ColumnPoint> where(ln_energies_.size());
  for (const ScanPlace& place : places_) where[place.energy] = place.at;  // where chi2 is no number
  with_lines(model_->lines(), [&](auto lines) {
    for (const ScanPlace& place : places_) {
      double ln_flux = 0.0;
      const double chi2 = best_flux<decltype(lines)::value>(data, place, ln_flux);
      if (!(chi2 < least[place.energy])) continue;
      least[place.energy] = chi2;
      where[place.energy] = place.at;
      where[place.energy][kLnFlux] = ln_flux;
    }
  });
  std::vector<std::size_t> minima;
  for (std::size_t e = 0; e < least.size(); ++e) {
    const bool falls = e == 0 || least[e] < least[e - 1];
    const bool rises = e + 1 == least.size() || least[e] <= least[e + 1];
    if (falls && rises) minima.push_back(e);
  }
  std::stable_sort(minima.begin(), minima.end(),
                   [&](std::size_t a, std::size_t b) { return least[a] < least[b]; });
  std::vector<ColumnValley> found;
  for (const std::size_t e : minima) {
    if (!found.empty() && lowest_near(least, e) > found.front().chi2 + kFarAbove) continue;
    const ColumnValley valley = descend(data, where[e], free_);
    const auto same = std::find_if(found.begin(), found.end(), [&](const ColumnValley& other) {
      return std::abs(other.at[kLnEnergy] - valley.at[kLnEnergy]) < kSameValley &&
             std::abs(other.at[kLnOxygen] - valley.at[kLnOxygen]) < kSameValley &&
             std::abs(other.at[kLnSoft] - valley.at[kLnSoft]) < kSameSoft;
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

ColumnMatrix column_covariance(const ColumnValley& valley, const ColumnFreedom& free) {
  ColumnMatrix matrix = valley.information;
  std::array<bool, kColumnUnknowns> counts{};
  for (std::size_t k = 0; k < kColumnUnknowns; ++k) {
    counts[k] = free[k] && !valley.at_edge[k];
    if (counts[k]) continue;
    const auto i = static_cast<Eigen::Index>(k);
    matrix.row(i).setZero();
    matrix.col(i).setZero();
    matrix(i, i) = 1.0;
  }
  ColumnMatrix covariance = matrix.inverse();
  for (std::size_t k = 0; k < kColumnUnknowns; ++k)
    if (!counts[k]) covariance(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)) = 0.0;
  return covariance;
}

}  // namespace vegard::fit
