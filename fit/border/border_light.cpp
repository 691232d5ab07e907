#include "fit/border/border_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Dense>

#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"
#include "sim/base/parallel.h"

namespace vegard::fit {
namespace {

constexpr double kMadToSigma = 1.4826;        // of a Gaussian
constexpr double kBorderSmoothingDeg = 0.25;  // along elevation, at least a cell
constexpr double kGroundLight = 0.5;          // of the dark part of the sky

/// Returns the light less its smooth lower envelope: a cubic in elevation, each power with the first harmonic
/// of azimuth, fitted by asymmetric least squares (Newey and Powell 1987, Econometrica 55, 819), which light
/// above hardly lifts.
std::vector<double> without_border_sky(const SkyCells& cells) {
  constexpr int kTerms = 12;
  constexpr double kAbove = 0.03;  // weight of what stands above, what stands below having 1
  std::vector<double> out = cells.light;
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < out.size(); ++i)
    if (std::isfinite(out[i])) used.push_back(i);
  const double area = static_cast<double>(used.size());
  if (area < 4 * kTerms) return out;
  std::vector<double> cosine, sine;
  for (int c = 0; c < cells.columns; ++c) {
    const double azimuth = cells.azimuth_deg(c) * sim::kRadiansPerDegree;
    cosine.push_back(std::cos(azimuth));
    sine.push_back(std::sin(azimuth));
  }
  const auto basis = [&](std::size_t i) {
    const std::size_t column = i / static_cast<std::size_t>(cells.rows);
    const int row = static_cast<int>(i % static_cast<std::size_t>(cells.rows));
    const double t = 2.0 * (row + 0.5) / cells.rows - 1.0;
    Eigen::Matrix<double, kTerms, 1> v;
    const double power[4] = {1.0, t, t * t, t * t * t};
    for (int k = 0; k < 4; ++k) {
      v[3 * k] = power[k];
      v[3 * k + 1] = power[k] * cosine[column];
      v[3 * k + 2] = power[k] * sine[column];
    }
    return v;
  };
  Eigen::Matrix<double, kTerms, 1> best = Eigen::Matrix<double, kTerms, 1>::Zero();
  for (int round = 0; round < 12; ++round) {
    Eigen::Matrix<double, kTerms, kTerms> normal = Eigen::Matrix<double, kTerms, kTerms>::Zero();
    Eigen::Matrix<double, kTerms, 1> right = Eigen::Matrix<double, kTerms, 1>::Zero();
    for (const std::size_t i : used) {
      const auto v = basis(i);
      const double weight = round == 0 || cells.light[i] <= v.dot(best) ? 1.0 : kAbove;
      normal.noalias() += weight * v * v.transpose();
      right += weight * cells.light[i] * v;
    }
    // Narrow pictures do not distinguish the harmonics: a small ridge term holds them.
    normal.diagonal().array() += 1e-6 * area;
    best = normal.ldlt().solve(right);
  }
  for (const std::size_t i : used) out[i] -= basis(i).dot(best);
  return out;
}

/// Returns the light smoothed over the usable cells: by a Gaussian along elevation, by (1 2 1) / 4 across
/// azimuth.
std::vector<double> smoothed_border_light(const SkyCells& cells, const std::vector<double>& light) {
  const double sigma = std::max(1.0, kBorderSmoothingDeg / cells.elevation_step_deg);
  const int reach = static_cast<int>(std::ceil(3.0 * sigma));
  std::vector<double> out(light.size(), sim::kNaN), fall;
  for (int dr = -reach; dr <= reach; ++dr) fall.push_back(std::exp(-0.5 * dr * dr / (sigma * sigma)));
  sim::parallel_for(static_cast<std::size_t>(cells.columns), 0, [&](std::size_t column, int) {
    const int c = static_cast<int>(column);
    for (int r = 0; r < cells.rows; ++r) {
      if (!std::isfinite(light[cells.index(c, r)])) continue;
      double sum = 0.0, weights = 0.0;
      for (int dc = -1; dc <= 1; ++dc)
        for (int dr = -reach; dr <= reach; ++dr) {
          if (r + dr < 0 || r + dr >= cells.rows) continue;
          const double v = light[cells.index((c + dc + cells.columns) % cells.columns, r + dr)];
          if (!std::isfinite(v)) continue;
          const double w = (dc == 0 ? 2.0 : 1.0) * fall[static_cast<std::size_t>(dr + reach)];
          sum += w * v;
          weights += w;
        }
      out[cells.index(c, r)] = sum / weights;
    }
  });
  return out;
}

/// Measures the noise by second differences of single cells at each brightness, scaled by what smoothing
/// leaves of them over its own reach in the darker half of the picture: there, structure does not pass for
/// noise, and the correlation of neighbouring pixels (interpolation, compression) counts in full.
BorderNoise border_noise(const SkyCells& cells, const std::vector<double>& smooth) {
  constexpr std::size_t kBins = 12, kMin = 40;
  std::vector<std::pair<double, double>> rough;  // brightness, |second difference|
  const int lag =
      static_cast<int>(std::ceil(3.0 * std::max(1.0, kBorderSmoothingDeg / cells.elevation_step_deg)));
  for (int c = 0; c < cells.columns; ++c)
    for (int r = 1; r + 1 < cells.rows; ++r) {
      const double below = cells.light[cells.index(c, r - 1)], v = cells.light[cells.index(c, r)],
                   above = cells.light[cells.index(c, r + 1)];
      if (std::isfinite(below + v + above)) rough.emplace_back(v, std::abs(v - 0.5 * (below + above)));
    }
  BorderNoise noise;
  if (rough.size() < kMin) return noise;
  std::sort(rough.begin(), rough.end());
  const std::size_t bins = std::clamp<std::size_t>(rough.size() / kMin, 1, kBins);
  const auto brightness = [&](double share) {
    return rough[static_cast<std::size_t>(share * static_cast<double>(rough.size() - 1))].first;
  };
  // A made picture may have no noise at all, but eight bits have rounded it.
  const double rounding = 1e-4 * (brightness(0.995) - brightness(0.2));
  double least = rounding;
  for (std::size_t b = 0; b < bins; ++b) {
    std::vector<double> d;
    for (std::size_t i = b * rough.size() / bins; i < (b + 1) * rough.size() / bins; ++i)
      d.push_back(rough[i].second);
    noise.brightness.push_back(rough[b * rough.size() / bins].first);
    // Brighter pixels are no less noisy: a bin of equal codes is one that the file has rounded.
    least = std::max(least, kMadToSigma * sim::quantile(d, 0.5) / std::sqrt(1.5));
    noise.sigma.push_back(least);
  }
  const double dark = rough[rough.size() / 2].first;
  std::vector<double> ratio;
  for (int c = 0; c < cells.columns; ++c)
    for (int r = lag; r + lag < cells.rows; ++r) {
      const std::size_t i = cells.index(c, r);
      const double d = smooth[i] - 0.5 * (smooth[i - lag] + smooth[i + lag]);
      if (!std::isfinite(d) || cells.light[i] > dark) continue;
      if (const double sigma = noise.at(cells.light[i]); sigma > rounding)
        ratio.push_back(std::abs(d) / sigma);
    }
  // Smoothing reduces no noise by more than it reduces white noise.
  const double rows = std::max(1.0, kBorderSmoothingDeg / cells.elevation_step_deg);
  double scale = std::sqrt(6.0 / 16.0 / (2.0 * std::sqrt(sim::kPi) * rows));
  if (!ratio.empty()) scale = std::max(scale, kMadToSigma * sim::quantile(ratio, 0.5) / std::sqrt(1.5));
  for (double& s : noise.sigma) s = std::max(s * scale, 1e-9);
  return noise;
}

}  // namespace

