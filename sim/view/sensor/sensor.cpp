#include "sim/view/sensor/sensor.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"
#include "sim/base/parallel.h"
#include "sim/view/camera/camera.h"
#include "sim/view/colour/colour_table.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/colour/radiometry.h"
#include "sim/view/sensor/filmic_tone.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::sim {
namespace {

constexpr double kMinLight = 0.01;  // of a lens, where it tells something

Vector3 pixel(const Image& rgb, int x, int y) { return {rgb.at(x, y, 0), rgb.at(x, y, 1), rgb.at(x, y, 2)}; }

bool has_mosaic(const Scene& scene) { return scene.sensor.mosaic != MosaicPattern::none; }

/// Returns one pixel's number, of light that would free so many electrons.
double number_of(const SensorScale& scale, double full_well_e, std::uint64_t seed, double electrons,
                 std::uint32_t pixel_index, std::uint32_t frame, std::uint32_t channel) {
  double charge = poisson(electrons + scale.dark_e, seed, Stream::photon_noise, pixel_index, frame, channel);
  charge = std::min(charge, full_well_e);
  if (scale.read_noise_e > 0.0) {
    const Words words = random_words(seed, Stream::read_noise, pixel_index, frame, channel);
    charge += scale.read_noise_e * normal_quantile(fine_uniform(words[0], words[1]));
  }
  const double number = std::round(scale.black_dn + charge * scale.dn_per_electron);
  return std::clamp<double>(number, 0.0, scale.largest_dn);
}

/// Returns the scene with the camera of a picture, which may have been scaled.
Scene with_size_of(const Scene& scene, const Image& image) {
  Scene sized = scene;
  sized.camera.width = image.width;
  sized.camera.height = image.height;
  return sized;
}

/// Returns the variance of a raw channel's linear value.
double raw_variance(const SensorScale& scale, double raw) {
  const double rounding_e = 1.0 / scale.dn_per_electron;
  const double variance_e = std::max(raw, 0.0) * scale.white_e + scale.dark_e +
                            scale.read_noise_e * scale.read_noise_e + rounding_e * rounding_e / 12.0;
  return variance_e / (scale.white_e * scale.white_e);
}

/// Returns the width in linear light of one step of an encoded value.
double step_at(const ToneCurve& tone, double linear, double file_step) {
  const double code =
      std::clamp(tone.encode(std::clamp(linear, 0.0, 1.0)), 0.5 * file_step, 1.0 - 0.5 * file_step);
  return tone.decode(code + 0.5 * file_step) - tone.decode(code - 0.5 * file_step);
}

/// Returns marks that are 1 where a pixel or, behind a mosaic, one that it takes from is marked.
std::vector<std::uint8_t> spread(const std::vector<std::uint8_t>& marked, int width, int height) {
  std::vector<std::uint8_t> result(marked.size(), 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
          result[static_cast<std::size_t>(y) * width + x] |= marked[static_cast<std::size_t>(v) * width + u];
  return result;
}

/// Sums of the numbers that enter a channel at a pixel.
struct Taken {
  double sum = 0.0;
  int count = 0;
};

Taken taken(const Image& mosaic, MosaicPattern pattern, int x, int y, int channel) {
  if (filter_of_pixel(pattern, x, y) == channel) return {mosaic.at(x, y, 0), 1};
  Taken t;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, mosaic.height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, mosaic.width - 1); ++u) {
      if (filter_of_pixel(pattern, u, v) != channel) continue;
      t.sum += mosaic.at(u, v, 0);
      ++t.count;
    }
  return t;
}

/// Interpolates the colours of a mosaic. `count_power` is 1 for a mean, 2 for its variance.
Image demosaiced(const Image& mosaic, MosaicPattern pattern, int count_power) {
  assert(mosaic.channels() == 1 && mosaic.width > 1 && mosaic.height > 1);
  Image rgb(mosaic.width, mosaic.height, {"R", "G", "B"});
  for (int y = 0; y < mosaic.height; ++y)
    for (int x = 0; x < mosaic.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const Taken t = taken(mosaic, pattern, x, y, c);
        rgb.at(x, y, c) = static_cast<float>(t.sum / (count_power == 1 ? t.count : t.count * t.count));
      }
  return rgb;
}

}  // namespace

