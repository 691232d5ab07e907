#include "fit/compare/texture_statistic.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "fit/measure/noise_model.h"
#include "fit/measure/profile.h"
#include "sim/base/number/dense_solvers.h"
#include "sim/scene/table/parameter_id.h"

namespace vegard::fit {

/// The logarithm of the light along a stretch, and what is known of it.
struct TextureStatistic::Row {
  int first = 0, width = 0;
  double y = 0.0;
  std::vector<double> value;  ///< 0 where not usable; no parabola in it
  std::vector<bool> usable;
  Eigen::MatrixXd rest;  ///< projection on usable columns, without parabolas
  double noise = 0.0;    ///< variance of a value
};

namespace {

using Row = TextureStatistic::Row;

constexpr int kLags[] = {0, 1, 2, 3, 4, 6, 8, 11, 16, 23, 32, 45, 64};
constexpr int kWidest = 192;  ///< pixels of a stretch: bands wider than that are cut
constexpr int kTextureNarrowest = 16;
constexpr double kBrightRows = 0.7;    ///< of the band's peak
constexpr double kDimColumn = 0.1;     ///< of the stretch's mean: too dark for a logarithm
constexpr double kTextureClear = 5.0;  ///< standard deviations
/// Of the largest. Differences of lags that are nearly alike depend on the covariance's finest form, which
/// the model does not have right: with 1e-4, widths come out low by more than their error bars.
constexpr double kMinEigenvalue = 1e-2;
constexpr double kTextureStep = 1e-5, kWideStep = 1e-4;                    ///< of differences, once and twice
constexpr double kLnContrast[2] = {-4.6, 1.1}, kLnWidth[2] = {-3.9, 4.6};  ///< 0.01 to 3, 0.02 to 100 km

/// Columns begin to end over the rows top to bottom; false if too few are usable.
bool read_row(const Photo& photo, int begin, int end, int top, int bottom, double sky, double pixel_variance,
              Row& row) {
  row.first = begin;
  row.width = end - begin;
  row.y = 0.5 * (top + bottom + 1);
  std::vector<double> light(row.width, 0.0);
  std::vector<int> count(row.width, 0);
  double total = 0.0;
  int columns = 0;
  for (int x = begin; x < end; ++x) {
    for (int y = top; y <= bottom; ++y) {
      const std::size_t i = photo.linear.index(x, y, 1);
      if (!photo.usable[i]) continue;
      light[x - begin] += photo.linear.data[i] - sky;
      ++count[x - begin];
    }
    if (2 * count[x - begin] <= bottom - top) continue;
    light[x - begin] /= count[x - begin];
    total += light[x - begin];
    ++columns;
  }
  if (columns < kTextureNarrowest || !(total > 0.0)) return false;
  const double mean = total / columns;
  row.usable.assign(row.width, false);
  Eigen::MatrixXd trend = Eigen::MatrixXd::Zero(row.width, 3);
  Eigen::VectorXd logarithm = Eigen::VectorXd::Zero(row.width);
  columns = 0;
  for (int i = 0; i < row.width; ++i) {
    if (2 * count[i] <= bottom - top || light[i] < kDimColumn * mean) continue;
    row.usable[i] = true;
    ++columns;
    const double place = (2.0 * i + 1.0) / row.width - 1.0;
    trend.row(i) << 1.0, place, place * place;
    logarithm(i) = std::log(light[i]);
    row.noise += pixel_variance / (count[i] * light[i] * light[i]);
  }
  if (columns < kTextureNarrowest) return false;
  row.noise /= columns;
  row.rest = -trend * (trend.transpose() * trend).ldlt().solve(trend.transpose());
  for (int i = 0; i < row.width; ++i)
    if (row.usable[i]) row.rest(i, i) += 1.0;
  const Eigen::VectorXd rest = row.rest * logarithm;
  row.value.assign(rest.data(), rest.data() + rest.size());
  return true;
}

/// All stretches of the picture: the brightest rows of its bands.
std::vector<Row> read_rows(const Photo& photo, const Region& region, int bands) {
  const Profile profile = extract_profile(photo, region, bands);
  const double sky = sky_level(profile)[1];
  std::vector<Row> rows;
  for (int b = 0; b < bands; ++b) {
    int peak = -1;
    const auto light = [&](int r) { return profile.mean[profile.index(b, r, 1)] - sky; };
    const auto known = [&](int r) { return profile.count[profile.index(b, r, 1)] > 1; };
    for (int r = 0; r < profile.rows; ++r)
      if (known(r) && (peak < 0 || light(r) > light(peak))) peak = r;
    if (peak < 0 || !(light(peak) > 0.0)) continue;
    int top = peak, bottom = peak;
    while (top > 0 && known(top - 1) && light(top - 1) >= kBrightRows * light(peak)) --top;
    while (bottom + 1 < profile.rows && known(bottom + 1) && light(bottom + 1) >= kBrightRows * light(peak))
      ++bottom;
    const std::size_t i = profile.index(b, peak, 1);
    const double variance = profile.standard_error[i] * profile.standard_error[i] * profile.count[i];
    const int begin = band_begin(region, bands, b), width = band_begin(region, bands, b + 1) - begin;
    const int pieces = (width + kWidest - 1) / kWidest;
    for (int piece = 0; piece < pieces; ++piece) {
      Row row;
      if (read_row(photo, begin + width * piece / pieces, begin + width * (piece + 1) / pieces,
                   region.y + top, region.y + bottom, sky, variance, row))
        rows.push_back(std::move(row));
    }
  }
  return rows;
}

/// Coefficients of free-form profiles, of which there are many, have no part in where the rays stand.
bool shapes_a_profile(const sim::ParameterId& number) {
  return number.role() == sim::ParameterRole::profile_coefficient;
}

/// (1/n) sum over pairs `lag` apart, as a symmetric matrix; without parabolas.
Eigen::MatrixXd form_of_lag(const Row& row, int lag) {
  Eigen::MatrixXd form = Eigen::MatrixXd::Zero(row.width, row.width);
  int pairs = 0;
  for (int i = 0; i + lag < row.width; ++i) pairs += row.usable[i] && row.usable[i + lag];
  if (pairs == 0) return form;
  for (int i = 0; i + lag < row.width; ++i) {
    if (!row.usable[i] || !row.usable[i + lag]) continue;
    form(i, i + lag) += 0.5 / pairs;
    form(i + lag, i) += 0.5 / pairs;
  }
  return row.rest * form * row.rest;
}

/// Autocovariance of all stretches together, noise included, by distance in pixels: never negative definite
/// (lags count by all pixels, not by pairs; Parzen's window).
std::vector<double> pooled(const std::vector<Row>& rows, int longest) {
  std::vector<double> sum(longest + 1, 0.0);
  double pixels = 0.0;
  for (const Row& row : rows) {
    for (int d = 0; d <= std::min(longest, row.width - 1); ++d)
      for (int i = 0; i + d < row.width; ++i) sum[d] += row.value[i] * row.value[i + d];
    pixels += static_cast<double>(std::count(row.usable.begin(), row.usable.end(), true));
  }
  for (int d = 0; d <= longest; ++d) {
    const double u = static_cast<double>(d) / (longest + 1);
    const double window = u < 0.5 ? 1.0 - 6.0 * u * u * (1.0 - u) : 2.0 * std::pow(1.0 - u, 3);
    sum[d] *= window / pixels;
  }
  return sum;
}

}  // namespace

/// `by_distance`: covariance of the logarithm of light and noise by distance in pixels.
TextureStatistic::Stretch TextureStatistic::stretch_of(const Row& row, const std::vector<int>& lags,
                                                       const std::vector<double>& by_distance,
                                                       double model_error, double weight) {
  const std::size_t n = lags.size();
  Eigen::MatrixXd covariance(row.width, row.width);
  for (int i = 0; i < row.width; ++i)
    for (int j = 0; j < row.width; ++j) covariance(i, j) = by_distance[std::abs(i - j)];
  Stretch stretch;
  stretch.x_px = row.first + 0.5 * row.width;
  stretch.y_px = row.y;
  stretch.pixels = row.width;
  stretch.lags = n;
  const Eigen::Map<const Eigen::VectorXd> value(row.value.data(), row.width);
  std::vector<Eigen::MatrixXd> times_covariance;
  for (const int lag : lags) {
    const Eigen::MatrixXd form = form_of_lag(row, lag);
    stretch.seen.push_back(value.dot(form * value));
    double noise_response = 0.0;
    std::vector<double> distance_response(row.width, 0.0);
    for (int i = 0; i < row.width; ++i) {
      noise_response += form(i, i) * row.noise;
      for (int j = 0; j < row.width; ++j) distance_response[std::abs(i - j)] += form(i, j);
    }
    stretch.noise_response.push_back(noise_response);
    stretch.distance_response.insert(stretch.distance_response.end(), distance_response.begin(),
                                     distance_response.end());
    times_covariance.push_back(form * covariance);
  }
  Eigen::MatrixXd of_lags(n, n);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t l = 0; l < n; ++l)
      of_lags(k, l) = 2.0 * (times_covariance[k].array() * times_covariance[l].transpose().array()).sum();
  of_lags.diagonal().array() += std::pow(model_error, 4);
  const sim::SymmetricEigen axes = sim::symmetric_eigen(of_lags);
  for (Eigen::Index a = axes.values.size(); a-- > 0;) {
    const double variance = axes.values(a);
    if (!(variance > kMinEigenvalue * axes.values.maxCoeff())) continue;
    for (std::size_t k = 0; k < n; ++k)
      stretch.whitening.push_back(axes.vectors(static_cast<Eigen::Index>(k), a) *
                                  std::sqrt(weight / variance));
    ++stretch.residuals;
  }
  return stretch;
}

