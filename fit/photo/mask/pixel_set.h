// A set of a picture's pixels, such as those that one finder masks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vegard::fit {

/// Row-major flags: in[y * width + x] is 1 for a pixel of the set, else 0. x to the right, y down; the pixel
/// (x, y) covers [x, x + 1) × [y, y + 1).
struct PixelSet {
  int width = 0, height = 0;
  std::vector<std::uint8_t> in;

  PixelSet() = default;
  PixelSet(int width_px, int height_px)
      : width(width_px), height(height_px), in(static_cast<std::size_t>(width_px) * height_px, 0) {}

  std::uint8_t& at(int x, int y) { return in[static_cast<std::size_t>(y) * width + x]; }
  std::uint8_t at(int x, int y) const { return in[static_cast<std::size_t>(y) * width + x]; }
  std::size_t count() const;
};

/// Returns the pixels whose centres are within radius_px of the centre of a pixel of the set; the set itself
/// for 0.
PixelSet grown(const PixelSet& set, int radius_px);

/// Adds the pixels whose centres are within radius_px of (x_px, y_px), or that hold that point.
void add_disc(PixelSet& set, double x_px, double y_px, double radius_px);

/// Adds the pixels of another set of the same size.
void add(PixelSet& set, const PixelSet& other);

/// A place in a picture, in pixels: x to the right, y down, the centre of the first pixel at (0.5, 0.5).
struct PicturePoint {
  double x_px, y_px;
};

}  // namespace vegard::fit
