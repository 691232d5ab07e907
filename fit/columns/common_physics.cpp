#include "fit/columns/common_physics.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "fit/columns/column_inversion.h"
#include "sim/base/parallel.h"

namespace vegard::fit {
namespace {

constexpr int kRounds = 8;
constexpr double kSettledCoefficient = 1e-3;  // of a standard deviation

/// What one measurement tells about the common coefficients c: information A and A c + b.
struct Told {
  Eigen::MatrixXd information;
  Eigen::VectorXd towards;
};

double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

class CommonSolver {
 public:
  CommonSolver(const ColumnChi2& chi2, const std::vector<ColumnData>& measurements)
      : chi2_(chi2),
        measurements_(measurements),
        modes_(chi2.model().modes()),
        lines_(static_cast<Eigen::Index>(chi2.model().lines())),
        factor_error_(lines_) {
    for (Eigen::Index l = 0; l < lines_; ++l) {
      std::vector<double> relative;
      for (const ColumnData& data : measurements)
        if (data.rayleigh[static_cast<std::size_t>(l)] > 0.0)
          relative.push_back(data.sigma[static_cast<std::size_t>(l)] /
                             data.rayleigh[static_cast<std::size_t>(l)]);
      factor_error_(l) = median_of(relative);
    }
  }

  Eigen::Index coefficients() const { return modes_ + lines_; }

  /// The light for coefficients of this distribution, the measurement's own part of the modes included.
  CommonLight light(const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance) const {
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(coefficients());
    scale.head(modes_).setConstant(std::sqrt(1.0 - kOwnShare));
    CommonLight light{scale.cwiseProduct(mean), scale.asDiagonal() * covariance * scale.asDiagonal(),
                      factor_error_};
    light.covariance.diagonal().head(modes_).array() += kOwnShare;
    return light;
  }

  /// About the best electrons of a measurement, with the common coefficients at `mean`; nothing of one that
  /// contradicts the tables. `own` has the light for these coefficients, `any` for all that are likely.
  std::optional<Told> told(const ColumnChi2& own, const ColumnData& data, const Eigen::VectorXd& mean) const {
    if (contradicts_tables(chi2_.valleys(data).front().chi2, degrees_of_freedom(chi2_))) return std::nullopt;
    const ColumnValley best = own.valleys(data).front();
    const std::vector<LineCorrection> of_own = own.corrections(data, best);
    ColumnLights lights;
    own.model().at(best.at, lights);
    Eigen::VectorXd rayleigh(lines_), towards(lines_);
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(lines_, kColumnUnknowns);
    for (Eigen::Index l = 0; l < lines_; ++l) {
      const auto line = static_cast<std::size_t>(l);
      const double change = std::log(of_own[line].factor);
      rayleigh(l) = std::exp(lights[line].ln_rayleigh + change);
      towards(l) = data.rayleigh[line] - rayleigh(l) * (1.0 - change);
      for (std::size_t k = 0; k < kColumnUnknowns; ++k)
        if (own.free()[k] && !best.at_edge[k])
          slopes(l, static_cast<Eigen::Index>(k)) = rayleigh(l) * lights[line].slope[k];
    }
    const Eigen::MatrixXd by_modes = rayleigh.asDiagonal() * own.model().modes_at(best.at);
    Eigen::MatrixXd response(lines_, coefficients());
    response << std::sqrt(1.0 - kOwnShare) * by_modes,
        Eigen::MatrixXd((rayleigh.cwiseProduct(factor_error_)).asDiagonal());
    Eigen::MatrixXd covariance = kOwnShare * by_modes * by_modes.transpose();
    for (Eigen::Index l = 0; l < lines_; ++l) {
      const double sigma = data.sigma[static_cast<std::size_t>(l)];
      covariance(l, l) += sigma * sigma;
    }
    const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
    const Eigen::MatrixXd weighted = factor.solve(slopes);
    Eigen::MatrixXd of_unknowns = slopes.transpose() * weighted;
    for (Eigen::Index k = 0; k < of_unknowns.rows(); ++k)
      if (of_unknowns(k, k) == 0.0) of_unknowns(k, k) = 1.0;
    const Eigen::MatrixXd projected = factor.solve(Eigen::MatrixXd::Identity(lines_, lines_)) -
                                      weighted * of_unknowns.ldlt().solve(weighted.transpose());
    Told one;
    one.information = response.transpose() * projected * response;
    one.towards = response.transpose() * (projected * towards) + one.information * mean;
    return one;
  }

