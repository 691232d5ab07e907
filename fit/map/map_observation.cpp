#include "fit/map/map_observation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "fit/photo/grey_light.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/dense_solvers.h"
#include "sim/base/number/quantile.h"
#include "sim/base/parallel.h"
#include "sim/render/film.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sky/night_sky.h"

namespace vegard::fit {
namespace {

constexpr double kBoxVariance = 1.0 / 12.0;  // of a cell about its middle
constexpr double kTownHeight_deg = 8.0;
constexpr double kClipped =
    0.9;  // of the file's white: what is not usable above was clipped, or masked there
constexpr double kSpread_px = 2.0;  // of what was clipped

/// The light of a window of cells, and its variance about a surface.
using LightAndVariance = std::pair<double, double>;

/// The quadratic surface through the 7 x 7 cells about each: noise that a camera or JPEG has smoothed counts
/// in full in what is left of it. It is a sum of orthogonal polynomials over the window: 1, x, y, x y,
/// x^2 - m, y^2 - m.
class QuadraticSurface {
 public:
  QuadraticSurface() {
    for (int dy = -kReach; dy <= kReach; ++dy)
      for (int dx = -kReach; dx <= kReach; ++dx)
        for (int t = 0; t < kTerms; ++t) squares_[t] += std::pow(terms(dx, dy)[t], 2);
  }

