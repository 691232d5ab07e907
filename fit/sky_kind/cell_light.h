// The light of a picture in cells of its sky: what features are made of, of a frame whose camera is known
// (fit/survey/filter) and of any picture (sky_features.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "fit/photo/photo.h"

namespace vegard::fit {

/// Linear light from which on a channel counts as clipped: white, less what rounding takes.
inline constexpr float kClippedLight = 0.995f;

/// The cells of a picture, some 64 along its longer side, and which are sky.
struct FeatureCells {
  int size_px = 1;            ///< edge of a cell
  int columns = 0, rows = 0;  ///< number of whole cells
  std::vector<std::uint8_t> sky;
};

/// Returns the cells of a picture, none of them sky.
FeatureCells cells_of(int width, int height);

/// Whether half of a cell's pixels are kept. `is_kept`: per pixel, 0 if masked; empty: no mask.
bool is_cell_kept(const FeatureCells& cells, std::size_t cell, int width,
                  const std::vector<std::uint8_t>& is_kept);

/// Light of cells and its residual above the smooth sky; only cells of sky count.
struct CellLight {
  std::vector<std::array<double, 3>> rgb;
  std::vector<double> grey;      ///< mean of the three
  std::vector<double> log_grey;  ///< log10, in a unit and with a least value of the caller's
  std::vector<double> residual;  ///< log_grey less a smooth sky
  std::vector<std::size_t> sky;  ///< numbers of cells
  double clipped_share = 0.0;    ///< of pixels, of the cell that has most
};

/// Returns rgb, grey, sky and clipped_share; `has_white`: whether pixels at white are clipped.
CellLight light_of_cells(const Photo& photo, const FeatureCells& cells, bool has_white);

/// Fills the residual: log_grey less a quadratic function of the cells' place, by least squares over the sky.
void take_smooth_sky_off(const FeatureCells& cells, CellLight& light);

/// The residual's differences to the right and downwards, of a cell whose four neighbours are sky.
struct CellGradient {
  std::size_t cell = 0;
  double x = 0.0, y = 0.0;
};
std::vector<CellGradient> residual_gradients(const FeatureCells& cells, const CellLight& light);

/// Returns the coherence of the structure tensor, averaged over five by five cells since what is long is so
/// over more than a cell, weighted by its energy: 0 to 1.
double elongation(const FeatureCells& cells, const std::vector<CellGradient>& gradients);

/// Mean light of the tenth of the sky with the largest residual, and of the half with the least.
struct TopAndBelow {
  std::array<double, 3> top{}, below{};
};
/// Leaves out cells whose mean is above `clipped`, which have lost their colour. None if nothing is left.
std::optional<TopAndBelow> top_and_below(const CellLight& light, double clipped);

/// How far a cell that is no darker than its neighbours rises above the ring about it (log10); none of
/// others, or if little of its ring is sky. An arc crosses its ring and does not rise above it.
std::optional<double> peak_above_ring(const FeatureCells& cells, const CellLight& light, std::size_t cell);

/// Finds stars by their look alone: pixels brighter than their eight neighbours, and well above those three
/// pixels off. `root`: the square root of light, which has the same noise everywhere where that is the
/// photons'. `step`: of the file, in light. Of the pixels that measure the noise those of `is_sky` are taken
/// if they are enough; null: all. Calls `found` with each star's pixel.
void find_points(const std::vector<float>& root, int width, int height, double step,
                 const std::function<bool(int x, int y)>& is_sky,
                 const std::function<void(int x, int y)>& found);

}  // namespace vegard::fit
