#include "fit/photo/mask/mask_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>

#include "fit/photo/codec/opencv_codecs.h"
#include "sim/base/number/quantile.h"
#include "sim/view/sensor/tone_curve.h"

namespace vegard::fit {
namespace {

/// 1 for a picture that fills its range; else what brings all but the brightest two hundredth into it.
float brightening(const Photo& photo) {
  constexpr float kMaskDark = 0.1f, kShown = 0.6f;
  std::vector<float> light = photo.linear.data;
  if (light.empty()) return 1.0f;
  const float bright = sim::quantile(light, 0.995);
  if (!(bright > 0.0f) || (!photo.floating && bright > kMaskDark)) return 1.0f;
  return kShown / bright;
}

}  // namespace

PixelSet left_out(const std::vector<MaskPart>& parts, int width, int height) {
  PixelSet all(width, height);
  for (const MaskPart& part : parts) add(all, part.out);
  return all;
}

std::string mask_png(const PixelSet& left_out) {
  cv::Mat picture(left_out.height, left_out.width, CV_8U);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) picture.at<std::uint8_t>(y, x) = left_out.at(x, y) ? 0 : 255;
  return encoded_png(picture);
}

std::string shown_mask_png(const Photo& photo, const std::vector<MaskPart>& parts) {
  const float gain = brightening(photo);
  cv::Mat picture(photo.linear.height, photo.linear.width, CV_8UC3);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      const auto part =
          std::find_if(parts.begin(), parts.end(), [&](const MaskPart& p) { return p.out.at(x, y) != 0; });
      for (int c = 0; c < 3; ++c) {
        double code = 255.0 * sim::srgb_encode(std::clamp(gain * photo.linear.at(x, y, c), 0.0f, 1.0f));
        if (part != parts.end()) code = 0.5 * (code + part->colour[c]);
        picture.at<cv::Vec3b>(y, x)[2 - c] = static_cast<std::uint8_t>(std::lround(code));
      }
    }
  return encoded_png(picture);
}

}  // namespace vegard::fit
