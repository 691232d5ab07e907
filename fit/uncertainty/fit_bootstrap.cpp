#include "fit/uncertainty/converged_fit.h"

#include <Eigen/Dense>
#include <cmath>

#include "fit/uncertainty/sampled_uncertainty.h"

namespace vegard::fit {
namespace {

constexpr std::size_t kMaxCounted = 1'000'000'000;  // of what an int counts

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Band of every residual of the photographs.
std::vector<int> bands_of(const std::vector<Observation>& observations, const ProfileCost::Point& point) {
  std::vector<int> bands;
  int before = 0;
  for (std::size_t o = 0; o < observations.size(); ++o) {
    const Comparison& full = *observations[o].full;
    const std::vector<std::size_t> used = full.profile_part(point.by_photo[o]).used;
    const std::size_t first = bands.size();
    bands.resize(first + static_cast<std::size_t>(full.residuals()), -1);
    for (std::size_t k = 0; k < used.size(); ++k)
      bands[first + k] =
          before + static_cast<int>(used[k] / (3 * static_cast<std::size_t>(full.data().rows)));
    before += full.data().bands;
  }
  return bands;
}

std::vector<double> mean_of(const std::vector<std::vector<double>>& all) {
  std::vector<double> mean(all.front().size(), 0.0);
  for (const std::vector<double>& one : all)
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += one[i] / static_cast<double>(all.size());
  return mean;
}

/// The residual that no step makes smaller.
void take_off_what_moves(BandRows& rows) {
  const auto n = static_cast<Eigen::Index>(rows.coordinates);
  const auto m = static_cast<Eigen::Index>(rows.residual.size());
  const Eigen::Map<const RowMajor> jacobian(rows.jacobian.data(), m, n);
  Eigen::Map<Eigen::VectorXd> residual(rows.residual.data(), m);
  const Eigen::VectorXd step = jacobian.colPivHouseholderQr().solve(residual);
  if (step.allFinite()) residual -= jacobian * step;
}

}  // namespace

BandRows photo_rows(const std::vector<Observation>& observations, const ProfileCost& cost,
                    const ProfileCost::Point& point, const std::vector<std::vector<double>>& jacobians,
                    double inflation) {
  BandRows rows;
  rows.residual = cost.data_residual(point);
  rows.jacobian = mean_of(jacobians);
  rows.coordinates = rows.residual.empty() ? 0 : rows.jacobian.size() / rows.residual.size();
  rows.band = bands_of(observations, point);
  // The estimator weighs data by the inflation, and priors as they are; how far bands scatter does not ask.
  for (double& r : rows.residual) r /= inflation;
  for (double& d : rows.jacobian) d /= inflation;
  return rows;
}

BandRows band_rows(const ConvergedFit& fit, int threads) {
  const std::size_t n = fit.free.size();
  EvaluationLog uncounted;
  const ProfileCost cost(fit.free, cost_terms(fit.observations, fit.free, Detail::full), uncounted,
                         {{}, {}, fit.prior, 1.0, {}});
  const ProfileCost::Point point = cost.at(fit.values, true);
  BandRows rows =
      photo_rows(fit.observations, cost, point,
                 sampled_jacobians(fit.observations, fit.free, fit.values, {}, threads), fit.inflation);

  const std::vector<double> residual = cost.prior_residual(fit.values);
  std::vector<double> by_value = cost.prior_jacobian(fit.values);
  cost.by_coordinates(fit.values, by_value);
  rows.residual.insert(rows.residual.end(), residual.begin(), residual.end());
  rows.jacobian.insert(rows.jacobian.end(), by_value.begin(), by_value.end());
  for (std::size_t j = 0; j < n; ++j) {
    const double variance =
        limit_variance(fit.free[j], fit.free[j].slope(fit.free[j].coordinate(fit.values[j])));
    if (!std::isfinite(variance)) continue;
    rows.residual.push_back(0.0);
    rows.jacobian.resize(rows.jacobian.size() + n, 0.0);
    rows.jacobian[rows.jacobian.size() - n + j] = 1.0 / std::sqrt(variance);
  }
  rows.band.resize(rows.residual.size(), -1);
  take_off_what_moves(rows);
  return rows;
}

BandBootstrap bootstrap_of_fit(const ConvergedFit& fit, int replicates, int threads,
                               const std::atomic<bool>* stop) {
  BootstrapOptions options;
  options.replicates = replicates;
  options.seed = fit.scene.seed;
  options.stop = stop;
  return band_bootstrap(band_rows(fit, threads), options);
}

StepOutput output_of(const BandBootstrap& bootstrap) {
  StepOutput output;
  output.numbers["bands, replicates, failed"] = {static_cast<double>(bootstrap.bands),
                                                 static_cast<double>(bootstrap.replicates),
                                                 static_cast<double>(bootstrap.failed)};
  output.numbers["samples"] = bootstrap.samples;
  return output;
}

BandBootstrap band_bootstrap_of(const StepOutput& output, std::size_t free) {
  BandBootstrap bootstrap;
  const std::string key = "bands, replicates, failed";
  const std::vector<double>& counts = output.numbers_at(key, 3);
  bootstrap.bands = static_cast<int>(output.count_of(counts[0], key, kMaxCounted));
  bootstrap.replicates = static_cast<int>(output.count_of(counts[1], key, kMaxCounted));
  bootstrap.failed = static_cast<int>(output.count_of(counts[2], key, kMaxCounted));
  bootstrap.samples = output.numbers_at("samples", free * static_cast<std::size_t>(bootstrap.replicates));
  return bootstrap;
}

}  // namespace vegard::fit