Image raw_numbers(const Scene& scene, const Image& light, std::uint32_t frame, int threads) {
  const SensorScale scale = sensor_scale(scene.sensor, scene.time);
  const Matrix3 raw_of_rgb = raw_from_rgb(scene);
  const Vignetting vignetting(scene);
  const bool mosaic = has_mosaic(scene);
  Image raw(light.width, light.height,
            mosaic ? std::vector<std::string>{"raw"} : std::vector<std::string>{"R", "G", "B"});
  parallel_for(light.height, threads, [&](std::size_t row, int) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < light.width; ++x) {
      const double seen = vignetting.at(x + 0.5, y + 0.5) * scale.white_e;
      const Vector3 channels = product(raw_of_rgb, pixel(light, x, y));
      const auto index = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(light.width) +
                         static_cast<std::uint32_t>(x);
      for (int c = 0; c < raw.channels(); ++c) {
        const int filter = mosaic ? filter_of_pixel(scene.sensor.mosaic, x, y) : c;
        const double electrons = std::max(channels[filter], 0.0) * seen;
        raw.at(x, y, c) = static_cast<float>(
            number_of(scale, scene.sensor.full_well_e, scene.seed, electrons, index, frame, filter));
      }
    }
  });
  return raw;
}

Image developed(const Scene& scene, const Image& raw) {
  const SensorScale scale = sensor_scale(scene.sensor, scene.time);
  const Matrix3 rgb_of_raw = rgb_from_raw(scene);
  Image linear = raw;
  for (float& value : linear.data)
    value =
        static_cast<float>(((value - scale.black_dn) / scale.dn_per_electron - scale.dark_e) / scale.white_e);
  if (has_mosaic(scene)) linear = demosaic(linear, scene.sensor.mosaic);
  for (int y = 0; y < linear.height; ++y)
    for (int x = 0; x < linear.width; ++x) {
      const Vector3 rgb = product(rgb_of_raw, pixel(linear, x, y));
      for (int c = 0; c < 3; ++c) linear.at(x, y, c) = static_cast<float>(rgb[c]);
    }
  return linear;
}

Image encoded(const Scene& scene, const Image& rgb) {
  Image shown = rgb;
  if (scene.sensor.tone == ToneKind::filmic) {
    const FilmicTone tone(scene.sensor.primaries);
    for (std::size_t i = 0; i < shown.data.size(); i += 3) {
      float* const p = &shown.data[i];
      const Vector3 colour = tone.shown({p[0], p[1], p[2]});
      for (int c = 0; c < 3; ++c) p[c] = static_cast<float>(srgb_encode(colour[c]));
    }
    ColourTable(scene).colour(shown);
    return shown;
  }
  const ToneCurve tone(scene);
  for (float& value : shown.data)
    value = static_cast<float>(tone.encode(std::clamp<double>(value, 0.0, 1.0)));
  ColourTable(scene).colour(shown);
  return shown;
}

void recover_light(const Scene& scene, double file_step, Image& rgb, std::vector<std::uint8_t>& usable) {
  assert(usable.size() == rgb.data.size() && rgb.channels() == 3);
  const SensorScale scale = sensor_scale(scene.sensor, scene.time);
  const Matrix3 raw_of_rgb = raw_from_rgb(scene);
  const Vignetting vignetting(with_size_of(scene, rgb));
  const ToneCurve tone(scene);
  const bool mixes = scene.sensor.matrix_rule != MatrixRule::none;
  // The largest number, or a full pixel as it may be read.
  constexpr double kReadNoises = 5.0;
  const double full_e = std::min(scale.white_e - 0.5 / scale.dn_per_electron,
                                 scene.sensor.full_well_e - kReadNoises * scale.read_noise_e);
  const double full = (full_e - scale.dark_e) / scale.white_e;
  std::vector<std::uint8_t> saturated(static_cast<std::size_t>(rgb.width) * rgb.height, 0);
  for (int y = 0; y < rgb.height; ++y)
    for (int x = 0; x < rgb.width; ++x) {
      const Vector3 decoded = pixel(rgb, x, y), raw = product(raw_of_rgb, decoded);
      bool is_full = false;
      for (int r = 0; r < 3; ++r) {
        // What the file has rounded off may have brought a full channel below.
        double margin = 0.0;
        if (file_step > 0.0)
          for (int c = 0; c < 3; ++c)
            margin += 0.5 * std::abs(raw_of_rgb[r][c]) * step_at(tone, decoded[c], file_step);
        is_full = is_full || raw[r] + margin >= full;
      }
      // Where a file has cut off one channel, a matrix has mixed what is missing into all raw ones.
      if (mixes && file_step > 0.0)
        is_full = is_full || *std::max_element(decoded.begin(), decoded.end()) >= 1.0 - 0.5 * file_step;
      saturated[static_cast<std::size_t>(y) * rgb.width + x] = is_full;
    }
  if (has_mosaic(scene)) saturated = spread(saturated, rgb.width, rgb.height);
  for (int y = 0; y < rgb.height; ++y)
    for (int x = 0; x < rgb.width; ++x) {
      const double light = vignetting.at(x + 0.5, y + 0.5);
      const bool lost = saturated[static_cast<std::size_t>(y) * rgb.width + x] != 0 || light < kMinLight;
      for (int c = 0; c < 3; ++c) {
        float& value = rgb.at(x, y, c);
        value = static_cast<float>(value / std::max(light, kMinLight));
        if (lost) usable[rgb.index(x, y, c)] = 0;
      }
    }
}

