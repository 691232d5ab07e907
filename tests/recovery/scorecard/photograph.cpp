#include "tests/recovery/scorecard/photograph.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "sim/base/number/distributions.h"
#include "sim/base/number/random.h"
#include "sim/render/render.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sensor/tone_curve.h"
#include "tests/recovery/scorecard/line_of_sight_picture.h"

namespace vegard::scorecard {
namespace {

constexpr double kElectronsAtWhite = 8000.0, kReadNoise = 0.0015;
constexpr int kQuality = 92;
constexpr int kBands = 24;  // of which the brightest is exposed for

sim::Rendering rendered(const Truth& truth, int threads) {
  sim::RenderOptions options;
  options.threads = threads;
  if (!truth.line_of_sight) return sim::render(truth.scene, options);
  sim::Rendering rendering;
  rendering.rayleigh = line_of_sight_rayleighs(truth.scene, threads);
  rendering.aurora = sim::rgb_from_rayleigh(rendering.rayleigh, sim::line_colours(truth.scene));
  return rendering;
}

/// The brightest row of any band and channel.
double brightest(const sim::Image& rgb) {
  double most = 0.0;
  for (int band = 0; band < kBands; ++band) {
    const int first = band * rgb.width / kBands, end = (band + 1) * rgb.width / kBands;
    for (int y = 0; y < rgb.height; ++y)
      for (int c = 0; c < 3; ++c) {
        double sum = 0.0;
        for (int x = first; x < end; ++x) sum += rgb.at(x, y, c);
        most = std::max(most, sum / (end - first));
      }
  }
  return most;
}

double noisy(double light, std::uint64_t seed, int x, int y, int c) {
  const sim::Words words = sim::random_words(seed, sim::Stream::photon_noise, static_cast<std::uint32_t>(x),
                                             static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(c));
  const double normal = sim::normal_quantile(sim::fine_uniform(words[0], words[1]));
  return light + normal * std::sqrt(std::max(light, 0.0) / kElectronsAtWhite + kReadNoise * kReadNoise);
}

}  // namespace

Photograph photograph(const Truth& truth, int threads, bool is_lossless) {
  Photograph result;
  result.scene = truth.scene;
  sim::Rendering rendering = rendered(truth, threads);
  const double factor = truth.exposure / brightest(rendering.aurora);
  for (float& value : rendering.aurora.data) value = static_cast<float>(value * factor);
  result.scene.sensor.gain_per_kilorayleigh *= factor;

  const sim::Image light = sim::shown_light(result.scene, rendering);
  cv::Mat picture(light.height, light.width, CV_8UC3);
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const double code = 255.0 * sim::srgb_encode(noisy(light.at(x, y, c), truth.scene.seed, x, y, c));
        // OpenCV has blue first.
        picture.at<cv::Vec3b>(y, x)[2 - c] =
            static_cast<unsigned char>(std::lround(std::clamp(code, 0.0, 255.0)));
      }
  std::vector<unsigned char> bytes;
  if (is_lossless)
    cv::imencode(".png", picture, bytes);
  else
    cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  result.bytes.assign(bytes.begin(), bytes.end());
  return result;
}

}  // namespace vegard::scorecard
