#include "fit/map/map_observation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "fit/photo/grey_light.h"
#include "sim/base/number/constants.h"
#include "sim/base/number/quantile.h"
#include "sim/base/parallel.h"
#include "sim/render/film.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/line_colours.h"

namespace vegard::fit {
namespace {

constexpr double kBoxVariance = 1.0 / 12.0;  // of a cell about its middle
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
  smooth_ = SmoothSky(scene_, film_);
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

void MapObservation::leave_out(const std::vector<std::uint8_t>& left_out) {
  weight_.assign(cells() * 3, 0.0f);
  values_ = 0;
  for (std::size_t i = 0; i < weight_.size(); ++i)
    if (sigma_[i] > 0.0f && (left_out.empty() || left_out[i / 3] == 0)) {
      weight_[i] = 1.0f / (sigma_[i] * sigma_[i]);
      ++values_;
    }
  smooth_.weigh(weight_, data_);
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
  if (&rate == &light_->rate())
    light_->forward(map, rayleighs_);
  else
    light_->forward(map, rate, rayleighs_);
  const std::size_t lines = colour_.size(), count = cells();
  planes_.resize(rayleighs_.size());
  blurred_.resize(rayleighs_.size());
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t l = 0; l < lines; ++l) planes_[l * count + i] = rayleighs_[i * lines + l];
  sim::blur_window(planes_.data(), film_.rows, film_.columns, blur_, {0, 0, film_.rows, film_.columns},
                   blurred_.data(), threads_);
  out.resize(count * 3);
  for (std::size_t i = 0; i < count; ++i) {
    double sum[3] = {};
    for (std::size_t l = 0; l < lines; ++l)
      for (int c = 0; c < 3; ++c) sum[c] += colour_[l][c] * blurred_[i * lines + l];
    for (int c = 0; c < 3; ++c) out[i * 3 + c] = static_cast<float>(gain[c] * sum[c]);
  }
}

void MapObservation::add_adjoint(const MapLight& light, std::vector<float>& map) const {
  const std::size_t lines = colour_.size();
  const std::size_t count = cells();
  planes_.resize(count * lines);
  blurred_.resize(count * lines);
  for (std::size_t l = 0; l < lines; ++l) {
    const double factor[3] = {gain[0] * colour_[l][0], gain[1] * colour_[l][1], gain[2] * colour_[l][2]};
    for (std::size_t i = 0; i < count; ++i) {
      const float* of_cell = &light[i * 3];
      planes_[l * count + i] =
          static_cast<float>(factor[0] * of_cell[0] + factor[1] * of_cell[1] + factor[2] * of_cell[2]);
    }
  }
  // Kernels are symmetric and there is nothing outside of the film: the blur is its own adjoint.
  sim::blur_window(planes_.data(), film_.rows, film_.columns, blur_, {0, 0, film_.rows, film_.columns},
                   blurred_.data(), threads_);
  light_->add_adjoint(blurred_, map);
}

double MapObservation::residual(const MapLight& light, MapLight& residual) {
  residual.assign(cells() * 3, 0.0f);
  sky_ = smooth_.solve(threads_, [&](std::size_t i) { return weight_[i] * (data_[i] - light[i]); });
  std::array<double, SmoothSky::kShares> chi2{};
  smooth_.each_weighted(threads_, sky_, [&](std::size_t share, std::size_t i, float sky) {
    const float model = light[i] + sky;
    float r = model - data_[i];
    // Stored as none, it is none or less.
    if (clips_ && model < 0.0f && data_[i] <= noise_[i]) r = -data_[i];
    residual[i] = weight_[i] * r;
    chi2[share] += static_cast<double>(residual[i]) * r;
  });
  double sum = 0.0;
  for (const double part : chi2) sum += part;
  return sum;
}

void MapObservation::take_sky_away(const MapLight& light, MapLight& weighted) const {
  weighted.assign(cells() * 3, 0.0f);
  const SmoothSky::Coefficients of_light =
      smooth_.solve(threads_, [&](std::size_t i) { return weight_[i] * light[i]; });
  smooth_.each_weighted(threads_, of_light, [&](std::size_t, std::size_t i, float sky) {
    weighted[i] = weight_[i] * (light[i] - sky);
  });
}

}  // namespace vegard::fit