  /// Returns every second window of a channel that is used throughout, by their light.
  std::vector<LightAndVariance> windows(const sim::FilmGeometry& film, const MapLight& data,
                                        const std::vector<std::uint8_t>& used, int channel) const {
    std::vector<LightAndVariance> found;
    for (int row = kReach; row + kReach < film.rows; row += 2)
      for (int column = kReach; column + kReach < film.columns; column += 2) {
        double sum_of_squares = 0.0;
        std::array<double, kTerms> sums{};
        bool whole = true;
        for (int dy = -kReach; dy <= kReach && whole; ++dy)
          for (int dx = -kReach; dx <= kReach; ++dx) {
            const std::size_t i =
                (static_cast<std::size_t>(row + dy) * film.columns + column + dx) * 3 + channel;
            whole = whole && used[i] != 0;
            const double v = data[i];
            const std::array<double, kTerms> f = terms(dx, dy);
            for (int t = 0; t < kTerms; ++t) sums[t] += v * f[t];
            sum_of_squares += v * v;
          }
        if (!whole) continue;
        double left = sum_of_squares;
        for (int t = 0; t < kTerms; ++t) left -= sums[t] * sums[t] / squares_[t];
        found.emplace_back(sums[0] / kWindow, std::max(0.0, left) / (kWindow - kTerms));
      }
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  static constexpr int kReach = 3, kSide = 2 * kReach + 1, kWindow = kSide * kSide, kTerms = 6;
  static constexpr double kSquare = kReach * (kReach + 1) / 3.0;  // m, the mean of x^2

  static std::array<double, kTerms> terms(int dx, int dy) {
    return {1.0,
            static_cast<double>(dx),
            static_cast<double>(dy),
            static_cast<double>(dx * dy),
            dx * dx - kSquare,
            dy * dy - kSquare};
  }

  std::array<double, kTerms> squares_{};  ///< sums of the terms' squares over the window
};

/// A variance that is linear in the light.
struct NoiseByLight {
  double floor = 0.0, slope = 0.0;
};

/// Returns the mean of the variances below twice their median: rays are no quadratic surfaces.
double trimmed_mean(std::vector<double> variances) {
  const double bound = 2.0 * sim::quantile(variances, 0.5);
  double sum = 0.0;
  int below = 0;
  for (const double v : variances)
    if (v <= bound) {
      sum += v;
      ++below;
    }
  return sum / std::max(1, below);
}

/// Fits the line through the variances of classes of light.
NoiseByLight noise_by_light(const std::vector<LightAndVariance>& windows) {
  constexpr int kClasses = 12;
  double s0 = 0.0, s1 = 0.0, s2 = 0.0, t0 = 0.0, t1 = 0.0;
  for (int k = 0; k < kClasses; ++k) {
    const std::size_t first = windows.size() * k / kClasses, last = windows.size() * (k + 1) / kClasses;
    if (last - first < 8) continue;
    std::vector<double> variances;
    double mean = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      variances.push_back(windows[i].second);
      mean += windows[i].first / (last - first);
    }
    const double variance = trimmed_mean(variances);
    const double w = 1.0 / std::pow(variance + 1e-12, 2);
    s0 += w;
    s1 += w * mean;
    s2 += w * mean * mean;
    t0 += w * variance;
    t1 += w * variance * mean;
  }
  const double det = s0 * s2 - s1 * s1;
  NoiseByLight noise;
  noise.slope = det > 0.0 ? std::max(0.0, (s0 * t1 - s1 * t0) / det) : 0.0;
  noise.floor = s0 > 0.0 ? std::max((t0 - noise.slope * s1) / s0, 0.0) : 0.0;
  return noise;
}

}  // namespace

double dot(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * b[i];
  return sum;
}

MapObservation::MapObservation(const sim::Scene& scene, const Photo& photo,
                               const MapObservationOptions& options)
    : scene_(scene), threads_(options.threads), stop_(options.stop) {
  const int b = options.pixels_per_cell;
  double widest_px = 0.0;
  for (int line = 0; line < static_cast<int>(scene.emission.lines.size()); ++line)
    widest_px = std::max(widest_px, sim::blur_sigma_px(scene, line));
  const int margin =
      options.margin_cells > 0 ? options.margin_cells : static_cast<int>(std::ceil(3.0 * widest_px / b)) + 1;
  film_.cell_width_px = film_.cell_height_px = b;
  film_.columns = scene.camera.width / b + 2 * margin;
  film_.rows = scene.camera.height / b + 2 * margin;
  film_.x0_px = film_.y0_px = -margin * b;
  for (const sim::Vector3& rgb : sim::line_colours(scene))
    colour_.push_back({rgb[0] * 1e-3, rgb[1] * 1e-3, rgb[2] * 1e-3});
  for (std::size_t line = 0; line < scene.emission.lines.size(); ++line) {
    const double sigma = sim::blur_sigma_px(scene, static_cast<int>(line)) / b;
    const sim::BlurKernel kernel = sim::gaussian_kernel(std::sqrt(sigma * sigma + kBoxVariance));
    blur_.push_back({kernel, kernel});
  }
  clips_ = !keeps_negative_light(photo);
  bin(photo, options);
  for (const int c : {2, 0, 1})
    for (std::size_t cell = 0; cell < cells(); ++cell)
      if (sigma_[cell * 3 + c] > 0.0f) {
        reference_ = c;
        break;
      }
  make_sky_basis();
  leave_out({});
}

void MapObservation::bin(const Photo& photo, const MapObservationOptions& options) {
  const int b = options.pixels_per_cell;
  data_.assign(cells() * 3, 0.0f);
  sigma_.assign(cells() * 3, 0.0f);
  noise_.assign(cells() * 3, 0.0f);
  const sim::CameraView<double> view = sim::camera_view(scene_.camera);
  const double lowest = std::sin(options.lowest_elevation_deg * sim::kRadiansPerDegree);
  const auto& roi = scene_.fit.roi_px;
  const bool whole = roi[2] == 0 || roi[3] == 0;
  std::vector<std::uint8_t> used(cells() * 3, 0), clipped(cells(), 0);
  for (int row = 0; row < film_.rows; ++row)
    for (int column = 0; column < film_.columns; ++column) {
      const int x0 = static_cast<int>(film_.x0_px) + column * b, y0 = static_cast<int>(film_.y0_px) + row * b;
      if (x0 < 0 || y0 < 0 || x0 + b > scene_.camera.width || y0 + b > scene_.camera.height) continue;
      if (!whole && (x0 < roi[0] || y0 < roi[1] || x0 + b > roi[0] + roi[2] || y0 + b > roi[1] + roi[3]))
        continue;
      double enu[3];
      if (!sim::enu_of_cell(view, film_, row, column, enu) || enu[2] < lowest) continue;
      const std::size_t cell = static_cast<std::size_t>(row) * film_.columns + column;
      for (int c = 0; c < 3; ++c) {
        double sum = 0.0, whole_sum = 0.0;
        int count = 0;
        for (int y = y0; y < y0 + b; ++y)
          for (int x = x0; x < x0 + b; ++x) {
            const std::size_t i = photo.linear.index(x, y, c);
            whole_sum += photo.linear.data[i];
            if (photo.usable[i] == 0) {
              if (photo.linear.data[i] > kClipped) clipped[cell] = 1;
              continue;
            }
            sum += photo.linear.data[i];
            ++count;
          }
        data_[cell * 3 + c] = static_cast<float>(whole_sum / (b * b));  // it can be looked at, if no more
        if (2 * count < b * b || !has_channel(scene_, c)) continue;
        data_[cell * 3 + c] = static_cast<float>(sum / count);
        used[cell * 3 + c] = 1;
      }
    }
  leave_out_beside(clipped, used);
  estimate_noise(photo, options, used);
  want_light_around();
}

/// Marks the cells whose light must be computed: the blur brings it from as far outside as it reaches.
void MapObservation::want_light_around() {
  int reach = 0;
  for (const sim::PlaneBlur& blur : blur_) reach = std::max(reach, blur.down.radius());
  wanted_.assign(cells(), 0);
  for (int row = 0; row < film_.rows; ++row)
    for (int column = 0; column < film_.columns; ++column) {
      const std::size_t i = (static_cast<std::size_t>(row) * film_.columns + column) * 3;
      if (sigma_[i] + sigma_[i + 1] + sigma_[i + 2] == 0.0f) continue;
      for (int y = std::max(0, row - reach); y <= std::min(film_.rows - 1, row + reach); ++y)
        for (int x = std::max(0, column - reach); x <= std::min(film_.columns - 1, column + reach); ++x)
          wanted_[static_cast<std::size_t>(y) * film_.columns + x] = 1;
    }
}

/// Takes cells out of use, in all channels, that stand beside a clipped one: demosaicing and compression have
/// spread what was clipped.
void MapObservation::leave_out_beside(const std::vector<std::uint8_t>& clipped,
                                      std::vector<std::uint8_t>& used) {
  const int reach = std::max(1, static_cast<int>(std::ceil(kSpread_px / film_.cell_width_px)));
  for (int row = 0; row < film_.rows; ++row)
    for (int column = 0; column < film_.columns; ++column) {
      if (clipped[static_cast<std::size_t>(row) * film_.columns + column] == 0) continue;
      for (int y = std::max(0, row - reach); y <= std::min(film_.rows - 1, row + reach); ++y)
        for (int x = std::max(0, column - reach); x <= std::min(film_.columns - 1, column + reach); ++x)
          for (int c = 0; c < 3; ++c) used[(static_cast<std::size_t>(y) * film_.columns + x) * 3 + c] = 0;
    }
}

void MapObservation::estimate_noise(const Photo& photo, const MapObservationOptions& options,
                                    const std::vector<std::uint8_t>& used) {
  const double cell_pixels = film_.cell_width_px * film_.cell_height_px;
  const QuadraticSurface surface;
  for (int c = 0; c < 3; ++c) {
    const std::vector<LightAndVariance> windows = surface.windows(film_, data_, used, c);
    if (windows.empty()) continue;
    const double dark = windows[windows.size() / 20].first;
    const NoiseByLight noise = noise_by_light(windows);
    for (std::size_t cell = 0; cell < cells(); ++cell) {
      const std::size_t i = cell * 3 + c;
      if (used[i] == 0) continue;
      const double above = std::max(0.0, data_[i] - dark);
      const double step = code_step(photo, data_[i]);
      // What compression put upon a whole block is not seen in the windows, and comes to it.
      const double variance =
          std::max(noise.floor + noise.slope * data_[i], step * step / (12.0 * cell_pixels)) +
          std::pow(photo.block_error[c] * step, 2);
      noise_[i] = static_cast<float>(std::sqrt(variance));
      sigma_[i] = static_cast<float>(std::sqrt(variance + std::pow(options.model_error * above, 2)));
    }
  }
}

void MapObservation::make_sky_basis() {
  // Level; airglow by airmass, and what its layer and the air make of that; a town's or the twilight's glow
  // by its height, and round the horizon as a mean and two waves; both ways along the horizon.
  sky_basis_.assign(cells() * kSkyTerms, 0.0f);
  const sim::CameraView<double> view = sim::camera_view(scene_.camera);
  const double observer = scene_.site.altitude_m * 1e-3;
  for (int row = 0; row < film_.rows; ++row)
    for (int column = 0; column < film_.columns; ++column) {
      double enu[3];
      if (!sim::enu_of_cell(view, film_, row, column, enu)) continue;
      const std::size_t cell = static_cast<std::size_t>(row) * film_.columns + column;
      const double elevation = std::asin(std::clamp(enu[2], -1.0, 1.0)) / sim::kRadiansPerDegree;
      float* f = &sky_basis_[cell * kSkyTerms];
      f[0] = 1.0f;
      f[1] = static_cast<float>(sim::van_rhijn(std::max(0.0, enu[2]), 97.0, observer) - 1.0);
      f[2] = static_cast<float>(std::exp(-std::max(0.0, elevation) / kTownHeight_deg));
      f[3] = static_cast<float>(enu[0]);
      f[4] = static_cast<float>(enu[1]);
      f[5] = static_cast<float>(f[2] * enu[0]);
      f[6] = static_cast<float>(f[2] * enu[1]);
      f[7] = static_cast<float>(f[2] * (enu[0] * enu[0] - enu[1] * enu[1]));
      f[8] = static_cast<float>(f[2] * enu[0] * enu[1]);
      f[9] = f[1] * f[1];
    }
}

void MapObservation::leave_out(const std::vector<std::uint8_t>& left_out) {
  weight_.assign(cells() * 3, 0.0f);
  for (std::vector<std::size_t>& channel : used_) channel.clear();
  for (std::size_t i = 0; i < weight_.size(); ++i)
    if (sigma_[i] > 0.0f && (left_out.empty() || left_out[i / 3] == 0)) {
      weight_[i] = 1.0f / (sigma_[i] * sigma_[i]);
      used_[i % 3].push_back(i);
    }
  values_ = used_[0].size() + used_[1].size() + used_[2].size();
  factor_sky();
}

void MapObservation::factor_sky() {
  // A sky that is as bright as the picture's darkest part, give or take all of it: a prior of next to no
  // weight that keeps terms which the region cannot tell apart from growing against each other.
  for (int c = 0; c < 3; ++c) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(kSkyTerms, kSkyTerms);
    std::vector<double> light;
    for (std::size_t cell = 0; cell < cells(); ++cell) {
      const double w = weight_[cell * 3 + c];
      if (w == 0.0) continue;
      light.push_back(data_[cell * 3 + c]);
      const float* f = &sky_basis_[cell * kSkyTerms];
      for (std::size_t i = 0; i < kSkyTerms; ++i)
        for (std::size_t j = 0; j <= i; ++j) normal(i, j) += w * f[i] * f[j];
    }
    if (light.empty()) {
      sky_inverse_[c].assign(static_cast<std::size_t>(kSkyTerms) * kSkyTerms, 0.0);
      continue;
    }
    const double dark = std::max(sim::quantile(light, 0.1), 1e-9);
    for (std::size_t i = 0; i < kSkyTerms; ++i) normal(i, i) += i == 0 ? 0.0 : 1.0 / (dark * dark);
    const Eigen::MatrixXd full = normal.selfadjointView<Eigen::Lower>();
    const Eigen::MatrixXd inverse = sim::inverse_of(full);
    sky_inverse_[c].assign(inverse.data(), inverse.data() + inverse.size());
  }
}

