// The radius around each place of a footprint within which it is dark, so that a march may skip it.
//
// Places are in texels of the footprint's grid: (x, y) is the middle of texel x of row y. The map is coarse,
// with a cell for 8 x 8 texels, and never overestimates: it holds the exact distance between the middles of
// cells, less their diagonal.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/emit/footprint/map/footprint_map.h"

namespace vegard::sim {

/// Flux below this share of a footprint's largest flux is taken as 0.
inline constexpr double kDarkShare = 1e-6;

class LitMap {
 public:
  static constexpr int kCellTexels = 8;

  /// A map of the texels from `first` to `last` in x and y.
  LitMap(int first_x, int last_x, int first_y, int last_y);

  /// Marks the area that a texel's light reaches by bilinear interpolation.
  void mark_texel(int x, int y) { mark(x - 1.0, x + 1.0, y - 1.0, y + 1.0); }
  /// Marks all cells that the rectangle touches.
  void mark(double low_x, double high_x, double low_y, double high_y);
  /// Marks the cells at the map's edge, since nothing is known beyond it.
  void mark_edge();
  /// Computes the distances from the marks.
  void finish(int threads);

  /// Returns a distance in texels within which there is no light. Beyond the map the value at its edge is
  /// returned, which is a lower bound.
  double dark_texels(double x, double y) const {
    const int column = cell(x - first_x_, columns_), row = cell(y - first_y_, rows_);
    return dark_[static_cast<std::size_t>(row) * columns_ + column];
  }

  /// The map for the kernel: [row][column] of cells, the first of which begins at (first_x, first_y).
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

/// Returns which texels of a grid have a flux above `min_flux`, [row][column].
template <class T>
std::vector<std::uint8_t> lit_texels(const FootprintGrid<T>& grid, double min_flux);

/// Returns the map of a plane's footprint.
LitMap plane_lit_map(int columns, int rows, const std::vector<std::uint8_t>& lit, int threads);

/// Returns the maps of a cube's faces. Each includes the light of the neighbouring faces up to an eighth of a
/// face beyond its own edges, projected to its own plane. An empty list stands for a dark face.
std::vector<LitMap> cube_lit_maps(int face_cells, const std::array<std::vector<std::uint8_t>, 6>& lit,
                                  int threads);

/// A part of a footprint's grid that holds all its light, with a dark border.
struct TexelWindow {
  const float* flux = nullptr;       ///< [row][column]; null: dark
  const float* ln_energy = nullptr;  ///< null: 0 everywhere
  int columns = 0, rows = 0;
  double first_x = 0.0, first_y = 0.0;  ///< texel of the grid at which the window begins
};

/// The part of a footprint's grid that has light, in floats.
class TexelStore {
 public:
  TexelStore() = default;
  /// Texels with a flux of at most min_flux become 0, and the part has a border of such texels.
  /// `with_energy`: ln_energy is stored even if the grid has none.
  TexelStore(const FootprintGrid<double>& grid, double min_flux, bool with_energy);

  /// Returns a window that points into this object.
  TexelWindow window() const;

 private:
  int columns_ = 0, rows_ = 0, first_x_ = 0, first_y_ = 0;
  std::vector<float> flux_, ln_energy_;
};

}  // namespace vegard::sim