TextureStatistic::TextureStatistic(const sim::Scene& scene, const Photo& photo, const Region& region,
                                   double weight)
    : weight_(weight) {
  for (std::size_t s = scene.sheets.size(); s-- > 0;)
    if (scene.sheets[s].ray_contrast > 0.0) sheet_ = static_cast<int>(s);
  if (scene.sheets.empty()) return;
  const std::vector<Row> rows = read_rows(photo, region, scene.fit.bands);
  if (rows.empty()) return;
  int narrowest = kWidest;
  double noise = 0.0, columns = 0.0, neighbours = 0.0, pairs = 0.0;
  for (const Row& row : rows) {
    narrowest = std::min(narrowest, row.width);
    noise += row.noise * row.width;
    columns += row.width;
    for (int i = 0; i + 1 < row.width; ++i) {
      if (!row.usable[i] || !row.usable[i + 1]) continue;
      neighbours += row.value[i] * row.value[i + 1];
      pairs += 1.0;
    }
  }
  noise /= columns;
  // Noise alone would leave 0 +- noise / sqrt(pairs) between neighbours, model error up to its square.
  const double of_errors = scene.fit.model_error * scene.fit.model_error;
  if (!(neighbours / pairs > std::max(of_errors, kTextureClear * noise / std::sqrt(pairs)))) return;

  std::vector<int> lags;
  for (const int lag : kLags)
    if (3 * lag <= narrowest) lags.push_back(lag);
  const std::vector<double> all = pooled(rows, std::min(narrowest - 1, 2 * lags.back()));
  for (const Row& row : rows) {
    std::vector<double> by_distance(row.width, 0.0);
    std::copy_n(all.begin(), std::min<std::size_t>(all.size(), row.width), by_distance.begin());
    by_distance[0] += std::max(0.0, row.noise - noise);
    stretches_.push_back(stretch_of(row, lags, by_distance, scene.fit.model_error, weight));
  }
  // A noisy covariance would weigh lags by chance, and those most that chance has made small: what the rays
  // found with it would have takes its place.
  const Views seen = views(scene);
  for (std::size_t s = 0; s < rows.size(); ++s) residuals_ += stretches_[s].residuals;
  const Solution first = solve(seen);
  const sim::Rays found{std::exp(first.ln_contrast), std::exp(first.ln_width)};
  residuals_ = 0;
  for (std::size_t s = 0; s < rows.size(); ++s) {
    std::vector<double> by_distance(rows[s].width, 0.0);
    for (int d = 0; seen[s] && d < rows[s].width; ++d)
      by_distance[d] = sim::ray_log_covariance(found, seen[s]->smear_km2, d * seen[s]->km_per_px);
    by_distance[0] += std::max(rows[s].noise, 1e-6 * by_distance[0]);
    stretches_[s] = stretch_of(rows[s], lags, by_distance, scene.fit.model_error, weight);
    residuals_ += stretches_[s].residuals;
  }
}