void MapObservation::look_at(const sim::Site& home, const sim::GroundGrid& grid,
                             const std::vector<double>& energies_kev, double rates_at_flux_mw_m2,
                             double altitude_scale, const sim::ElectronSpectrum& spectrum) {
  light_ = std::make_shared<sim::GroundLight>(scene_, home, grid, film_, wanted_, energies_kev,
                                              rates_at_flux_mw_m2, threads_, altitude_scale, spectrum, stop_);
}

void MapObservation::set_light(std::shared_ptr<const sim::ModeRates> rates,
                               const std::vector<double>& modes) {
  rates_ = std::move(rates);
  set_modes(modes);
}

void MapObservation::forward(const std::vector<float>& map, const std::vector<float>& rate,
                             MapLight& out) const {
  std::vector<float> rayleighs;
  light_->forward(map, rate, rayleighs);
  const std::size_t lines = colour_.size();
  std::vector<float> planes(rayleighs.size()), blurred(rayleighs.size());
  for (std::size_t i = 0; i < cells(); ++i)
    for (std::size_t l = 0; l < lines; ++l) planes[l * cells() + i] = rayleighs[i * lines + l];
  sim::blur_window(planes.data(), film_.rows, film_.columns, blur_, {0, 0, film_.rows, film_.columns},
                   blurred.data(), threads_);
  out.assign(cells() * 3, 0.0f);
  for (std::size_t i = 0; i < cells(); ++i)
    for (int c = 0; c < 3; ++c) {
      double sum = 0.0;
      for (std::size_t l = 0; l < lines; ++l) sum += colour_[l][c] * blurred[i * lines + l];
      out[i * 3 + c] = static_cast<float>(gain[c] * sum);
    }
}