std::optional<BorderLight> border_light(const SkyCells& cells, BorderAir air) {
  const std::vector<double> light = without_border_sky(cells);
  BorderLight work{cells,
                   std::move(air),
                   smoothed_border_light(cells, cells.light),
                   smoothed_border_light(cells, light),
                   {},
                   {},
                   0.0};
  work.noise = border_noise(cells, work.smooth);
  std::vector<double> all;
  for (const double v : work.smooth)
    if (std::isfinite(v)) all.push_back(v);
  if (work.noise.sigma.empty() || all.empty()) return {};
  work.least = 0.05 * (sim::quantile(all, 0.995) - sim::quantile(all, 0.2));
  std::vector<double> whole;
  for (const double v : work.whole)
    if (std::isfinite(v)) whole.push_back(v);
  work.dark_sky = kGroundLight * sim::quantile(whole, 0.25);
  const int aside = static_cast<int>(15.0 / cells.azimuth_step_deg);
  work.floor.resize(static_cast<std::size_t>(cells.columns));
  sim::parallel_for(work.floor.size(), 0, [&](std::size_t column, int) {
    const int c = static_cast<int>(column);
    std::vector<double> near;
    for (int k = c - aside; k <= c + aside; ++k)
      for (int r = 0; r < cells.rows; ++r) {
        const double v = work.at((k + cells.columns) % cells.columns, r);
        if (std::isfinite(v)) near.push_back(v);
      }
    work.floor[column] = sim::quantile(near, 0.1);
  });
  return work;
}

}  // namespace vegard::fit
