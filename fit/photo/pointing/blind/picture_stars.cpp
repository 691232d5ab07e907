#include "fit/photo/pointing/blind/picture_stars.h"

#include <algorithm>

namespace vegard::fit {
namespace {

constexpr int kMinSearched_px = 300, kWidestFirst_px = 1600;

sim::Image made_smaller(const sim::Image& picture, int by) {
  if (by == 1) return picture;
  sim::Image small;
  small.width = picture.width / by;
  small.height = picture.height / by;
  const int channels = picture.channels();
  small.channel_names = picture.channel_names;
  small.data.assign(static_cast<std::size_t>(small.width) * small.height * channels, 0.0f);
  const float share = 1.0f / static_cast<float>(by * by);
  for (int y = 0; y < small.height * by; ++y)
    for (int x = 0; x < small.width * by; ++x) {
      const float* from = &picture.data[(static_cast<std::size_t>(y) * picture.width + x) * channels];
      float* to = &small.data[(static_cast<std::size_t>(y / by) * small.width + x / by) * channels];
      for (int c = 0; c < channels; ++c) to[c] += share * from[c];
    }
  return small;
}

/// Usable where all of its pixels are.
std::vector<char> made_smaller(const std::vector<char>& usable, int width, int height, int by) {
  if (usable.empty() || by == 1) return usable;
  const int w = width / by, h = height / by;
  std::vector<char> small(static_cast<std::size_t>(w) * h, 1);
  for (int y = 0; y < h * by; ++y)
    for (int x = 0; x < w * by; ++x)
      if (usable[static_cast<std::size_t>(y) * width + x] == 0)
        small[static_cast<std::size_t>(y / by) * w + x / by] = 0;
  return small;
}

}  // namespace

PictureStars recognise_picture(const sim::Image& linear, const StarFinderSettings& finder,
                               const std::vector<char>& usable, const RecognitionSettings& settings) {
  const int longest = std::max(linear.width, linear.height);
  const Frame frame{linear.width, linear.height, true};
  std::vector<int> scales;
  for (const int by : {1, 2, 3, 4, 6, 8})
    if (by == 1 || longest / by >= kMinSearched_px) scales.push_back(by);
  // First those at which the picture is of ordinary size.
  std::stable_sort(scales.begin(), scales.end(), [&](int a, int b) {
    return (longest / a > kWidestFirst_px) < (longest / b > kWidestFirst_px);
  });
  PictureStars best;
  bool first = true;
  // Crops off the centre take ten times as long: only when the plain ones have failed at all scales.
  for (const bool off_centre : {false, true}) {
    if (off_centre && !settings.off_centre) break;
    std::size_t tried = 0;
    for (const int by : scales) {
      if (++tried > (off_centre ? 1u : 3u)) break;
      RecognitionSettings one = settings;
      one.off_centre = off_centre;
      PictureStars now;
      now.smaller = by;
      now.found =
          find_stars(made_smaller(linear, by), finder, made_smaller(usable, linear.width, linear.height, by));
      for (FoundStar& star : now.found) {
        star.x_px *= by;
        star.y_px *= by;
        star.sigma_px *= by;
      }
      now.recognition = recognise_stars(now.found, frame, one);
      if (first || now.recognition.best.log10_false < best.recognition.best.log10_false) best = now;
      first = false;
      if (best.recognition.found) return best;
    }
  }
  return best;
}

}  // namespace vegard::fit
