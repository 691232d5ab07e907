#include "sim/view/film/composite.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/view/sensor/tone_curve.h"

namespace vegard::sim {
namespace {

bool has_alpha(const Image& image) { return image.channel_names.back() == "A"; }

float alpha_at(const Image& image, int x, int y) {
  return has_alpha(image) ? std::clamp(image.at(x, y, image.channels() - 1), 0.0f, 1.0f) : 1.0f;
}

/// The pixels of a row that make up one pixel of another, from the first on.
struct Share {
  int first;
  std::vector<double> weights;
};

/// Returns the shares of `count` new pixels along an axis, `step` old ones apart, the first beginning at
/// `start`.
std::vector<Share> shares(int old_count, int count, double start, double step) {
  std::vector<Share> all;
  for (int i = 0; i < count; ++i) {
    const double from = start + i * step;
    Share share{0, {}};
    if (step > 1.0) {
      const double begin = std::max(from, 0.0), end = std::min(from + step, static_cast<double>(old_count));
      share.first = std::min(static_cast<int>(begin), old_count - 1);
      for (int k = share.first; k < end && k < old_count; ++k)
        share.weights.push_back((std::min(end, k + 1.0) - std::max(begin, static_cast<double>(k))) /
                                (end - begin));
    } else {
      const double centre = std::clamp(from + 0.5 * step - 0.5, 0.0, old_count - 1.0);
      share.first = static_cast<int>(centre);
      const double rest = centre - share.first;
      share.weights.push_back(1.0 - rest);
      if (rest > 0.0) share.weights.push_back(rest);
    }
    all.push_back(std::move(share));
  }
  return all;
}

}  // namespace

Image linear_picture(const PictureFile& file) {
  const Image& from = file.image;
  const int colours = from.channels() - (has_alpha(from) ? 1 : 0);
  Image to(from.width, from.height, {"R", "G", "B", "A"});
  for (int y = 0; y < from.height; ++y) {
    for (int x = 0; x < from.width; ++x) {
      const float alpha = alpha_at(from, x, y);
      for (int c = 0; c < 3; ++c) {
        double value = from.at(x, y, colours == 3 ? c : 0);
        if (!file.floating) {
          // The curve belongs to the colour itself.
          if (file.colour_times_alpha) value = alpha > 0.0f ? std::min(1.0, value / alpha) : 0.0;
          value = srgb_decode(value);
        }
        if (!file.floating || !file.colour_times_alpha) value *= alpha;
        to.at(x, y, c) = static_cast<float>(value);
      }
      to.at(x, y, 3) = alpha;
    }
  }
  return to;
}

Image coverage_of(const PictureFile& file) {
  const Image& from = file.image;
  const int colours = from.channels() - (has_alpha(from) ? 1 : 0);
  Image to(from.width, from.height, {"A"});
  for (int y = 0; y < from.height; ++y) {
    for (int x = 0; x < from.width; ++x) {
      double sum = 0.0;
      for (int c = 0; c < colours; ++c) sum += from.at(x, y, c);
      if (!file.colour_times_alpha) sum *= alpha_at(from, x, y);
      to.at(x, y, 0) = static_cast<float>(std::clamp(sum / colours, 0.0, 1.0));
    }
  }
  return to;
}

Image fill_frame(const Image& picture, int width, int height) {
  assert(!picture.empty() && width > 0 && height > 0);
  const int channels = picture.channels();
  const double step = std::min(static_cast<double>(picture.width) / width,
                               static_cast<double>(picture.height) / height);  // old pixels per new one
  const std::vector<Share> across = shares(picture.width, width, 0.5 * (picture.width - step * width), step);
  const std::vector<Share> down =
      shares(picture.height, height, 0.5 * (picture.height - step * height), step);

  Image filled(width, height, picture.channel_names);
  std::vector<double> row(static_cast<std::size_t>(picture.width) * channels);
  for (int y = 0; y < height; ++y) {
    std::fill(row.begin(), row.end(), 0.0);
    for (std::size_t k = 0; k < down[y].weights.size(); ++k) {
      const float* old_row = &picture.data[picture.index(0, down[y].first + static_cast<int>(k), 0)];
      for (std::size_t i = 0; i < row.size(); ++i) row[i] += down[y].weights[k] * old_row[i];
    }
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) {
        double sum = 0.0;
        for (std::size_t k = 0; k < across[x].weights.size(); ++k)
          sum += across[x].weights[k] * row[(across[x].first + k) * channels + c];
        filled.at(x, y, c) = static_cast<float>(sum);
      }
    }
  }
  return filled;
}

Image with_coverage(const Image& picture, const Image& coverage) {
  assert(picture.channels() == 4 && coverage.channels() == 1);
  const Image filled = fill_frame(coverage, picture.width, picture.height);
  Image covered = picture;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const float alpha = picture.at(x, y, 3), area = filled.at(x, y, 0);
      for (int c = 0; c < 3; ++c)
        covered.at(x, y, c) = alpha > 0.0f ? picture.at(x, y, c) / alpha * area : 0.0f;
      covered.at(x, y, 3) = area;
    }
  }
  return covered;
}

void scale_light(double gain, Image& picture) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < 3; ++c) picture.at(x, y, c) = static_cast<float>(gain * picture.at(x, y, c));
}

void add_light(const Image& picture, double gain, Image& rgb) {
  assert(picture.width == rgb.width && picture.height == rgb.height && rgb.channels() == 3);
  for (int y = 0; y < rgb.height; ++y)
    for (int x = 0; x < rgb.width; ++x)
      for (int c = 0; c < 3; ++c) rgb.at(x, y, c) += static_cast<float>(gain * picture.at(x, y, c));
}

void cover(const Image& foreground, Image& rgb) {
  assert(foreground.width == rgb.width && foreground.height == rgb.height && rgb.channels() == 3);
  for (int y = 0; y < rgb.height; ++y)
    for (int x = 0; x < rgb.width; ++x)
      for (int c = 0; c < 3; ++c)
        rgb.at(x, y, c) = foreground.at(x, y, c) + (1.0f - foreground.at(x, y, 3)) * rgb.at(x, y, c);
}

void put_before(const Image& nearer, Image& picture) {
  assert(nearer.data.size() == picture.data.size() && picture.channels() == 4);
  for (std::size_t i = 0; i < picture.data.size(); ++i)
    picture.data[i] = nearer.data[i] + (1.0f - nearer.data[i - i % 4 + 3]) * picture.data[i];
}

void hide(const Image& hidden, Image& rgb) {
  assert(hidden.data.size() == rgb.data.size() && rgb.channels() == 3);
  for (std::size_t i = 0; i < rgb.data.size(); ++i) rgb.data[i] *= 1.0f - hidden.data[i];
}

}  // namespace vegard::sim
