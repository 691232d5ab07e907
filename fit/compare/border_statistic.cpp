#include "fit/compare/border_statistic.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/measure/noise_model.h"

namespace vegard::fit {
namespace {

constexpr double kBorderScale = 2.0;  ///< rows
constexpr int kBorderReach = 6;
constexpr double kFaint = 0.1;  ///< of the brightest row
constexpr int kFarther = 3, kMinRows = 10;
constexpr double kBorderClear = 5.0;  ///< standard deviations

/// Of the row at the distance k below: light above less light below, 1 for a step of height 1.
double fall_weight(int k) {
  static const std::array<double, 2 * kBorderReach + 1> weights = [] {
    std::array<double, 2 * kBorderReach + 1> w{};
    double sum = 0.0;
    for (int j = -kBorderReach; j <= kBorderReach; ++j) {
      w[j + kBorderReach] = -j * std::exp(-0.5 * j * j / (kBorderScale * kBorderScale));
      if (j < 0) sum += w[j + kBorderReach];
    }
    for (double& x : w) x /= sum;
    return w;
  }();
  return weights[k + kBorderReach];
}

struct Square {
  double value = 0.0, slope = 0.0;
};

/// Of a fall; of one with noise to come, its expectation: (f^2 + s^2) Phi(f / s) + f s phi(f / s).
Square square_of_fall(double fall, double noise) {
  if (noise <= 0.0) return fall > 0.0 ? Square{fall * fall, 2.0 * fall} : Square{};
  const double t = fall / noise;
  const double below = 0.5 * std::erfc(-t * std::sqrt(0.5)),
               density = std::exp(-0.5 * t * t) / std::sqrt(8.0 * std::atan(1.0));
  return {(fall * fall + noise * noise) * below + fall * noise * density,
          2.0 * (fall * below + noise * density)};
}

double fall_at(const std::vector<double>& green, int row) {
  double fall = 0.0;
  for (int k = -kBorderReach; k <= kBorderReach; ++k) fall += fall_weight(k) * green[row + k];
  return fall;
}

}  // namespace

std::vector<double> BorderStatistic::green_of(int band, const std::vector<double>& light) const {
  std::vector<double> green(data_.rows);
  for (int r = 0; r < data_.rows; ++r) green[r] = light[data_.index(band, r, 1)];
  return green;
}

BorderStatistic::BorderStatistic(const Profile& data, const std::vector<double>& sigma, double weight)
    : data_(data), weight_(weight) {
  const double sky = sky_level(data)[1];
  const int rows = data.rows;
  for (int b = 0; b < data.bands; ++b) {
    std::vector<double> green = green_of(b, data.mean), own(rows), all(rows);
    std::vector<bool> usable(rows);
    int brightest = -1;
    for (int r = 0; r < rows; ++r) {
      const std::size_t i = data.index(b, r, 1);
      usable[r] = data.count[i] > 0 && sigma[i] > 0.0;
      own[r] = usable[r] && std::isfinite(data.standard_error[i]) ? data.standard_error[i] : 0.0;
      all[r] = usable[r] ? sigma[i] : 0.0;
      if (usable[r] && (brightest < 0 || green[r] > green[brightest])) brightest = r;
      green[r] -= sky;
    }
    if (brightest < 0) continue;
    int faint = brightest;
    while (faint + 1 < rows && !(usable[faint] && green[faint] < kFaint * green[brightest])) ++faint;
    const int farther = kFarther * std::max(kMinRows, faint - brightest);

    Band band;
    band.band = b;
    double clearest = 0.0;
    const int first = std::max(kBorderReach, brightest - farther),
              last = std::min(rows - 1 - kBorderReach, faint + farther);
    for (int r = first; r <= last; ++r) {
      double own_square = 0.0, all_square = 0.0;
      bool whole = true;
      for (int k = -kBorderReach; k <= kBorderReach; ++k) {
        whole = whole && usable[r + k];
        own_square += std::pow(fall_weight(k) * own[r + k], 2);
        all_square += std::pow(fall_weight(k) * all[r + k], 2);
      }
      if (!whole) continue;
      band.rows.push_back(r);
      band.noise_of_fall.push_back(std::sqrt(own_square));
      clearest = std::max(clearest, fall_at(green, r) / std::sqrt(all_square));
    }
    if (clearest < kBorderClear) continue;

    const BorderRow found = border_row(band, green, false);
    double variance = 0.0, sum = 0.0, second = 0.0;
    for (int r = 0; r < rows; ++r) variance += std::pow(found.slope[r] * all[r], 2);
    for (const int r : band.rows) sum += square_of_fall(fall_at(green, r), 0.0).value;
    // Covariance of the squares of two Gaussian numbers about zero: 2 covariance^2.
    for (const int r : band.rows)
      for (const int s : band.rows) {
        if (std::abs(s - r) > 2 * kBorderReach) continue;
        double covariance = 0.0;
        for (int i = std::max(r, s) - kBorderReach; i <= std::min(r, s) + kBorderReach; ++i)
          covariance += fall_weight(i - r) * fall_weight(i - s) * own[i] * own[i];
        second += 2.0 * (r - found.row) * (s - found.row) * covariance * covariance;
      }
    band.sigma = std::sqrt(variance + std::max(0.0, second) / (sum * sum));
    if (band.sigma > 0.0) bands_.push_back(std::move(band));
  }
}

BorderStatistic::BorderRow BorderStatistic::border_row(const Band& band, const std::vector<double>& green,
                                                       bool expected) const {
  BorderRow place;
  place.slope.assign(green.size(), 0.0);
  std::vector<Square> squares;
  double sum = 0.0;
  for (std::size_t k = 0; k < band.rows.size(); ++k) {
    squares.push_back(square_of_fall(fall_at(green, band.rows[k]), expected ? band.noise_of_fall[k] : 0.0));
    sum += squares.back().value;
    place.row += band.rows[k] * squares.back().value;
  }
  if (!(sum > 0.0)) {  // no light falls anywhere: as far from a border as from any other
    place.row = 0.5 * (band.rows.front() + band.rows.back());
    return place;
  }
  place.row /= sum;
  for (std::size_t k = 0; k < band.rows.size(); ++k) {
    const int r = band.rows[k];
    for (int j = -kBorderReach; j <= kBorderReach; ++j)
      place.slope[r + j] += (r - place.row) * squares[k].slope * fall_weight(j) / sum;
  }
  return place;
}

std::vector<BorderStatistic::Border> BorderStatistic::borders(const std::vector<double>& light) const {
  std::vector<Border> all;
  for (const Band& band : bands_)
    all.push_back({band.band, border_row(band, green_of(band.band, light), false).row, band.sigma});
  return all;
}

void BorderStatistic::evaluate(const StatisticInput& input, double* residual, double* jacobian) const {
  const SolvedLight& light = input.light;
  const std::size_t p = light.free;
  for (std::size_t n = 0; n < bands_.size(); ++n) {
    const Band& band = bands_[n];
    std::vector<double> data = green_of(band.band, data_.mean);
    const std::vector<double> behind = green_of(band.band, light.behind);
    for (int r = 0; r < data_.rows; ++r) data[r] -= behind[r];
    const BorderRow seen = border_row(band, data, false),
                    model = border_row(band, green_of(band.band, light.aurora), true);
    const double per_sigma = std::sqrt(weight_) / band.sigma;
    residual[n] = (seen.row - model.row) * per_sigma;
    if (jacobian == nullptr) continue;
    std::fill_n(jacobian + n * p, p, 0.0);
    for (int r = 0; r < data_.rows; ++r) {
      if (seen.slope[r] == 0.0 && model.slope[r] == 0.0) continue;
      const std::size_t i = data_.index(band.band, r, 1);
      for (std::size_t j = 0; j < p; ++j)
        jacobian[n * p + j] -= per_sigma * (seen.slope[r] * light.behind_slope[i * p + j] +
                                            model.slope[r] * light.aurora_slope[i * p + j]);
    }
  }
}

}  // namespace vegard::fit
