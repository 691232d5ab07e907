// How far around a place of a footprint all is dark: what a march may pass over.
//
// Places are in texels of the footprint's grid: (x, y) is the middle of texel x of row y. The map is coarse,
// a cell for 8 x 8 texels, and never says more than is true: the exact distance between the middles of cells,
// less their diagonal.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/emit/footprint/map/footprint_map.h"

namespace vegard::sim {

/// Flux below this share of a footprint's greatest counts as none.
inline constexpr double kDarkShare = 1e-6;

class LitMap {
 public:
  static constexpr int kCellTexels = 8;

  /// Over the texels from `first` to `last`, across and down.
  LitMap(int first_x, int last_x, int first_y, int last_y);

  /// Texels over which a texel's light reaches, by the bilinear interpolation.
  void mark_texel(int x, int y) { mark(x - 1.0, x + 1.0, y - 1.0, y + 1.0); }
  /// All cells that the rectangle touches.
  void mark(double low_x, double high_x, double low_y, double high_y);
  /// What is beyond the map's edge is not known.
  void mark_edge();
  /// Works the distances out, from the marks.
  void finish(int threads);

  /// No light is closer than so many texels. Beyond the map, as at its edge, which is not more than is true.
  double dark_texels(double x, double y) const {
    const int column = cell(x - first_x_, columns_), row = cell(y - first_y_, rows_);
    return dark_[static_cast<std::size_t>(row) * columns_ + column];
  }

  /// The same as numbers for the kernel: [row][column] of cells, the first from (first_x, first_y) on.
  const float* dark() const { return dark_.data(); }
  int first_x() const { return first_x_; }
  int first_y() const { return first_y_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }

 private:
  static int cell(double offset, int count) {
    const double at = offset * (1.0 / kCellTexels);
    return at < 0.0 ? 0 : at >= count ? count - 1 : static_cast<int>(at);
  }

  int first_x_, first_y_, columns_, rows_;
  std::vector<std::uint8_t> marked_;
  std::vector<float> dark_;
};

/// Flux, [row][column] of a grid, that is not dark.
template <class T>
std::vector<std::uint8_t> lit_texels(const FootprintGrid<T>& grid, double min_flux);

/// The map of a plane's footprint.
LitMap plane_lit_map(int columns, int rows, const std::vector<std::uint8_t>& lit, int threads);

/// The maps of a cube's faces. Each knows of the light on its neighbours for an eighth of a face beyond its
/// own edges, as seen in its own plane. An empty list: a face in the dark.
std::vector<LitMap> cube_lit_maps(int face_cells, const std::array<std::vector<std::uint8_t>, 6>& lit,
                                  int threads);

}  // namespace vegard::sim