void MapObservation::add_adjoint(const MapLight& light, std::vector<float>& map) const {
  const std::size_t lines = colour_.size();
  std::vector<float> planes(cells() * lines), blurred(cells() * lines);
  for (std::size_t i = 0; i < cells(); ++i)
    for (std::size_t l = 0; l < lines; ++l) {
      double sum = 0.0;
      for (int c = 0; c < 3; ++c) sum += gain[c] * colour_[l][c] * light[i * 3 + c];
      planes[l * cells() + i] = static_cast<float>(sum);
    }
  // Kernels are symmetric and there is nothing outside of the film: the blur is its own adjoint.
  sim::blur_window(planes.data(), film_.rows, film_.columns, blur_, {0, 0, film_.rows, film_.columns},
                   blurred.data(), threads_);
  light_->add_adjoint(blurred, map);
}

template <class Value>
MapObservation::Sky MapObservation::solve_sky(int channel, const Value& weighted) const {
  Sky right{}, sky{};
  for (const std::size_t i : used_[channel]) {
    const double value = weighted(i);
    const float* f = &sky_basis_[i / 3 * kSkyTerms];
    for (std::size_t j = 0; j < kSkyTerms; ++j) right[j] += value * f[j];
  }
  for (std::size_t i = 0; i < kSkyTerms; ++i)
    for (std::size_t j = 0; j < kSkyTerms; ++j) sky[i] += sky_inverse_[channel][i * kSkyTerms + j] * right[j];
  return sky;
}

