// Image: a linear, floating-point image with named channels.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace vegard::sim {

/// Row-major, channels interleaved: value(x, y, c) = data[(y * width + x) * channels() + c]. x to the right,
/// y down, the centre of the first pixel at (0.5, 0.5). Values are linear light; their quantity and unit
/// follow from the channel names and the function that made the image ("630.0" with rayleighs, "R" with a
/// sensor's linear units).
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::string> channel_names;
  std::vector<float> data;

  Image() = default;
  Image(int width_px, int height_px, std::vector<std::string> names)
      : width(width_px),
        height(height_px),
        channel_names(std::move(names)),
        data(static_cast<std::size_t>(width_px) * height_px * channel_names.size(), 0.0f) {}

  int channels() const { return static_cast<int>(channel_names.size()); }
  bool empty() const { return data.empty(); }
  std::size_t index(int x, int y, int c) const {
    return (static_cast<std::size_t>(y) * width + x) * channel_names.size() + c;
  }
  float& at(int x, int y, int c) { return data[index(x, y, c)]; }
  float at(int x, int y, int c) const { return data[index(x, y, c)]; }
};

/// Returns "640 x 480".
inline std::string size_text(long long width, long long height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

/// The values of a picture file that a scene uses: a background, a foreground, a mask.
struct PictureFile {
  Image image;            ///< R, G, B, or Y if it is grey, then A if it has an alpha; integers as 0 to 1
  bool floating = false;  ///< true: floats, taken as linear light; false: integers, taken as sRGB
  bool colour_times_alpha = false;  ///< the stored colours are multiplied by alpha
};

}  // namespace vegard::sim
