#include "fit/measure/power_spectrum.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/base/number/dense_solvers.h"

namespace vegard::fit {
namespace {

constexpr double kLowest = 2.0;         ///< waves over the longer side: longer ones are the trend's
constexpr double kHighest = 1.0 / 3.0;  ///< waves to a cell: the cells themselves blur shorter ones
const double kRatio = std::sqrt(2.0);   ///< of a band's ends
constexpr std::size_t kFewestWaves = 6;
constexpr int kFarthest = 6;  ///< by how many wavenumbers a window joins neighbours

/// exp(-2 pi i k u / n), [k][u]
Eigen::MatrixXcd transform(int n) {
  Eigen::MatrixXcd waves(n, n);
  for (int k = 0; k < n; ++k)
    for (int u = 0; u < n; ++u)
      waves(k, u) = std::polar(1.0, -sim::kTwoPi * ((k * static_cast<long>(u)) % n) / n);
  return waves;
}

/// 0, 1, ..., -2, -1
int signed_wave(int k, int n) { return k <= n / 2 ? k : k - n; }

}  // namespace

PowerSpectrum::PowerSpectrum(int columns, int rows, std::vector<double> window)
    : columns_(columns), rows_(rows), down_(transform(rows)), across_(transform(columns)) {
  const Eigen::Index cells = static_cast<Eigen::Index>(columns) * rows;
  window_ = Eigen::Map<const Eigen::VectorXd>(window.data(), cells);
  terms_.resize(cells, 6);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const double u = (2.0 * c + 1.0) / columns - 1.0, v = (2.0 * r + 1.0) / rows - 1.0;
      terms_.row(static_cast<Eigen::Index>(r) * columns + c) << 1.0, u, v, u * u, u * v, v * v;
    }
  const Eigen::MatrixXd weighted = window_.asDiagonal() * terms_;
  fit_ = sim::solve_symmetric(terms_.transpose() * weighted, Eigen::MatrixXd(weighted.transpose()));

  // Rings of wavenumbers.
  const double lowest = kLowest / std::max(columns, rows);
  const int count = std::max(1, static_cast<int>(std::floor(std::log(kHighest / lowest) / std::log(kRatio))));
  std::vector<Band> rings(count);
  for (int k = 0; k < rows; ++k)
    for (int l = 0; l < columns; ++l) {
      const double f = std::hypot(static_cast<double>(signed_wave(k, rows)) / rows,
                                  static_cast<double>(signed_wave(l, columns)) / columns);
      const int ring =
          f < lowest ? -1 : static_cast<int>(std::floor(std::log(f / lowest) / std::log(kRatio)));
      if (ring >= 0 && ring < count) rings[ring].waves.emplace_back(k, l);
    }
  Band joined;
  double from = lowest;
  for (int b = 0; b < count; ++b) {
    joined.waves.insert(joined.waves.end(), rings[b].waves.begin(), rings[b].waves.end());
    const double to = lowest * std::pow(kRatio, b + 1);
    if (joined.waves.size() < kFewestWaves) continue;
    joined.middle = std::sqrt(from * to);
    bands_.push_back(std::move(joined));
    joined = {};
    from = to;
  }

  const Eigen::MatrixXcd square = waves_of(window_) / window_.squaredNorm();  // of w times w
  for (Band& band : bands_) {
    std::map<std::pair<int, int>, bool> is_in;
    for (const auto& wave : band.waves) is_in[wave] = true;
    double pairs = 0.0;
    for (const auto& [k, l] : band.waves)
      for (int dk = -kFarthest; dk <= kFarthest; ++dk)
        for (int dl = -kFarthest; dl <= kFarthest; ++dl) {
          const int k2 = (k + dk + rows) % rows, l2 = (l + dl + columns) % columns;
          if (is_in.count({k2, l2}) == 0) continue;
          pairs += std::norm(square((dk + rows) % rows, (dl + columns) % columns));
        }
    const double n = static_cast<double>(band.waves.size());
    band.relative_variance = 2.0 * pairs / (n * n);
  }
}

Eigen::VectorXd PowerSpectrum::trend_of(const Eigen::VectorXd& light) const {
  return terms_ * (fit_ * light);
}

/// Of window times what is given.
Eigen::MatrixXcd PowerSpectrum::waves_of(const Eigen::VectorXd& uneven) const {
  const Eigen::VectorXd seen = window_.cwiseProduct(uneven);
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> cells(
      seen.data(), rows_, columns_);
  return down_ * cells.cast<std::complex<double>>() * across_.transpose();
}

PowerSpectrum::Light PowerSpectrum::of(const std::vector<double>& light) const {
  Light result;
  result.light = Eigen::Map<const Eigen::VectorXd>(light.data(), static_cast<Eigen::Index>(light.size()));
  result.trend = trend_of(result.light);
  const Eigen::VectorXd uneven =
      (window_.array() > 0.0).select(result.light.array() / result.trend.array() - 1.0, 0.0);
  result.waves = waves_of(uneven);
  for (const Band& band : bands_) {
    double sum = 0.0;
    for (const auto& [k, l] : band.waves) sum += std::norm(result.waves(k, l));
    result.power.push_back(sum / static_cast<double>(band.waves.size()));
  }
  return result;
}

std::vector<double> PowerSpectrum::slope(const Light& at, const std::vector<double>& by_number) const {
  const Eigen::VectorXd grow =
      Eigen::Map<const Eigen::VectorXd>(by_number.data(), static_cast<Eigen::Index>(by_number.size()));
  const Eigen::VectorXd of_trend = trend_of(grow);
  const Eigen::VectorXd uneven =
      (window_.array() > 0.0)
          .select(grow.array() / at.trend.array() -
                      at.light.array() * of_trend.array() / at.trend.array().square(),
                  0.0);
  const Eigen::MatrixXcd waves = waves_of(uneven);
  std::vector<double> slopes;
  for (const Band& band : bands_) {
    double sum = 0.0;
    for (const auto& [k, l] : band.waves) sum += 2.0 * std::real(std::conj(at.waves(k, l)) * waves(k, l));
    slopes.push_back(sum / static_cast<double>(band.waves.size()));
  }
  return slopes;
}

double PowerSpectrum::noise_power(const Light& at, const std::vector<double>& variance) const {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < window_.size(); ++i)
    if (window_(i) > 0.0)
      sum += window_(i) * window_(i) * variance[static_cast<std::size_t>(i)] / (at.trend(i) * at.trend(i));
  return sum;
}

}  // namespace vegard::fit
