// Features of a frame (numbers that are fast to compute) that distinguish arcs from clouds, the Moon,
// twilight and lamps.
//
// The picture is averaged over some 64 x 64 cells. The features use the direction of each cell, so that they
// have the same meaning for any lens. On a flat Earth an arc in magnetic east-west direction is a line of
// constant angle in the magnetic meridian: the angle atan2(up, magnetic north) of the line of sight. This
// needs neither a height nor a distance, and the gradient of the angle is the direction across arcs.
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
  moon_elevation,  ///< degrees, as seen from the site
  moon_light,      ///< illuminated fraction of the Moon, 0 if it is below the horizon
  brightness,      ///< log10 of the median cell, the file's white = 1
  contrast,        ///< difference of log10 of brightness between the 95th and the 5th percentile of cells
  structure,       ///< standard deviation of log10 of brightness about a smooth (quadratic) sky
  banded,          ///< share of that variance that bins of equal angle in the magnetic meridian explain
  crosswise,       ///< energy of gradients across arcs minus that along arcs, over their sum: -1 to 1
  elongated,       ///< coherence of the local structure tensor, weighted by its energy: 0 to 1
  green,           ///< of light brighter than the sky: green minus the mean of red and blue, over the sum
  blue,            ///< of the median sky: blue minus red, over the sum
  points,          ///< log10 of 1 + the number of star-like points
  moon_peak,       ///< log10 of the brightest cell at the Moon's position over the ring about it
  lamp_peak,       ///< the same ratio for the brightest blob elsewhere
  clipped,         ///< log10 of 0.01 + the share of pixels at white in the cell that has most of them
  sunward,         ///< increase of log10 of brightness towards the Sun's azimuth, at the horizon
};
inline constexpr int kFrameFeatures = 16;

using FrameFeatures = std::array<double, kFrameFeatures>;

struct FeatureWords {
  FrameFeature feature;
  const char *name, *unit;
};
/// Returns names and units of all features in their order ("sun elevation", "deg"), as in results and in
/// files of trees.
const std::array<FeatureWords, kFrameFeatures>& feature_words();

inline double& feature(FrameFeatures& features, FrameFeature which) {
  return features[static_cast<std::size_t>(which)];
}
inline double feature(const FrameFeatures& features, FrameFeature which) {
  return features[static_cast<std::size_t>(which)];
}

/// The cells of a picture: which are sky, and their directions. The same for all frames of a camera.
struct FilterCells {
  int size_px = 1;            ///< edge of a cell
  int columns = 0, rows = 0;  ///< number of whole cells
  std::vector<std::uint8_t> sky;
  std::vector<std::array<double, 3>> enu;  ///< directions of the cells' centres; unit vectors
};

/// Returns the cells of the scene's camera. `is_kept`: per pixel, 0 if masked; empty: no mask. A cell is sky
/// if half of its pixels are kept and its centre is higher than 5 degrees above the horizon. Throws
/// sim::Error(unreadable_input) if no cell is sky.
FilterCells filter_cells(const sim::Scene& scene, const std::vector<std::uint8_t>& is_kept);

/// Computes the features of a photograph in the pixels of its file, with the scene's site, field and camera.
/// `utc_s`: when it was taken, seconds since 1970. The same picture gives the same numbers. Throws
/// sim::Error(unreadable_input) if its size is not the camera's.
FrameFeatures frame_features(const Photo& photo, const sim::Scene& scene, const FilterCells& cells,
                             double utc_s);

}  // namespace vegard::fit