TextureStatistic::Views TextureStatistic::views(const sim::Scene& scene) const {
  Views all;
  for (const Stretch& stretch : stretches_)
    all.push_back(sheet_in_view(scene, scene.sheets[sheet_], stretch.x_px, stretch.y_px));
  return all;
}

std::vector<double> TextureStatistic::residual_of(const Views& views, double ln_contrast,
                                                  double ln_width) const {
  const sim::Rays rays{std::exp(ln_contrast), std::exp(ln_width)};
  std::vector<double> residual;
  residual.reserve(residuals_);
  std::vector<double> covariance;
  for (std::size_t s = 0; s < stretches_.size(); ++s) {
    const Stretch& stretch = stretches_[s];
    covariance.assign(stretch.pixels, 0.0);
    // Where no sheet is in view, no rays are either.
    if (views[s])
      for (std::size_t d = 0; d < stretch.pixels; ++d)
        covariance[d] =
            sim::ray_log_covariance(rays, views[s]->smear_km2, static_cast<double>(d) * views[s]->km_per_px);
    std::vector<double> left(stretch.lags);
    for (std::size_t k = 0; k < stretch.lags; ++k) {
      double model = stretch.noise_response[k];
      for (std::size_t d = 0; d < stretch.pixels; ++d)
        model += stretch.distance_response[k * stretch.pixels + d] * covariance[d];
      left[k] = stretch.seen[k] - model;
    }
    for (std::size_t r = 0; r < stretch.residuals; ++r) {
      double sum = 0.0;
      for (std::size_t k = 0; k < stretch.lags; ++k) sum += stretch.whitening[r * stretch.lags + k] * left[k];
      residual.push_back(sum);
    }
  }
  return residual;
}