double MapObservation::sky_at(std::size_t cell, const Sky& sky) const {
  const float* f = &sky_basis_[cell * kSkyTerms];
  double sum = 0.0;
  for (std::size_t j = 0; j < kSkyTerms; ++j) sum += sky[j] * f[j];
  return sum;
}

double MapObservation::residual(const MapLight& light, MapLight& residual) {
  residual.assign(cells() * 3, 0.0f);
  std::array<double, 3> chi2{};
  sim::parallel_for(3, threads_, [&](std::size_t channel, int) {
    const Sky sky = solve_sky(static_cast<int>(channel), [&](std::size_t i) {
      return weight_[i] * (static_cast<double>(data_[i]) - light[i]);
    });
    sky_[channel] = sky;
    double sum = 0.0;
    for (const std::size_t i : used_[channel]) {
      const double model = light[i] + sky_at(i / 3, sky);
      double r = model - data_[i];
      // Stored as none, it is none or less.
      if (clips_ && model < 0.0 && data_[i] <= noise_[i]) r = -data_[i];
      sum += weight_[i] * r * r;
      residual[i] = static_cast<float>(weight_[i] * r);
    }
    chi2[channel] = sum;
  });
  return chi2[0] + chi2[1] + chi2[2];
}

MapLight MapObservation::sky() const {
  MapLight light(cells() * 3);
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = static_cast<float>(sky_at(i / 3, sky_[i % 3]));
  return light;
}

void MapObservation::take_sky_away(const MapLight& light, MapLight& weighted) const {
  weighted.assign(cells() * 3, 0.0f);
  sim::parallel_for(3, threads_, [&](std::size_t channel, int) {
    const Sky sky = solve_sky(static_cast<int>(channel),
                              [&](std::size_t i) { return static_cast<double>(weight_[i]) * light[i]; });
    for (const std::size_t i : used_[channel])
      weighted[i] = static_cast<float>(weight_[i] * (light[i] - sky_at(i / 3, sky)));
  });
}

}  // namespace vegard::fit
