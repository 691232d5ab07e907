#include "fit/photo/mask/polygon.h"

#include <algorithm>
#include <cassert>

namespace vegard::fit {

PixelSet polygon_inside(const std::vector<PicturePoint>& corners, int width, int height) {
  assert(corners.size() >= 3);
  PixelSet set(width, height);
  std::vector<double> crossings;
  for (int row = 0; row < height; ++row) {
    const double y = row + 0.5;
    crossings.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const PicturePoint &a = corners[i], &b = corners[(i + 1) % corners.size()];
      if ((a.y_px <= y) != (b.y_px <= y))
        crossings.push_back(a.x_px + (y - a.y_px) / (b.y_px - a.y_px) * (b.x_px - a.x_px));
    }
    std::sort(crossings.begin(), crossings.end());
    for (int x = 0; x < width; ++x) {
      const auto left = std::lower_bound(crossings.begin(), crossings.end(), x + 0.5) - crossings.begin();
      set.at(x, row) = left % 2 == 1;
    }
  }
  return set;
}

PixelSet drawn_out(const Photo& photo, const std::string& mask_file) {
  // apply_mask is the one reader of masks; it wants a photograph to leave pixels out of.
  Photo all;
  all.linear.width = photo.linear.width;
  all.linear.height = photo.linear.height;
  all.linear.channel_names = photo.linear.channel_names;
  all.usable.assign(photo.usable.size(), 1);
  all.file_name = photo.file_name;
  apply_mask(all, mask_file);
  PixelSet set(photo.linear.width, photo.linear.height);
  for (std::size_t i = 0; i < set.in.size(); ++i) set.in[i] = !all.usable[3 * i];
  return set;
}

}  // namespace vegard::fit
