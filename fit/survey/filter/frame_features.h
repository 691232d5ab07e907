// A frame in numbers that cost little: what distinguishes an arc from clouds, the Moon, twilight and lamps.
//
// The picture is averaged over some 64 x 64 cells, and each is asked where it looks, so that the numbers mean
// the same for any lens. On a flat Earth an arc that runs along magnetic east and west lies on a line of
// equal angle in the magnetic meridian: the angle atan2(up, magnetic north) of the line of sight. It needs
// neither a height nor a distance, and the gradient of this angle is the direction across arcs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fit/photo/photo.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

enum class FrameFeature {
  sun_elevation,   ///< degrees
  moon_elevation,  ///< degrees, as seen from the place
  moon_light,      ///< lit share of the Moon, 0 where it is down
  brightness,      ///< log10 of the middle (median) cell, the file's white = 1
  contrast,        ///< log10 of brightness, from the 5th to the 95th percentile of cells
  structure,       ///< standard deviation of log10 of brightness about a smooth (quadratic) sky
  banded,          ///< share of that variance that bins of equal angle in the magnetic meridian explain
  crosswise,       ///< energy of gradients across arcs less that along them, over their sum: -1 to 1
  elongated,       ///< coherence of the local structure tensor, weighted by its energy: 0 to 1
  green,           ///< of what is brighter than the sky: green less the mean of red and blue, over the sum
  blue,            ///< of the middle sky: blue less red, over the sum
  points,          ///< log10 of 1 + what looks like stars
  moon_peak,       ///< log10 of the brightest cell where the Moon stands over the ring about it
  lamp_peak,       ///< the same of the brightest such blob elsewhere
  clipped,         ///< log10 of 0.01 + the share of pixels at white in the cell that has most of them
  sunward,         ///< log10 of brightness, by how much it grows towards the Sun's azimuth, at the horizon
};
inline constexpr int kFrameFeatures = 16;

using FrameFeatures = std::array<double, kFrameFeatures>;

struct FeatureWords {
  FrameFeature feature;
  const char *name, *unit;
};
/// In their order: "sun elevation", "deg"; as results and files of trees have them.
const std::array<FeatureWords, kFrameFeatures>& feature_words();

inline double& feature(FrameFeatures& features, FrameFeature which) {
  return features[static_cast<std::size_t>(which)];
}
inline double feature(const FrameFeatures& features, FrameFeature which) {
  return features[static_cast<std::size_t>(which)];
}

/// What of a picture is sky, and where it looks, by cells: the same for all frames of a camera.
struct FilterCells {
  int size_px = 1;            ///< edge of a cell
  int columns = 0, rows = 0;  ///< whole cells alone
  std::vector<std::uint8_t> sky;
  std::vector<std::array<double, 3>> enu;  ///< of their middles; length 1
};

/// `is_kept`: per pixel, 0 under a mask; empty: there is none. A cell is sky if half of its pixels are kept
/// and its middle looks higher than 5 degrees. Throws sim::Error(unreadable_input) if there is none.
FilterCells filter_cells(const sim::Scene& scene, const std::vector<std::uint8_t>& is_kept);

/// Of a photograph as its file has it, of the scene's site, field and camera; `utc_s`: when it was taken,
/// since 1970. The same picture gives the same numbers. Throws sim::Error(unreadable_input) for one of
/// another size than the camera's.
FrameFeatures frame_features(const Photo& photo, const sim::Scene& scene, const FilterCells& cells,
                             double utc_s);

}  // namespace vegard::fit
