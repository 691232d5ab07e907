#include "fit/columns/column_model.h"

#include <algorithm>
#include <cmath>

namespace vegard::fit {
namespace {

constexpr double kEnergyStep = 0.05;  // of ln(E0): the tables' own energies are 0.12 apart
constexpr double kOxygenStep = 0.35;  // of ln(factor): the tables' own factors are farther apart
constexpr double kFluxStep = 0.2;     // of ln(Q): the flux law is a cubic between factors of ten
constexpr double kSoftStep = 3.0;     // of ln(ratio): light is nearly linear in the soft component's share
constexpr double kSameColumn = 1e-4;  // of ln(ratio); what two columns of the tables differ by is above 0.1

EvenNodes energy_nodes(const sim::EmissionTables& tables) {
  return {std::log(tables.energies_kev().front()), std::log(tables.energies_kev().back()), kEnergyStep};
}

EvenNodes flux_nodes() {
  return {std::log(ColumnModel::kMinFlux), std::log(ColumnModel::kMaxFlux), kFluxStep};
}

EvenNodes oxygen_nodes(const sim::EmissionTables& tables) {
  const std::vector<double>& factors = tables.maxwellian().oxygen_factors();
  if (factors.size() == 1) return EvenNodes(std::log(factors.front()));
  return {std::log(factors.front()), std::log(factors.back()), kOxygenStep};
}

std::optional<ColumnTable> soft_table(const sim::EmissionTables& tables, const std::vector<double>& lines_nm,
                                      const ColumnModelOptions& options, int threads) {
  if (!options.soft_kev) return std::nullopt;
  return ColumnTable(tables, lines_nm, sim::ElectronSpectrum{}, EvenNodes(std::log(*options.soft_kev)),
                     flux_nodes(), oxygen_nodes(tables), options.has_modes, threads);
}

}  // namespace

ColumnModel::ColumnModel(const sim::EmissionTables& tables, const std::vector<double>& lines_nm,
                         const ColumnModelOptions& options, int threads)
    : lines_nm_(lines_nm),
      main_(tables, lines_nm, options.spectrum, energy_nodes(tables), flux_nodes(), oxygen_nodes(tables),
            options.has_modes, threads),
      soft_(soft_table(tables, lines_nm, options, threads)),
      softs_(soft_ ? EvenNodes(std::log(kMinSoftRatio), std::log(kMaxSoftRatio), kSoftStep) : EvenNodes(0.0)),
      least_{main_.energies().at().front(), std::log(kMinFlux), main_.oxygens().at().front(),
             softs_.at().front()},
      most_{main_.energies().at().back(), std::log(kMaxFlux), main_.oxygens().at().back(),
            softs_.at().back()},
      modes_(main_.modes()) {
  if (modes_ > 0) tabulate_covariance(nullptr);
}

ColumnModel::ColumnModel(const ColumnModel& base, const CommonLight& common) : ColumnModel(base) {
  const auto change = [&](ColumnTable& table) {
    table.multiply(common.mean.head(modes_),
                   common.factor_error.cwiseProduct(common.mean.tail(common.factor_error.size())));
  };
  change(main_);
  if (soft_) change(*soft_);
  tabulate_covariance(&common);
}

void ColumnModel::tabulate_covariance(const CommonLight* common) {
  const auto count = static_cast<Eigen::Index>(lines());
  Eigen::MatrixXd changes = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(gram_size()),
                                                  common == nullptr ? modes_ : common->mean.size());
  if (common != nullptr)
    for (Eigen::Index row = 0; row < changes.rows(); ++row)
      changes(row, modes_ + row % count) = common->factor_error(row % count);
  gram_.clear();
  for (std::size_t e = 0; e < main_.energies().size(); ++e) {
    changes.topLeftCorner(count, modes_) = main_.modes_at_node(e);
    if (soft_) changes.bottomLeftCorner(count, modes_) = soft_->modes_at_node(0);
    const Eigen::MatrixXd covariance =
        common == nullptr ? Eigen::MatrixXd(changes * changes.transpose())
                          : Eigen::MatrixXd(changes * common->covariance * changes.transpose());
    gram_.insert(gram_.end(), covariance.data(), covariance.data() + covariance.size());
  }
}

void ColumnModel::at(const ColumnPoint& point, ColumnLights& lights) const {
  std::array<ComponentLight, kMaxColumnLines> main, soft;
  main_.at(point[kLnEnergy], point[kLnFlux], point[kLnOxygen], main.data());
  if (!soft_) {
    for (std::size_t l = 0; l < lines(); ++l)
      lights[l] = {point[kLnFlux] + main[l].ln_rayleigh,
                   {main[l].by_energy, 1.0 + main[l].by_flux, main[l].by_oxygen, 0.0},
                   0.0,
                   {}};
    return;
  }
  soft_->at(soft_->energies().at().front(), point[kLnFlux], point[kLnOxygen], soft.data());
  const double ratio = std::exp(point[kLnSoft]);
  for (std::size_t l = 0; l < lines(); ++l) {
    const double brighter = ratio * std::exp(soft[l].ln_rayleigh - main[l].ln_rayleigh);
    const double share = brighter / (1.0 + brighter);
    const auto mean = [&](double of_main, double of_soft) { return of_main + share * (of_soft - of_main); };
    lights[l] = {point[kLnFlux] + main[l].ln_rayleigh + std::log((1.0 + brighter) / (1.0 + ratio)),
                 {(1.0 - share) * main[l].by_energy, 1.0 + mean(main[l].by_flux, soft[l].by_flux),
                  mean(main[l].by_oxygen, soft[l].by_oxygen), share - ratio / (1.0 + ratio)},
                 share,
                 {}};
    const double by_ln_brighter = share * (1.0 - share);
    lights[l].soft_share_slope = {-by_ln_brighter * main[l].by_energy,
                                  by_ln_brighter * (soft[l].by_flux - main[l].by_flux),
                                  by_ln_brighter * (soft[l].by_oxygen - main[l].by_oxygen), by_ln_brighter};
  }
}

