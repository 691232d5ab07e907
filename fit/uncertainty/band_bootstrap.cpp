#include "fit/uncertainty/band_bootstrap.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "sim/base/number/dense_solvers.h"
#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"

namespace vegard::fit {
namespace {

constexpr double kBootstrapRankTolerance = 1e-12;
constexpr std::uint32_t kDraw = 0, kBootstrapShift = 1;  // what a random number is for

/// What a group of rows says: Jᵀ J and Jᵀ r.
struct Normal {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
  explicit Normal(Eigen::Index n) : matrix(Eigen::MatrixXd::Zero(n, n)), right(Eigen::VectorXd::Zero(n)) {}
};

/// Empty where the matrix, scaled to a unit diagonal, is not of full rank.
std::vector<double> solved(const Normal& normal) {
  const Eigen::Index n = normal.right.size();
  const Eigen::VectorXd length = normal.matrix.diagonal().cwiseMax(0.0).cwiseSqrt();
  if (!(length.minCoeff() > 0.0)) return {};
  const Eigen::MatrixXd unit = length.cwiseInverse().asDiagonal();
  const sim::SymmetricEigen eigen = sim::symmetric_eigen(unit * normal.matrix * unit);
  if (!eigen.converged || !(eigen.values(0) > kBootstrapRankTolerance * eigen.values(n - 1))) return {};
  const Eigen::VectorXd along = eigen.vectors.transpose() * (unit * normal.right);
  const Eigen::VectorXd step = -(unit * (eigen.vectors * along.cwiseQuotient(eigen.values)));
  if (!step.allFinite()) return {};
  return {step.data(), step.data() + n};
}

}  // namespace

BandBootstrap band_bootstrap(const BandRows& rows, const BootstrapOptions& options) {
  BandBootstrap result;
  const auto n = static_cast<Eigen::Index>(rows.coordinates);
  // Bands without a row (all masked) cannot be drawn.
  std::vector<int> present = rows.band;
  std::sort(present.begin(), present.end());
  present.erase(std::unique(present.begin(), present.end()), present.end());
  present.erase(present.begin(), std::lower_bound(present.begin(), present.end(), 0));
  result.bands = static_cast<int>(present.size());
  if (result.bands < 2 || n == 0) return result;

  std::vector<Normal> band_normal(present.size(), Normal(n));
  Normal no_band(n);
  std::vector<std::size_t> priors;
  for (std::size_t r = 0; r < rows.residual.size(); ++r) {
    const Eigen::Map<const Eigen::VectorXd> row(rows.jacobian.data() + r * rows.coordinates, n);
    if (rows.band[r] < 0) priors.push_back(r);
    const auto place = std::lower_bound(present.begin(), present.end(), rows.band[r]) - present.begin();
    Normal& normal = rows.band[r] < 0 ? no_band : band_normal[static_cast<std::size_t>(place)];
    normal.matrix.noalias() += row * row.transpose();
    normal.right += row * rows.residual[r];
  }

  const double widened = std::sqrt(result.bands / (result.bands - 1.0));
  for (int replicate = 0; replicate < options.replicates; ++replicate) {
    if (options.stop != nullptr && options.stop->load()) break;
    const auto at = static_cast<std::uint32_t>(replicate);
    std::vector<double> weight(static_cast<std::size_t>(present.back()) + 1, 0.0);
    Normal normal = no_band;
    for (std::uint32_t draw = 0; draw < present.size(); ++draw) {
      const sim::Words w = sim::random_words(options.seed, sim::Stream::bootstrap, at, draw, kDraw);
      const auto which = static_cast<std::size_t>(static_cast<std::uint64_t>(w[0]) * present.size() >> 32);
      weight[static_cast<std::size_t>(present[which])] += 1.0;
      normal.matrix += band_normal[which].matrix;
      normal.right += band_normal[which].right;
    }
    std::vector<double> shift(rows.residual.size(), 0.0);
    for (std::size_t p = 0; options.shift_priors && p < priors.size(); ++p) {
      const sim::Words w = sim::random_words(options.seed, sim::Stream::bootstrap, at,
                                             static_cast<std::uint32_t>(p), kBootstrapShift);
      shift[priors[p]] = sim::normal_quantile(sim::fine_uniform(w[0], w[1])) / widened;
      normal.right +=
          Eigen::Map<const Eigen::VectorXd>(rows.jacobian.data() + priors[p] * rows.coordinates, n) *
          shift[priors[p]];
    }
    std::vector<double> step = solved(normal);
    if (!step.empty() && options.refit) step = options.refit(weight, shift, step);
    if (step.size() != rows.coordinates) {
      ++result.failed;
      continue;
    }
    ++result.replicates;
    for (const double s : step) result.samples.push_back(widened * s);
  }
  const SampleSummary summary = summary_of_samples(result.samples, rows.coordinates);
  result.mean = summary.mean;
  result.sigma = summary.sigma;
  result.step68 = summary.interval68;
  result.step95 = summary.interval95;
  result.correlation = summary.correlation;
  return result;
}

namespace {

constexpr double kShare68 = 0.682689492137, kShare95 = 0.954499736104;  // of one and of two sigma

}  // namespace

double percentile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 >= sorted.size()) return sorted.back();
  const double t = place - static_cast<double>(below);
  return (1.0 - t) * sorted[below] + t * sorted[below + 1];
}

SampleSummary summary_of_samples(const std::vector<double>& samples, std::size_t numbers) {
  SampleSummary s;
  const std::size_t count = numbers > 0 ? samples.size() / numbers : 0;
  if (count < 2) return s;
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> all(samples.data(), static_cast<Eigen::Index>(count),
                                       static_cast<Eigen::Index>(numbers));
  const Eigen::RowVectorXd mean = all.colwise().mean();
  const RowMajor about = all.rowwise() - mean;
  const Eigen::MatrixXd covariance = about.transpose() * about / static_cast<double>(count - 1);
  s.correlation.assign(numbers, std::vector<double>(numbers, 0.0));
  std::vector<double> sorted(count);
  for (std::size_t j = 0; j < numbers; ++j) {
    const auto jj = static_cast<Eigen::Index>(j);
    s.mean.push_back(mean(jj));
    s.sigma.push_back(std::sqrt(covariance(jj, jj)));
    for (std::size_t k = 0; k < numbers; ++k) {
      const auto kk = static_cast<Eigen::Index>(k);
      const double both = std::sqrt(covariance(jj, jj)) * std::sqrt(covariance(kk, kk));
      if (both > 0.0) s.correlation[j][k] = j == k ? 1.0 : covariance(jj, kk) / both;
    }
    for (std::size_t i = 0; i < count; ++i) sorted[i] = samples[i * numbers + j];
    std::sort(sorted.begin(), sorted.end());
    s.median.push_back(percentile(sorted, 0.5));
    const auto tails = [&](double share) {
      return std::pair(percentile(sorted, 0.5 * (1.0 - share)), percentile(sorted, 0.5 * (1.0 + share)));
    };
    s.interval68.push_back(tails(kShare68));
    s.interval95.push_back(tails(kShare95));
  }
  return s;
}

}  // namespace vegard::fit