/// By the logarithms of contrast and width.
std::array<std::vector<double>, 2> TextureStatistic::slopes(const Views& views,
                                                            const std::array<double, 2>& at) const {
  std::array<std::vector<double>, 2> slope;
  for (int j = 0; j < 2; ++j) {
    const double c = j == 0 ? kTextureStep : 0.0, w = j == 1 ? kTextureStep : 0.0;
    slope[j] = residual_of(views, at[0] + c, at[1] + w);
    const std::vector<double> less = residual_of(views, at[0] - c, at[1] - w);
    for (std::size_t k = 0; k < less.size(); ++k)
      slope[j][k] = (slope[j][k] - less[k]) / (2.0 * kTextureStep);
  }
  return slope;
}

Eigen::Vector2d TextureStatistic::gradient(const Views& views, const std::array<double, 2>& at) const {
  const std::vector<double> residual = residual_of(views, at[0], at[1]);
  const std::array<std::vector<double>, 2> slope = slopes(views, at);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < residual.size(); ++k)
    sum += Eigen::Vector2d(slope[0][k], slope[1][k]) * residual[k];
  return sum;
}

/// Levenberg and Marquardt in two numbers, from the best of a few starts.
TextureStatistic::Solution TextureStatistic::solve(const Views& views) const {
  const auto square = [](const std::vector<double>& r) {
    double sum = 0.0;
    for (const double x : r) sum += x * x;
    return sum;
  };
  Solution best;
  const auto try_at = [&](double ln_contrast, double ln_width) {
    Solution s{ln_contrast, ln_width, residual_of(views, ln_contrast, ln_width)};
    s.chi2 = square(s.residual);
    return s;
  };
  best.chi2 = std::numeric_limits<double>::infinity();
  double scale = 0.0;
  for (const auto& view : views)
    if (view) scale = std::max(scale, view->km_per_px);
  if (!(scale > 0.0)) scale = 1.0;
  for (const double contrast : {0.1, 0.3, 0.7, 1.3})
    for (const double pixels : {1.0, 2.0, 4.0, 8.0, 16.0, 32.0}) {
      const Solution s =
          try_at(std::log(contrast), std::clamp(std::log(pixels * scale), kLnWidth[0], kLnWidth[1]));
      if (s.chi2 < best.chi2) best = s;
    }
  constexpr int kMaxSteps = 60;
  constexpr double kSettled = 1e-10;
  double damping = 1e-3;
  for (int step = 0; step < kMaxSteps; ++step) {
    const std::array<std::vector<double>, 2> slope = slopes(views, {best.ln_contrast, best.ln_width});
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < best.residual.size(); ++k) {
      const Eigen::Vector2d row(slope[0][k], slope[1][k]);
      information += row * row.transpose();
      gradient += row * best.residual[k];
    }
    const Eigen::Matrix2d own = (information / weight_).inverse();
    for (int j = 0; j < 2; ++j) best.variance[j] = std::isfinite(own(j, j)) ? own(j, j) : 0.0;
    bool better = false;
    double moved = 0.0;
    while (!better && damping < 1e12) {
      Eigen::Matrix2d damped = information;
      damped.diagonal() *= 1.0 + damping;
      damped.diagonal().array() += 1e-300;
      const Eigen::Vector2d by = -damped.ldlt().solve(gradient);
      Solution next = try_at(std::clamp(best.ln_contrast + by(0), kLnContrast[0], kLnContrast[1]),
                             std::clamp(best.ln_width + by(1), kLnWidth[0], kLnWidth[1]));
      better = next.chi2 < best.chi2;
      if (better) {
        moved = std::hypot(next.ln_contrast - best.ln_contrast, next.ln_width - best.ln_width);
        std::copy(best.variance, best.variance + 2, next.variance);
        best = std::move(next);
        damping *= 0.1;
      } else {
        damping *= 10.0;
        if (by.norm() < kSettled) break;
      }
    }
    if (!better || moved < kSettled) break;
  }
  return best;
}