  std::vector<std::optional<Told>> told(const Eigen::VectorXd& mean, int threads) const {
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(coefficients(), coefficients());
    const ColumnModel model(chi2_.model(), light(mean, none));
    const ColumnChi2 own(model, chi2_.free(), chi2_.fixed());
    std::vector<std::optional<Told>> all(measurements_.size());
    sim::parallel_for(all.size(), threads,
                      [&](std::size_t i, int) { all[i] = told(own, measurements_[i], mean); });
    return all;
  }

 private:
  const ColumnChi2& chi2_;
  const std::vector<ColumnData>& measurements_;
  Eigen::Index modes_, lines_;
  Eigen::VectorXd factor_error_;
};

}  // namespace

LearntPhysics learn_physics(const ColumnChi2& chi2, const std::vector<ColumnData>& measurements,
                            int threads) {
  const CommonSolver solver(chi2, measurements);
  const Eigen::Index count = solver.coefficients();
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(count);
  std::vector<std::optional<Told>> told;
  Eigen::MatrixXd information;
  Eigen::VectorXd towards;
  for (int round = 0; round < kRounds; ++round) {
    told = solver.told(mean, threads);
    information = Eigen::MatrixXd::Identity(count, count);
    towards = Eigen::VectorXd::Zero(count);
    for (const std::optional<Told>& one : told) {
      if (!one) continue;
      information += one->information;
      towards += one->towards;
    }
    const Eigen::VectorXd next = information.ldlt().solve(towards);
    const double moved = (next - mean).cwiseAbs().maxCoeff();
    mean = next;
    if (moved < kSettledCoefficient) break;
  }
  const auto light_of = [&](const Eigen::MatrixXd& of, const Eigen::VectorXd& to) {
    const Eigen::MatrixXd covariance = of.llt().solve(Eigen::MatrixXd::Identity(count, count));
    return solver.light(covariance * to, covariance);
  };
  LearntPhysics learnt;
  learnt.common = light_of(information, towards);
  std::vector<double> ln_energies, ln_fluxes;
  for (std::size_t i = 0; i < told.size(); ++i) {
    if (!told[i]) {
      learnt.without.push_back(learnt.common);
      continue;
    }
    ++learnt.used;
    learnt.without.push_back(light_of(information - told[i]->information, towards - told[i]->towards));
    const ColumnPoint best = chi2.valleys(measurements[i]).front().at;
    ln_energies.push_back(best[kLnEnergy]);
    ln_fluxes.push_back(best[kLnFlux]);
  }
  ColumnPoint middle = chi2.fixed();
  middle[kLnEnergy] = median_of(ln_energies);
  middle[kLnFlux] = median_of(ln_fluxes);
  const ColumnModel known(chi2.model(), learnt.common);
  ColumnLights before, after;
  LineCovariance wide, narrow;
  chi2.model().at(middle, before);
  chi2.model().ln_covariance(middle, before, wide);
  known.at(middle, after);
  known.ln_covariance(middle, after, narrow);
  for (std::size_t l = 0; l < chi2.model().lines(); ++l) {
    const std::size_t diagonal = l * kMaxColumnLines + l;
    learnt.corrections.push_back({std::exp(after[l].ln_rayleigh - before[l].ln_rayleigh),
                                  std::sqrt(wide.value[diagonal]), std::sqrt(narrow.value[diagonal])});
  }
  return learnt;
}

}  // namespace vegard::fit