ColumnLight ColumnModel::at(std::size_t line, const ColumnPoint& point) const {
  ColumnLights lights;
  at(point, lights);
  return lights[line];
}

void ColumnModel::ln_covariance(const ColumnPoint& point, const ColumnLights& lights,
                                LineCovariance& covariance) const {
  if (modes_ == 0) {
    covariance.value.fill(0.0);
    covariance.depends_on = {};
    return;
  }
  const std::size_t rows = gram_size();
  const EvenNodes::Weights weights = main_.energies().spline(point[kLnEnergy]);
  const auto between = [&](std::size_t row, std::size_t column, const std::array<double, 4>& of_nodes) {
    double sum = 0.0;
    for (std::size_t e = 0; e < weights.count; ++e)
      sum += of_nodes[e] * gram_[((weights.first + e) * rows + row) * rows + column];
    return sum;
  };
  covariance.depends_on = {true, soft_ && knows(kLnFlux), soft_ && knows(kLnOxygen), soft_ && knows(kLnSoft)};
  for (std::size_t a = 0; a < lines(); ++a)
    for (std::size_t b = a; b < lines(); ++b) {
      const std::size_t place = a * kMaxColumnLines + b, mirrored = b * kMaxColumnLines + a;
      double value = between(a, b, weights.value), by_energy = between(a, b, weights.slope);
      if (soft_) {
        // ln R changes by (1 - share) of what ln r does, and by share of what ln r_soft does.
        const std::size_t soft_a = lines() + a, soft_b = lines() + b;
        const double hard_soft = between(a, soft_b, weights.value),
                     soft_hard = between(soft_a, b, weights.value),
                     both_soft = between(soft_a, soft_b, weights.value);
        const double share_a = lights[a].soft_share, share_b = lights[b].soft_share;
        const auto mixed = [](double s, double t, double hh, double hs, double sh, double ss) {
          return (1.0 - s) * ((1.0 - t) * hh + t * hs) + s * ((1.0 - t) * sh + t * ss);
        };
        const double by_share_a = (1.0 - share_b) * (soft_hard - value) + share_b * (both_soft - hard_soft);
        const double by_share_b = (1.0 - share_a) * (hard_soft - value) + share_a * (both_soft - soft_hard);
        by_energy = mixed(share_a, share_b, by_energy, between(a, soft_b, weights.slope),
                          between(soft_a, b, weights.slope), between(soft_a, soft_b, weights.slope));
        value = mixed(share_a, share_b, value, hard_soft, soft_hard, both_soft);
        for (std::size_t k = 0; k < kColumnUnknowns; ++k)
          covariance.slope[k][place] = covariance.slope[k][mirrored] =
              by_share_a * lights[a].soft_share_slope[k] + by_share_b * lights[b].soft_share_slope[k];
        by_energy += covariance.slope[kLnEnergy][place];
      }
      covariance.value[place] = covariance.value[mirrored] = value;
      covariance.slope[kLnEnergy][place] = covariance.slope[kLnEnergy][mirrored] = by_energy;
    }
}

Eigen::MatrixXd ColumnModel::modes_at(const ColumnPoint& point) const {
  ColumnLights lights;
  at(point, lights);
  const EvenNodes::Weights weights = main_.energies().spline(point[kLnEnergy]);
  Eigen::MatrixXd changes = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(lines()), modes_);
  for (std::size_t e = 0; e < weights.count; ++e)
    changes += weights.value[e] * main_.modes_at_node(weights.first + e);
  if (!soft_) return changes;
  const Eigen::MatrixXd of_soft = soft_->modes_at_node(0);
  for (std::size_t l = 0; l < lines(); ++l) {
    const auto row = static_cast<Eigen::Index>(l);
    changes.row(row) += lights[l].soft_share * (of_soft.row(row) - changes.row(row));
  }
  return changes;
}

bool ColumnModel::is_multiple(std::size_t line, std::size_t other) const {
  double least = 0.0, most = 0.0;
  const auto compare = [&](const ColumnPoint& point) {
    ColumnLights lights;
    at(point, lights);
    const double ratio = lights[line].ln_rayleigh - lights[other].ln_rayleigh;
    if (least == 0.0 && most == 0.0) least = most = ratio;
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  };
  for (const double ln_energy : ln_energies())
    for (const double ln_oxygen : ln_oxygens())
      for (const double ln_flux : {std::log(0.1), std::log(10.0)})
        compare({ln_energy, ln_flux, ln_oxygen, least_[kLnSoft]});
  return most - least < kSameColumn;
}

}  // namespace vegard::fit