void TextureStatistic::evaluate(const StatisticInput& input, double* residual, double* jacobian) const {
  if (residuals_ == 0) return;
  const Views seen = views(input.scene);
  const Solution solution = solve(seen);
  std::copy(solution.residual.begin(), solution.residual.end(), residual);
  if (jacobian == nullptr) return;
  const std::size_t p = input.light.free;
  std::fill_n(jacobian, residuals_ * p, 0.0);
  const auto same = [&](const Views& a) {
    for (std::size_t s = 0; s < a.size(); ++s)
      if (a[s].has_value() != seen[s].has_value() ||
          (a[s] && (a[s]->km_per_px != seen[s]->km_per_px || a[s]->smear_km2 != seen[s]->smear_km2)))
        return false;
    return true;
  };
  // Contrast and width stay where the gradient g of chi2 / 2 by them is 0: they move by -H^-1 dg / d number.
  const std::array<double, 2> at = {solution.ln_contrast, solution.ln_width};
  Eigen::Matrix2d hessian;
  for (int j = 0; j < 2; ++j) {
    std::array<double, 2> high = at, low = at;
    high[j] += kWideStep;
    low[j] -= kWideStep;
    hessian.col(j) = (gradient(seen, high) - gradient(seen, low)) / (2.0 * kWideStep);
  }
  const std::array<std::vector<double>, 2> by_rays = slopes(seen, at);
  for (std::size_t n = 0; n < input.numbers.size(); ++n) {
    const sim::ParameterId& number = input.numbers[n];
    if (shapes_a_profile(number)) continue;
    const double step = kWideStep * std::max(1.0, std::abs(*sim::number_at(input.scene, number)));
    sim::Scene more = input.scene, less = input.scene;
    *sim::number_at(more, number) += step;
    *sim::number_at(less, number) -= step;
    const Views above = views(more), below = views(less);
    if (same(above) && same(below)) continue;
    const std::vector<double> high = residual_of(above, at[0], at[1]), low = residual_of(below, at[0], at[1]);
    const Eigen::Vector2d rays =
        -hessian.fullPivLu().solve(gradient(above, at) - gradient(below, at)) / (2.0 * step);
    for (std::size_t k = 0; k < residuals_; ++k) {
      const double by_number =
          (high[k] - low[k]) / (2.0 * step) + by_rays[0][k] * rays(0) + by_rays[1][k] * rays(1);
      for (std::size_t j = 0; j < p; ++j)
        jacobian[k * p + j] +=
            by_number * (input.slopes.empty() ? (n == j ? 1.0 : 0.0) : input.slopes[n * p + j]);
    }
  }
}

std::vector<Statistic::Solved> TextureStatistic::solved(const sim::Scene& scene) const {
  if (residuals_ == 0) return {};
  const Solution s = solve(views(scene));
  const double contrast = std::exp(s.ln_contrast), width = std::exp(s.ln_width);
  // An error as large as the number itself is none.
  const auto sigma = [](double value, double variance_of_log) {
    return variance_of_log < 1.0 ? value * std::sqrt(variance_of_log) : 0.0;
  };
  return {{"rays.contrast", contrast, sigma(contrast, s.variance[0])},
          {"rays.width_km", width, sigma(width, s.variance[1])}};
}

}  // namespace vegard::fit
