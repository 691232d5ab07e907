#include "fit/photo/light_photo.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/base/file/sha256.h"

namespace vegard::fit {

Photo photo_of_light(const sim::Image& light, const std::vector<std::uint8_t>& used,
                     const std::string& name) {
  const auto channels = static_cast<std::size_t>(light.channels());
  assert(channels == 1 || channels == 3);
  assert(used.empty() || used.size() * channels == light.data.size());
  Photo photo;
  photo.srgb = false;
  photo.floating = true;
  photo.bits = 32;
  photo.decoding = "linear (32-bit float array, as given)";
  photo.file_name = name;
  photo.sha256 =
      sim::sha256({reinterpret_cast<const char*>(light.data.data()), light.data.size() * sizeof(float)});
  photo.linear = sim::Image(light.width, light.height, {"R", "G", "B"});
  photo.usable.assign(photo.linear.data.size(), 0);
  for (std::size_t i = 0; i < photo.linear.data.size(); ++i) {
    const float value = light.data[channels == 3 ? i : i / 3];
    if (!std::isfinite(value)) continue;
    photo.linear.data[i] = value;
    photo.usable[i] = used.empty() || used[i / 3] != 0;
  }
  return photo;
}

std::vector<char> pixels_left_by(const std::string& mask_file, const Photo& photo) {
  const std::size_t channels = photo.linear.channels(), pixels = photo.usable.size() / channels;
  // A star may be clipped, and stays one: only what the mask hides is left out, all channels at once.
  Photo blank = photo;
  std::fill(blank.usable.begin(), blank.usable.end(), std::uint8_t{1});
  apply_mask(blank, mask_file);
  std::vector<char> left;
  for (std::size_t i = 0; i < pixels; ++i) left.push_back(static_cast<char>(blank.usable[i * channels]));
  return left;
}

}  // namespace vegard::fit