Image light_variance(const Scene& scene, const Image& light, double file_step) {
  const SensorScale scale = sensor_scale(scene.sensor, scene.time);
  const Matrix3 raw_of_rgb = raw_from_rgb(scene), rgb_of_raw = rgb_from_raw(scene);
  const Vignetting vignetting(with_size_of(scene, light));
  const bool mosaic = has_mosaic(scene);
  const ToneCurve tone(scene);
  Image variance(light.width, light.height, {"R", "G", "B"});
  Image of_pixels(light.width, light.height, {"raw"});
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x) {
      const double seen = vignetting.at(x + 0.5, y + 0.5);
      const Vector3 raw = product(raw_of_rgb, pixel(light, x, y));
      for (int c = 0; c < 3; ++c) {
        const double of_channel = raw_variance(scale, raw[c] * seen);
        variance.at(x, y, c) = static_cast<float>(of_channel);
        if (mosaic && filter_of_pixel(scene.sensor.mosaic, x, y) == c)
          of_pixels.at(x, y, 0) = static_cast<float>(of_channel);
      }
    }
  if (mosaic) variance = demosaic_variance(of_pixels, scene.sensor.mosaic);
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x) {
      const double seen = std::max(vignetting.at(x + 0.5, y + 0.5), kMinLight);
      const Vector3 of_raw = pixel(variance, x, y);
      for (int c = 0; c < 3; ++c) {
        double sum = 0.0;
        for (int r = 0; r < 3; ++r) sum += rgb_of_raw[c][r] * rgb_of_raw[c][r] * of_raw[r];
        if (file_step > 0.0) {
          const double step = step_at(tone, light.at(x, y, c) * seen, file_step);
          sum += step * step / 12.0;
        }
        variance.at(x, y, c) = static_cast<float>(sum / (seen * seen));
      }
    }
  return variance;
}

int filter_of_pixel(MosaicPattern pattern, int x, int y) {
  static constexpr std::array letters = {"rggb", "bggr", "grbg", "gbrg"};
  assert(pattern != MosaicPattern::none);
  const char filter = letters[static_cast<std::size_t>(pattern)][2 * (y & 1) + (x & 1)];
  return filter == 'r' ? 0 : filter == 'g' ? 1 : 2;
}

Image demosaic(const Image& mosaic, MosaicPattern pattern) { return demosaiced(mosaic, pattern, 1); }

Image demosaic_variance(const Image& mosaic_variance, MosaicPattern pattern) {
  return demosaiced(mosaic_variance, pattern, 2);
}

Vignetting::Vignetting(const Scene& scene)
    : camera_(scene.camera),
      lens_(camera_view(scene.camera).lens),
      cos_power_(scene.sensor.vignetting_cos_power),
      polynomial_(scene.sensor.vignetting),
      none_(cos_power_ == 0.0 && polynomial_ == std::array<double, 3>{0.0, 0.0, 0.0}) {}

double Vignetting::at(double x_px, double y_px) const {
  if (none_) return 1.0;
  const double x = x_px - 0.5 * camera_.width, y = y_px - 0.5 * camera_.height;
  const double square = 4.0 * (x * x + y * y) /
                        (static_cast<double>(camera_.width) * camera_.width +
                         static_cast<double>(camera_.height) * camera_.height);
  double light = 1.0 + square * (polynomial_[0] + square * (polynomial_[1] + square * polynomial_[2]));
  if (cos_power_ > 0.0) {
    double in_camera[3] = {0.0, 0.0, 0.0};
    unproject(lens_, x_px, y_px, in_camera);
    light *= std::pow(std::max(in_camera[2], 0.0), cos_power_);
  }
  return std::max(light, 0.0);
}

void darken(const Vignetting& vignetting, Image& image) {
  if (vignetting.none()) return;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double light = vignetting.at(x + 0.5, y + 0.5);
      for (int c = 0; c < image.channels(); ++c) {
        float& value = image.at(x, y, c);
        value = static_cast<float>(value * light);
      }
    }
}

}  // namespace vegard::sim
